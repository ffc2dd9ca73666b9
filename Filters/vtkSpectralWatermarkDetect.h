// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSpectralWatermarkDetect
 * @brief   Reads a message from a mesh, blind, and says how likely chance would agree as well
 *
 * Computes the mesh's spectrum and compares each slot's carrier with its references (paper, 2.4,
 * eq. 12). Needs nothing but the mesh and the properties that the mark was embedded with. A
 * basis on the input (vtkManifoldHarmonics, lumped, enough harmonics) is used instead of a new
 * one.
 *
 * Output port 0: the input mesh. Output port 1: a vtkTable with a row per bit: `Slot`,
 * `Component` (1-based), `Magnitude`, `Average`, `Deviation` (length^2), `Margin`
 * ((magnitude - average) / deviation: positive reads 1), `Bit`, `Confidence`
 * (|margin| / (1 + |margin|): a score from 0 to 1, not a probability).
 *
 * Set ExpectedMessage to have the verdict: GetBitErrorRate(), GetCorrelation(), GetPValue() and
 * GetDetected().
 *
 * Errors (vtkErrorMacro, an error code, empty outputs): as for vtkManifoldHarmonics; an expected
 * message with characters other than 0 and 1; slots that contradict each other, reach past the
 * harmonics that the mesh has, or into the constant ones.
 *
 * @warning
 * GetPValue() takes the bits of an unmarked mesh for independent fair coins. For the slots of
 * the paper that is a model, not a theorem: treat it as an indication.
 *
 * @sa
 * vtkSpectralWatermarkEmbed
 */
#ifndef vtkSpectralWatermarkDetect_h
#define vtkSpectralWatermarkDetect_h

#include "vtkSpectralWatermarkAlgorithm.h"

#include <string> // for ExpectedMessage

class VTKFILTERSSPECTRALWATERMARK_EXPORT vtkSpectralWatermarkDetect
  : public vtkSpectralWatermarkAlgorithm
{
public:
  static vtkSpectralWatermarkDetect* New();
  vtkTypeMacro(vtkSpectralWatermarkDetect, vtkSpectralWatermarkAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Set/Get how many bits to read. Default 5, at least 1. ExpectedMessage, when set, decides
   * instead.
   */
  vtkSetClampMacro(NumberOfBits, int, 1, 1000000);
  vtkGetMacro(NumberOfBits, int);
  ///@}

  ///@{
  /**
   * Set/Get the message to look for, a string of 0 and 1. Default "": none; the bits are read
   * without a verdict.
   */
  void SetExpectedMessage(const char* message);
  const char* GetExpectedMessage() const { return this->ExpectedMessage.c_str(); }
  ///@}

  ///@{
  /**
   * Set/Get the largest p-value that counts as a detection. Default 1e-6, in (0, 1]. With n bits
   * the p-value is never under 2^-n: where the rate asked for is out of reach, a vtkWarningMacro
   * says so.
   */
  vtkSetClampMacro(FalsePositiveRate, double, VTK_DBL_MIN, 1.0);
  vtkGetMacro(FalsePositiveRate, double);
  ///@}

  /**
   * Get the bits that were read, the best guess for each; "" after an error or an abort.
   */
  const char* GetExtractedMessage() const { return this->ExtractedMessage.c_str(); }

  /**
   * Get whether the message's own check holds. PaperSlots messages carry none: always 0.
   */
  vtkGetMacro(MessageIsValid, int);

  /**
   * Get the share of bits that differ from the expected message, 0 to 1; -1 without one.
   */
  vtkGetMacro(BitErrorRate, double);

  /**
   * Get the correlation of the bits, taken as +1 and -1, with the expected ones: 1 - 2 times the
   * bit error rate, from -1 to 1; 0 without an expected message.
   */
  vtkGetMacro(Correlation, double);

  /**
   * Get the probability that an unmarked mesh agrees with the expected message at least as well,
   * from the binomial distribution with fair coins; 1 without an expected message.
   */
  vtkGetMacro(PValue, double);

  /**
   * Get whether PValue is at or under FalsePositiveRate.
   */
  vtkGetMacro(Detected, int);

  /**
   * Get how many bases the last update computed: 0 when the input's was used.
   */
  vtkGetMacro(NumberOfEigensolves, int);

protected:
  vtkSpectralWatermarkDetect();
  ~vtkSpectralWatermarkDetect() override;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkSpectralWatermarkDetect(const vtkSpectralWatermarkDetect&) = delete;
  void operator=(const vtkSpectralWatermarkDetect&) = delete;

  void ResetResults();
  void CompareWithExpected();

  int NumberOfBits = 5;
  std::string ExpectedMessage;
  double FalsePositiveRate = 1e-6;

  std::string ExtractedMessage;
  int MessageIsValid = 0;
  double BitErrorRate = -1.0;
  double Correlation = 0.0;
  double PValue = 1.0;
  int Detected = 0;
  int NumberOfEigensolves = 0;
};

#endif

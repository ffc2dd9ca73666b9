// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSpectralWatermarkDetect
 * @brief   Reads a mark from a mesh, blind, and states the probability of such agreement by chance
 *
 * Detection needs only the mesh and the properties that the mark was embedded with, including the
 * secret key if one was used. Output port 0 is the input mesh. Output port 1 is a vtkTable,
 * described below with the schemes. Its field data has the values of the getters of the same names:
 * `Detected`, `PValue`, `BitErrorRate`, `MessageIsValid`, `ExtractedMessage`.
 *
 * Scheme Robust, the default: the filter reads the carriers in the solid's own frame. It tries the
 * steps that they may have been quantised with, the signs of the frame's axes where they are
 * unclear, several amounts of smoothing that are undone first, and small changes of the frame. The
 * best fit is the reading. GetMessageIsValid() returns whether the check of the message holds,
 * which happens by chance for one mesh in a million. The table has a row per carrier: `Carrier`,
 * `Value`, `Margin` (from -1, certainly 0, to 1, certainly 1), `Bit` (of the code, before
 * correction).
 *
 * Scheme PaperSlots: the filter computes the spectrum of the mesh and compares each slot's carrier
 * with its references (paper, 2.4, eq. 12). It uses a basis on the input (vtkManifoldHarmonics,
 * lumped, with enough harmonics) instead of computing one. The table has a row per bit:
 *
 * - `Slot` and `Component`, 1-based.
 * - `Magnitude`, `Average` and `Deviation`, in length^2.
 * - `Margin`: (magnitude - average) / deviation, negated if a key's keystream inverts the slot. A
 *   positive margin reads 1.
 * - `Bit`: the bit that is read.
 * - `LogLikelihoodRatio0` and `LogLikelihoodRatio1`: the natural logarithm of how much likelier the
 *   slot is under a mark with that bit than without a mark (see SetDetector()).
 * - `Confidence`: the probability of the bit, from 0 to 1, if the mesh is marked, by the same
 *   likelihoods.
 *
 * The verdict needs ExpectedMessage, or UseDerivedMessage with a secret key. It consists of
 * GetBitErrorRate(), GetCorrelation(), GetPValue(), GetLogLikelihoodRatio() and GetDetected().
 *
 * The p-value is the probability that an unmarked mesh agrees with the expected message at least as
 * well:
 *
 * - Robust, with a secret key: the reading of an unmarked mesh is uniform over all messages and
 *   checks, whatever the mesh and whatever was tried to read it. The number of bits that agree is
 *   therefore exactly binomial (84 bits for a message of 64: 5e-26 if all agree).
 * - Robust, without a secret key: the dither is public, so this holds only for meshes that were not
 *   made to agree.
 * - PaperSlots, with a secret key: the p-value is exact too. Each bit agrees like a fair coin of
 *   the key, whatever the mesh.
 * - PaperSlots, without a secret key: the bits of unmarked meshes are not fair (0 is likelier), and
 *   the p-value is an upper bound, measured on 15 unmarked scans. For every scan and carrier
 *   position, their slots (of 10 components, from 21 to 300) read 1 in at most 52 % and 0 in at
 *   most 60 % of all cases (57 % in narrow slots). Shapes that are unlike scans read 0 more often:
 *   a cube, a sphere, an icosahedron and flat rectangles in 71 to 89 % of 28 slots. For these the
 *   p-value holds for random messages, but not for a message that is mostly 0.
 *
 * The errors (vtkErrorMacro, an error code, empty outputs) are those of vtkManifoldHarmonics. It is
 * also an error if an expected message has characters other than 0 and 1; if UseDerivedMessage is
 * set without a secret key or with an ExpectedMessage; if a key file cannot be used; with Robust,
 * if the surface encloses no volume; with PaperSlots, if the slots contradict each other, need more
 * harmonics than the mesh has, or reach into the constant ones.
 *
 * @sa
 * vtkSpectralWatermarkEmbed
 */
#ifndef vtkSpectralWatermarkDetect_h
#define vtkSpectralWatermarkDetect_h

#include "vtkSpectralWatermarkAlgorithm.h"

#include <string> // for ExpectedMessage
#include <vector> // for the readings

namespace spectralwatermark
{
struct SlotReading;
}

class vtkTable;

class VTKFILTERSSPECTRALWATERMARK_EXPORT vtkSpectralWatermarkDetect
  : public vtkSpectralWatermarkAlgorithm
{
public:
  static vtkSpectralWatermarkDetect* New();
  vtkTypeMacro(vtkSpectralWatermarkDetect, vtkSpectralWatermarkAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Set/Get the message to look for, as characters 0 and 1. Its length is the number of bits that
   * are read. Default "": none; NumberOfBits bits are then read without a verdict.
   */
  void SetExpectedMessage(const char* message);
  const char* GetExpectedMessage() const { return this->ExpectedMessage.c_str(); }
  ///@}

  ///@{
  /**
   * Set/Get whether to look for the message of NumberOfBits bits that is derived from the secret
   * key. vtkSpectralWatermarkEmbed embeds that message if its own is empty. Default off.
   */
  vtkSetMacro(UseDerivedMessage, bool);
  vtkGetMacro(UseDerivedMessage, bool);
  vtkBooleanMacro(UseDerivedMessage, bool);
  ///@}

  /**
   * Detectors of PaperSlots. HardDecisions counts the bits that agree (eq. 12). Likelihood weighs
   * each bit by its evidence: how much likelier the carrier is under one bit than under the other,
   * after an embedding by eq. 10 or 11 (BitEmbedding, TurbulenceFactor) and attacks like the
   * paper's, given the spread of carriers on unmarked scans. Both read the same bits.
   */
  enum DetectorType
  {
    HardDecisions = 0,
    Likelihood = 1
  };

  ///@{
  /**
   * Set/Get the detector, which determines how PaperSlots computes the p-value. Default
   * HardDecisions.
   */
  vtkSetClampMacro(Detector, int, HardDecisions, Likelihood);
  vtkGetMacro(Detector, int);
  void SetDetectorToHardDecisions() { this->SetDetector(HardDecisions); }
  void SetDetectorToLikelihood() { this->SetDetector(Likelihood); }
  const char* GetDetectorAsString() const;
  ///@}

  ///@{
  /**
   * Set/Get the largest p-value that counts as a detection. Default 1e-6, in (0, 1]. The p-value is
   * at least that of full agreement: 2^-n for n fair bits, where Robust adds at least 20 check bits
   * to those of the message. If this rate cannot be reached, a vtkWarningMacro says so.
   */
  vtkSetClampMacro(FalsePositiveRate, double, VTK_DBL_MIN, 1.0);
  vtkGetMacro(FalsePositiveRate, double);
  ///@}

  /**
   * Get the number of iterations of smoothing (vtkMeshAttack, LaplacianSmoothing, factor 0.1) that
   * Robust undid for its reading.
   */
  vtkGetMacro(UndoneSmoothing, int);

  /**
   * Get the message that was read, the best guess for each bit; "" after an error or an abort.
   */
  const char* GetExtractedMessage() const { return this->ExtractedMessage.c_str(); }

  /**
   * Get whether the check of the message holds, 1 or 0 (Robust). Messages of PaperSlots have no
   * check: always 0.
   */
  vtkGetMacro(MessageIsValid, int);

  /**
   * Get the share of bits that differ from the expected message, from 0 to 1; -1 without an
   * expected message.
   */
  vtkGetMacro(BitErrorRate, double);

  /**
   * Get the correlation of the bits, taken as +1 and -1, with the expected bits, from -1 to 1:
   * 1 - 2 times the bit error rate. 0 without an expected message.
   */
  vtkGetMacro(Correlation, double);

  /**
   * Get the probability that an unmarked mesh agrees with the expected message at least as well, or
   * an upper bound of it (see the description of the class). 1 without an expected message.
   */
  vtkGetMacro(PValue, double);

  /**
   * Get the natural logarithm of how much likelier the magnitudes of the carriers are if the mesh
   * carries the expected message than if it is unmarked. This statistic is optimal as far as the
   * likelihoods of SetDetector() hold, but it is not calibrated: use GetPValue() as evidence. 0
   * without an expected message, and for Robust.
   */
  vtkGetMacro(LogLikelihoodRatio, double);

  /**
   * Get the p-value that full agreement with the expected message would have; -1 without an
   * expected message. If it is above FalsePositiveRate, the message has too few bits to be detected
   * at all, and a negative verdict means nothing.
   */
  vtkGetMacro(SmallestPValue, double);

  /**
   * Get whether the p-value is at most FalsePositiveRate, 1 or 0.
   */
  vtkGetMacro(Detected, int);

  /**
   * Get the number of bases that the last update computed: 0 if it used the input's, and for
   * Robust.
   */
  vtkGetMacro(NumberOfEigensolves, int);

protected:
  vtkSpectralWatermarkDetect();
  ~vtkSpectralWatermarkDetect() override;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkSpectralWatermarkDetect(const vtkSpectralWatermarkDetect&) = delete;
  void operator=(const vtkSpectralWatermarkDetect&) = delete;

  void ResetResults() override;
  std::string WantedMessage(const spectralwatermark::SecretKey* key);
  void ReadSlots(vtkPolyData* input, vtkTable* table);
  void ReadRobust(vtkPolyData* input, vtkTable* table);
  void CountErrors(const std::string& wanted);
  void Judge(double smallestPValue);
  void Compare(const std::vector<spectralwatermark::SlotReading>& readings,
    const spectralwatermark::SlotOptions& slots, const std::string& wanted);

  std::string ExpectedMessage;
  bool UseDerivedMessage = false;
  int Detector = HardDecisions;
  double FalsePositiveRate = 1e-6;

  std::string ExtractedMessage;
  int MessageIsValid = 0;
  double BitErrorRate = -1.0;
  double Correlation = 0.0;
  double PValue = 1.0;
  double SmallestPValue = -1.0;
  double LogLikelihoodRatio = 0.0;
  int Detected = 0;
  int NumberOfEigensolves = 0;
  int UndoneSmoothing = 0;
};

#endif

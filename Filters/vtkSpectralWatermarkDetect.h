// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSpectralWatermarkDetect
 * @brief   Reads a message from a mesh, blind, and says how likely chance would agree as well
 *
 * Needs nothing but the mesh and the properties that the mark was embedded with, the secret key
 * among them when there was one. Output port 0: the input mesh. Output port 1: a vtkTable, see the
 * schemes; its field data has what the getters of the same names tell: `Detected`, `PValue`,
 * `BitErrorRate`, `MessageIsValid`, `ExtractedMessage`.
 *
 * Scheme Robust, the default: reads the carriers in the solid's own frame, trying the steps that they
 * may have been quantised with, the signs of the frame's axes where they are unclear, smoothings that
 * may have to be undone first, and small movements of the frame; the best fit is what is read.
 * GetMessageIsValid() tells whether the message's check holds: by chance it does so for one mesh in a
 * million. The table has a row per carrier: `Carrier`, `Value`, `Margin` (from -1, surely 0, to 1,
 * surely 1), `Bit` (of the code, before correction).
 *
 * Scheme PaperSlots: computes the mesh's spectrum and compares each slot's carrier with its
 * references (paper, 2.4, eq. 12). A basis on the input (vtkManifoldHarmonics, lumped, enough
 * harmonics) is used instead of a new one. The table has a row per bit: `Slot`, `Component`
 * (1-based), `Magnitude`, `Average`, `Deviation` (length^2), `Margin` ((magnitude - average) /
 * deviation, with the opposite sign where a key's keystream inverts the slot: positive reads 1),
 * `Bit`, `LogLikelihoodRatio0` and `LogLikelihoodRatio1` (natural logarithms: how much likelier the
 * slot is under a mark with that bit than under none, see SetDetector()), `Confidence` (from 0 to 1:
 * the probability of that bit if the mesh carries a mark, by the likelihoods of SetDetector()).
 *
 * Set ExpectedMessage, or UseDerivedMessage with a secret key, to have the verdict:
 * GetBitErrorRate(), GetCorrelation(), GetPValue(), GetLogLikelihoodRatio() and GetDetected().
 *
 * The p-value is the probability that an unmarked mesh agrees with the expected message at least
 * as well. Robust: what an unmarked mesh reads is uniform over all messages and checks, under a key,
 * whatever the mesh and whatever was tried to read it, so that the number of their bits that agree is
 * exactly binomial (84 bits for a message of 64: 5e-26 when all agree). Without a secret key the
 * dither is public: that then holds for meshes that were not made to agree. PaperSlots, with a secret
 * key: exact too, each bit agrees like a fair coin of the key, whatever the mesh. Without one, bits of
 * unmarked meshes are not fair (0 is the likelier) and the p-value is an upper bound from how 15
 * unmarked scans read: their slots (of 10 components, from 21 to 300) read 1 in at most 52 % and 0 in
 * at most 60 % of all cases (57 % in narrow slots), for every scan and carrier position. Shapes
 * that are nothing like scans read 0 more often (a cube, a sphere, an icosahedron and flat rectangles in 71
 * to 89 % of 28 slots): there the p-value holds for random messages, not for one that is mostly 0.
 *
 * Errors (vtkErrorMacro, an error code, empty outputs): as for vtkManifoldHarmonics; an expected
 * message with characters other than 0 and 1; UseDerivedMessage without a secret key or with an
 * ExpectedMessage; a key file that cannot be used; with Robust, a surface that encloses no volume;
 * with PaperSlots, slots that contradict each other, reach past the harmonics that the mesh has, or
 * into the constant ones.
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
   * Set/Get the message to look for, a string of 0 and 1, which decides how many bits are read.
   * Default "": none; NumberOfBits bits are read without a verdict.
   */
  void SetExpectedMessage(const char* message);
  const char* GetExpectedMessage() const { return this->ExpectedMessage.c_str(); }
  ///@}

  ///@{
  /**
   * Set/Get whether to look for the NumberOfBits bits that the secret key derives: what
   * vtkSpectralWatermarkEmbed embeds when its message is empty. Default off.
   */
  vtkSetMacro(UseDerivedMessage, bool);
  vtkGetMacro(UseDerivedMessage, bool);
  vtkBooleanMacro(UseDerivedMessage, bool);
  ///@}

  /**
   * Detectors of PaperSlots. HardDecisions counts the bits that agree (eq. 12). Likelihood weighs each by its
   * evidence: how much likelier the carrier is under one bit than under the other, after an
   * embedding by eq. 10 or 11 (BitEmbedding, TurbulenceFactor) and attacks like the paper's, given
   * how the carriers of unmarked scans are spread. The bits that are read are the same.
   */
  enum DetectorType
  {
    HardDecisions = 0,
    Likelihood = 1
  };

  ///@{
  /**
   * Set/Get what the p-value of PaperSlots is made from. Default HardDecisions.
   */
  vtkSetClampMacro(Detector, int, HardDecisions, Likelihood);
  vtkGetMacro(Detector, int);
  void SetDetectorToHardDecisions() { this->SetDetector(HardDecisions); }
  void SetDetectorToLikelihood() { this->SetDetector(Likelihood); }
  const char* GetDetectorAsString() const;
  ///@}

  ///@{
  /**
   * Set/Get the largest p-value that counts as a detection. Default 1e-6, in (0, 1]. The p-value
   * is never under that of full agreement: 2^-n for n bits, where Robust has at least 20 bits more
   * than the message, those of its check. Where the rate asked for is out of reach, a
   * vtkWarningMacro says so.
   */
  vtkSetClampMacro(FalsePositiveRate, double, VTK_DBL_MIN, 1.0);
  vtkGetMacro(FalsePositiveRate, double);
  ///@}

  /**
   * Get how many iterations of smoothing (of vtkMeshAttack, LaplacianSmoothing, factor 0.1) Robust
   * had to undo for its reading.
   */
  vtkGetMacro(UndoneSmoothing, int);

  /**
   * Get the bits that were read, the best guess for each; "" after an error or an abort.
   */
  const char* GetExtractedMessage() const { return this->ExtractedMessage.c_str(); }

  /**
   * Get whether the message's own check holds (Robust). PaperSlots messages carry none: always 0.
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
   * or an upper bound of it (see the class); 1 without an expected message.
   */
  vtkGetMacro(PValue, double);

  /**
   * Get the natural logarithm of how much likelier the carriers' magnitudes are if the mesh carries
   * the expected message than if it is unmarked: the optimal statistic as far as the likelihoods
   * of SetDetector() hold. 0 without an expected message, and for Robust. Not calibrated: for a
   * certainty use GetPValue().
   */
  vtkGetMacro(LogLikelihoodRatio, double);

  /**
   * Get the p-value that full agreement with the expected message would have. Above FalsePositiveRate the
   * message has too few bits to be detected at all: "not detected" then says nothing. -1 without an
   * expected message.
   */
  vtkGetMacro(SmallestPValue, double);

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

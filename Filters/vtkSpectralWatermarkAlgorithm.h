// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSpectralWatermarkAlgorithm
 * @brief   What embedding and detection must agree on: scheme, slots, carriers and secret
 *
 * Superclass of vtkSpectralWatermarkEmbed and vtkSpectralWatermarkDetect. A mark is read with the
 * properties it was embedded with.
 *
 * Scheme Robust, the default: bits live in the Fourier transform of the solid that the surface
 * encloses, at wave vectors that the secret key decides, quantised with a secret dither and protected
 * by the extended Golay code and a check. The mark belongs to the solid, not to its triangles. It
 * needs a surface that encloses a volume; small holes do no harm. NumberOfBits and the secret key are
 * its only properties here. Filters/README.md explains what it is made of, why it holds and what
 * breaks it. Without a secret key it works with a public one: anyone can then read the mark, or find
 * it.
 *
 * Scheme PaperSlots (paper, 2.2.3 and 3.2.1): bit i lives in slot i, the SlotSize components from
 * FirstComponent + i SlotSize on. In each slot one component, the carrier, is compared with the
 * average of reference components around it. It needs no volume: any surface goes.
 *
 * PaperSlots with a secret key (SecretKey or SecretKeyFile): the carrier's place in each slot is drawn from
 * the key, uniformly from positions 2 to SlotSize - 1, and the message is whitened with a
 * keystream: slot i holds the bit k_i xor a fair coin of the key. Whoever has another key, or none,
 * reads coin flips. Positions, keystream and derived messages come from libsodium's BLAKE2b and
 * ChaCha20 and are the same on every platform and in every version.
 *
 * @warning
 * A secret that can be guessed can be tried out on a marked mesh: make it random, for example with
 * `head -c 32 /dev/urandom | base64 > my.key`.
 *
 * @sa
 * vtkSpectralWatermarkEmbed vtkSpectralWatermarkDetect
 */
#ifndef vtkSpectralWatermarkAlgorithm_h
#define vtkSpectralWatermarkAlgorithm_h

#include "vtkFiltersSpectralWatermarkModule.h" // for export macro
#include "vtkTriangleMeshAlgorithm.h"

#include <memory> // for std::unique_ptr
#include <string> // for SecretKey

namespace spectralwatermark
{
class SecretKey;
struct SlotOptions;
} // namespace spectralwatermark

class VTKFILTERSSPECTRALWATERMARK_EXPORT vtkSpectralWatermarkAlgorithm
  : public vtkTriangleMeshAlgorithm
{
public:
  vtkAbstractTypeMacro(vtkSpectralWatermarkAlgorithm, vtkTriangleMeshAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * The bytes that this process may still take: what the machine has free, with swap, or what limits of
   * the shell (`ulimit -v`) or of control groups, as of containers, leave of it. Infinite where that is
   * not known, as on other systems than Linux. The filters ask before they start; so can who reads a
   * large file for them.
   */
  static double GetAvailableMemory();

  /**
   * Watermarking schemes.
   */
  enum SchemeType
  {
    PaperSlots = 0, ///< the paper's: a bit in each slot of the spectrum of manifold harmonics
    Robust = 1      ///< bits in the Fourier transform of the solid
  };

  ///@{
  /**
   * Set/Get the scheme. Default Robust (1). Another value is an error when the filter runs.
   */
  vtkSetMacro(Scheme, int);
  vtkGetMacro(Scheme, int);
  void SetSchemeToPaperSlots() { this->SetScheme(PaperSlots); }
  void SetSchemeToRobust() { this->SetScheme(Robust); }
  const char* GetSchemeAsString() const;
  ///@}

  /**
   * Slot divisions (paper, 3.2.1). Normal: the references are positions 1 to SlotSize - 1 without
   * the carrier's. InterleavedNarrow: the carrier's two neighbours.
   */
  enum SlotDivisionType
  {
    Normal = 0,
    InterleavedNarrow = 1
  };

  ///@{
  /**
   * Set/Get which components of a slot the carrier is compared with. Default Normal.
   */
  vtkSetClampMacro(SlotDivision, int, Normal, InterleavedNarrow);
  vtkGetMacro(SlotDivision, int);
  void SetSlotDivisionToNormal() { this->SetSlotDivision(Normal); }
  void SetSlotDivisionToInterleavedNarrow() { this->SetSlotDivision(InterleavedNarrow); }
  const char* GetSlotDivisionAsString() const;
  ///@}

  ///@{
  /**
   * Set/Get the first component of the first slot, 1-based as in the paper (component 1 is the
   * constant harmonic). Default 21, at least 2. Slots that reach into the constant harmonics (one
   * per component of the mesh) are an error.
   */
  vtkSetClampMacro(FirstComponent, int, 2, VTK_INT_MAX / 2);
  vtkGetMacro(FirstComponent, int);
  ///@}

  ///@{
  /**
   * Set/Get the number of components of a slot, each of which holds one bit. Default 10, at
   * least 4.
   */
  vtkSetClampMacro(SlotSize, int, 4, 1000000);
  vtkGetMacro(SlotSize, int);
  ///@}

  ///@{
  /**
   * Set/Get the carrier's place in its slot, 1-based. Default 5; 2 to SlotSize - 1, anything else
   * is an error when the filter runs. A secret key decides instead when there is one.
   */
  vtkSetMacro(CarrierPosition, int);
  vtkGetMacro(CarrierPosition, int);
  ///@}

  /**
   * Bit embeddings. Aggressive (eq. 10): every carrier ends at least TurbulenceFactor deviations
   * from the average. NonAggressive (eq. 11): carriers already on their side stay.
   */
  enum BitEmbeddingType
  {
    Aggressive = 0,
    NonAggressive = 1
  };

  ///@{
  /**
   * Set/Get when a carrier is changed. Default Aggressive. Detection uses it only to weigh what it
   * sees (see vtkSpectralWatermarkDetect::SetDetector()).
   */
  vtkSetClampMacro(BitEmbedding, int, Aggressive, NonAggressive);
  vtkGetMacro(BitEmbedding, int);
  void SetBitEmbeddingToAggressive() { this->SetBitEmbedding(Aggressive); }
  void SetBitEmbeddingToNonAggressive() { this->SetBitEmbedding(NonAggressive); }
  const char* GetBitEmbeddingAsString() const;
  ///@}

  ///@{
  /**
   * Set/Get the paper's s: how many deviations of the references lie between a changed carrier
   * and their average. More is more robust and more visible. Default 1, from 0 to 1000. A target
   * below 0 becomes 0. Detection uses it only to weigh what it sees.
   */
  vtkSetClampMacro(TurbulenceFactor, double, 0.0, 1000.0);
  vtkGetMacro(TurbulenceFactor, double);
  ///@}

  ///@{
  /**
   * Set/Get how many bits: those to read, and those of a message derived from the secret key.
   * Default 64 for Robust and 5 for PaperSlots, which is what 0 stands for; the getter gives the
   * number that is used. Robust takes up to 1024. A message that is given decides instead.
   */
  vtkSetClampMacro(NumberOfBits, int, 0, 1000000);
  int GetNumberOfBits() const;
  ///@}

  ///@{
  /**
   * Set the secret key, any text; "" or nullptr for none, the default: Robust then works with a
   * public key, and PaperSlots has its carriers at CarrierPosition and whitens nothing. There is no
   * getter, and nothing prints it: GetHasSecretKey() tells whether there is one, here or in
   * SecretKeyFile.
   */
  void SetSecretKey(const char* secret);
  int GetHasSecretKey() const;
  ///@}

  ///@{
  /**
   * Set/Get a file that holds the secret key, read whenever the filter runs: all of its bytes but
   * one line break at the end, at most 1 MiB. Default "": none. A file that cannot be read or is
   * empty is an error when the filter runs, and so is setting both SecretKey and SecretKeyFile.
   */
  void SetSecretKeyFile(const char* path);
  const char* GetSecretKeyFile() const { return this->SecretKeyFile.c_str(); }
  ///@}

protected:
  vtkSpectralWatermarkAlgorithm();
  ~vtkSpectralWatermarkAlgorithm() override;

  /**
   * The secret key, from where it was set; nullptr when there is none. Throws when its file cannot
   * be used.
   */
  std::unique_ptr<spectralwatermark::SecretKey> ReadSecretKey() const;

  /**
   * The same for the scheme Robust: a public key where there is none.
   */
  std::unique_ptr<spectralwatermark::SecretKey> ReadRobustKey() const;

  /**
   * Whether the scheme is Robust.
   */
  bool IsRobust() const { return this->Scheme == Robust; }

  /**
   * Throws when the scheme is none of SchemeType.
   */
  void CheckScheme() const;

  /**
   * The properties above for the Core, checked for this many bits; throws when they contradict
   * each other.
   */
  spectralwatermark::SlotOptions GetSlotOptions(const spectralwatermark::SecretKey* key,
    long long bits) const;

private:
  vtkSpectralWatermarkAlgorithm(const vtkSpectralWatermarkAlgorithm&) = delete;
  void operator=(const vtkSpectralWatermarkAlgorithm&) = delete;

  int Scheme = Robust;
  int SlotDivision = Normal;
  int FirstComponent = 21;
  int SlotSize = 10;
  int CarrierPosition = 5;
  int BitEmbedding = Aggressive;
  double TurbulenceFactor = 1.0;
  int NumberOfBits = 0;
  std::string SecretKey;
  std::string SecretKeyFile;
};

#endif

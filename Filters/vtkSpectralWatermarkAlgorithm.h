// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSpectralWatermarkAlgorithm
 * @brief   Base class of embedding and detection: scheme, slots, carriers and secret key
 *
 * Superclass of vtkSpectralWatermarkEmbed and vtkSpectralWatermarkDetect. A mark can only be read
 * with the properties that it was embedded with.
 *
 * Scheme Robust, the default: the bits are in the Fourier transform of the solid that the surface
 * encloses, at wave vectors that the secret key determines. They are quantised with a secret dither
 * and protected by the extended Golay code and a check. The mark belongs to the solid and not to
 * its triangles. The surface must enclose a volume. Of the properties
 * below, Robust uses only NumberOfBits and the secret key. Without a secret key it works with a
 * public key, so that anyone can find and read the mark. Filters/Documentation/robust-scheme.md
 * explains how the scheme works and what breaks it.
 *
 * Scheme PaperSlots (paper, 2.2.3 and 3.2.1; vtkManifoldHarmonics cites it): bit i is in slot i,
 * which consists of the SlotSize components from FirstComponent + i SlotSize on. In each slot one
 * component, the carrier, is compared with the average of reference components around it. The
 * scheme needs no volume, so it works on any surface.
 *
 * PaperSlots with a secret key (SecretKey or SecretKeyFile): the position of the carrier in each
 * slot is drawn from the key, uniformly from 2 to SlotSize - 1. A keystream whitens the message:
 * slot i holds the bit k_i xor a fair coin of the key. Whoever reads with another key, or with
 * none, reads coin flips. Positions, keystream and derived messages come from libsodium's BLAKE2b
 * and ChaCha20, and are the same on every platform and in every version.
 *
 * @warning
 * A secret that can be guessed can be tried out on a marked mesh. Make it random, for example with
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
   * Get the memory that this process may still take, in bytes: what the machine has free, including
   * swap, or less if the shell (`ulimit -v`) or control groups (containers) set a limit. Infinite
   * where it is not known, as on systems other than Linux. The filters check this before they
   * start; so can code that loads large files for them.
   */
  static double GetAvailableMemory();

  /**
   * Watermarking schemes.
   */
  enum SchemeType
  {
    PaperSlots = 0, ///< the paper's scheme: a bit in each slot of the manifold harmonics spectrum
    Robust = 1      ///< bits in the Fourier transform of the solid
  };

  ///@{
  /**
   * Set/Get the scheme, a SchemeType. Default Robust (1). Any other number is an error when the
   * filter runs.
   */
  vtkSetMacro(Scheme, int);
  vtkGetMacro(Scheme, int);
  void SetSchemeToPaperSlots() { this->SetScheme(PaperSlots); }
  void SetSchemeToRobust() { this->SetScheme(Robust); }
  const char* GetSchemeAsString() const;
  ///@}

  /**
   * Slot divisions (paper, 3.2.1), which determine the references of a carrier. Normal: positions 1
   * to SlotSize - 1 except the carrier's. InterleavedNarrow: the carrier's two neighbours.
   */
  enum SlotDivisionType
  {
    Normal = 0,
    InterleavedNarrow = 1
  };

  ///@{
  /**
   * Set/Get the slot division: the components of a slot that the carrier is compared with. Default
   * Normal.
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
   * constant harmonic). Default 21, at least 2. It is an error if the slots reach into the constant
   * harmonics, of which the mesh has one per connected component.
   */
  vtkSetClampMacro(FirstComponent, int, 2, VTK_INT_MAX / 2);
  vtkGetMacro(FirstComponent, int);
  ///@}

  ///@{
  /**
   * Set/Get the number of components of a slot. Each slot holds one bit. Default 10, from 4 to
   * 1,000,000.
   */
  vtkSetClampMacro(SlotSize, int, 4, 1000000);
  vtkGetMacro(SlotSize, int);
  ///@}

  ///@{
  /**
   * Set/Get the position of the carrier in its slot, 1-based. Default 5, from 2 to SlotSize - 1;
   * anything else is an error when the filter runs. With a secret key, the key determines the
   * positions instead.
   */
  vtkSetMacro(CarrierPosition, int);
  vtkGetMacro(CarrierPosition, int);
  ///@}

  /**
   * Bit embeddings. Aggressive (eq. 10): every carrier ends at least TurbulenceFactor deviations
   * away from the average. NonAggressive (eq. 11): carriers that are already on their side stay.
   */
  enum BitEmbeddingType
  {
    Aggressive = 0,
    NonAggressive = 1
  };

  ///@{
  /**
   * Set/Get the bit embedding, which decides which carriers are changed. Default Aggressive.
   * Detection uses it only to weigh the evidence (see vtkSpectralWatermarkDetect::SetDetector()).
   */
  vtkSetClampMacro(BitEmbedding, int, Aggressive, NonAggressive);
  vtkGetMacro(BitEmbedding, int);
  void SetBitEmbeddingToAggressive() { this->SetBitEmbedding(Aggressive); }
  void SetBitEmbeddingToNonAggressive() { this->SetBitEmbedding(NonAggressive); }
  const char* GetBitEmbeddingAsString() const;
  ///@}

  ///@{
  /**
   * Set/Get the paper's s: the distance of a changed carrier from the average of its references, in
   * standard deviations of the references. A larger factor is more robust and more visible. Default
   * 1, from 0 to 1000. A target magnitude below 0 becomes 0. Detection uses it only to weigh the
   * evidence.
   */
  vtkSetClampMacro(TurbulenceFactor, double, 0.0, 1000.0);
  vtkGetMacro(TurbulenceFactor, double);
  ///@}

  ///@{
  /**
   * Set/Get the number of bits to read, and of a message derived from the secret key. Default 0,
   * which stands for 64 in Robust and for 5 in PaperSlots; the getter returns the number that is
   * used. At most 1024 in Robust. A message that is set determines the number instead.
   */
  vtkSetClampMacro(NumberOfBits, int, 0, 1000000);
  int GetNumberOfBits() const;
  ///@}

  ///@{
  /**
   * Set the secret key, any text. Default "" (or nullptr): no key. Robust then works with a public
   * key; PaperSlots has its carriers at CarrierPosition and does not whiten the message. There is
   * no getter, and the secret is never printed. GetHasSecretKey() returns whether a key is set,
   * here or by SecretKeyFile.
   */
  void SetSecretKey(const char* secret);
  int GetHasSecretKey() const;
  ///@}

  ///@{
  /**
   * Set/Get the path of a file that holds the secret key. Default "": none. The file is read
   * whenever the filter runs; the secret is all of its bytes except one line break at the end, at
   * most 1 MiB. It is an error when the filter runs if the file cannot be read or is empty, or if
   * both SecretKey and SecretKeyFile are set.
   */
  void SetSecretKeyFile(const char* path);
  const char* GetSecretKeyFile() const { return this->SecretKeyFile.c_str(); }
  ///@}

protected:
  vtkSpectralWatermarkAlgorithm();
  ~vtkSpectralWatermarkAlgorithm() override;

  /**
   * The secret key that is set, or nullptr if there is none. Throws InvalidInput if its file cannot
   * be used.
   */
  std::unique_ptr<spectralwatermark::SecretKey> ReadSecretKey() const;

  /**
   * The secret key that is set, or the public key of the scheme Robust if there is none. Throws
   * InvalidInput if the key file cannot be used.
   */
  std::unique_ptr<spectralwatermark::SecretKey> ReadRobustKey() const;

  /**
   * Whether the scheme is Robust.
   */
  bool IsRobust() const { return this->Scheme == Robust; }

  /**
   * Throws InvalidInput if the scheme is none of SchemeType.
   */
  void CheckScheme() const;

  /**
   * The slot properties as Core takes them, checked for this number of bits. Throws InvalidInput if
   * they contradict each other.
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

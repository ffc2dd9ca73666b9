// SPDX-License-Identifier: BSD-3-Clause
/// The paper's scheme, which holds one bit per slot in the magnitude of one coefficient of the
/// spectrum (2.2.3 to 2.4).
#ifndef SpectralWatermark_Core_PaperScheme_Slots_h
#define SpectralWatermark_Core_PaperScheme_Slots_h

#include "Core/Harmonics/Transform.h"

#include <string>
#include <vector>

namespace spectralwatermark
{

/// The rule by which a carrier is changed to hold its bit.
enum class BitEmbedding
{
  Aggressive = 0,   ///< eq. 10: every carrier ends at least s d away from the average
  NonAggressive = 1 ///< eq. 11: a carrier that is already on the side of its bit stays
};

/// The reference components that the carrier of a slot is compared with.
enum class SlotDivision
{
  Normal = 0,           ///< positions 1 to SlotSize - 1 except the carrier's
  InterleavedNarrow = 1 ///< the two neighbours of the carrier
};

/// Where the slots are, and how they hold their bits.
struct SlotOptions
{
  /// The first component of the first slot, at least 2. Components are 1-based like the paper's,
  /// where component 1 is the constant harmonic.
  Index FirstComponent = 21;

  /// The number of components of a slot, at least 4.
  Index SlotSize = 10;

  /// The position of the carrier in its slot, 1-based, from 2 to SlotSize - 1.
  Index CarrierPosition = 5;

  SlotDivision Division = SlotDivision::Normal;
  BitEmbedding Embedding = BitEmbedding::Aggressive;

  /// The paper's s: the distance of a changed carrier from the average of its references, in
  /// deviations. At least 0.
  double TurbulenceFactor = 1.0;

  /// The carrier position of each slot under a secret key, instead of CarrierPosition. Empty
  /// without a key, else at least one per slot.
  std::vector<Index> KeyedPositions;

  /// The keystream of a secret key: a 1 for each slot that holds the opposite of its message bit.
  /// Empty without a key, else at least one character per slot.
  std::string Keystream;
};

/// What is read from one slot. Magnitudes are in length^2.
struct SlotReading
{
  Index Component = 0;    ///< the component of the carrier, 1-based
  double Magnitude = 0.0; ///< c: the magnitude of the carrier (eq. 9)
  double Average = 0.0;   ///< a: the mean magnitude of the references
  double Deviation = 0.0; ///< d: the population standard deviation of these magnitudes
  bool Inverted = false;  ///< whether the keystream inverts the bit that the slot holds

  /// The bit that the slot holds (eq. 12), with the keystream undone. A magnitude equal to the
  /// average counts as below it.
  int Bit() const { return (this->Magnitude > this->Average) != this->Inverted ? 1 : 0; }

  /// (c - a) / d, negated where Inverted is set: positive for a 1, negative for a 0, and 0 if d is
  /// 0.
  double Margin() const;
};

/// The number of components needed to read `bits` bits: the last component of the last slot,
/// 1-based.
Index ComponentsNeeded(const SlotOptions& options, Index bits);

/// Throws InvalidInput if the options contradict each other, or if `bits` is less than 1.
void CheckSlots(const SlotOptions& options, Index bits);

/// Throws InvalidInput if the slots need more than the `available` harmonics of a mesh.
void CheckCapacity(const SlotOptions& options, Index bits, Index available);

/// Throws InvalidInput if the slots reach into the constant harmonics, of which a mesh has one per
/// connected component.
void CheckSlotsAboveKernel(const SlotOptions& options, Index kernelDimension);

/// Reads the first `bits` slots of a spectrum with these magnitudes.
std::vector<SlotReading> ReadSlots(const Eigen::VectorXd& magnitudes, const SlotOptions& options,
  Index bits);

/// The bits of the readings as characters 0 and 1.
std::string MessageOf(const std::vector<SlotReading>& readings);

/// The magnitude that makes the carrier hold `bit` (eqs. 10 and 11), never negative.
double TargetMagnitude(const SlotReading& reading, int bit, const SlotOptions& options);

/// The change of the spectrum that embeds the message. It is zero except in the rows of the
/// carriers, which keep their direction; a carrier of magnitude 0 gets the direction (1, 1, 1).
Spectrum SpectrumChange(const Spectrum& spectrum, const std::vector<SlotReading>& readings,
  const std::string& message, const SlotOptions& options);

} // namespace spectralwatermark

#endif

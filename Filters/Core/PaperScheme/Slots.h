// SPDX-License-Identifier: BSD-3-Clause
/// The paper's scheme: one bit in the magnitude of one coefficient of each slot (2.2.3 to 2.4).
#ifndef SpectralWatermark_Core_PaperScheme_Slots_h
#define SpectralWatermark_Core_PaperScheme_Slots_h

#include "Core/Harmonics/Transform.h"

#include <string>
#include <vector>

namespace spectralwatermark
{

enum class BitEmbedding
{
  Aggressive = 0,   ///< eq. 10: every carrier ends at least s d away from the average
  NonAggressive = 1 ///< eq. 11: a carrier already on its side stays
};

enum class SlotDivision
{
  Normal = 0,           ///< references: positions 1 to SlotSize - 1 without the carrier's
  InterleavedNarrow = 1 ///< references: the carrier's two neighbours
};

struct SlotOptions
{
  Index FirstComponent = 21; ///< of the first slot; 1-based like the paper, where 1 is constant
  Index SlotSize = 10;       ///< components per slot, at least 4
  Index CarrierPosition = 5; ///< within the slot, 1-based, 2 to SlotSize - 1
  SlotDivision Division = SlotDivision::Normal;
  BitEmbedding Embedding = BitEmbedding::Aggressive;
  double TurbulenceFactor = 1.0; ///< s: distance from the average, in deviations
  /// With a secret key: each slot's carrier position, in place of CarrierPosition, and a bit for
  /// each slot, 1 where it holds the opposite of its message bit. Both at least as many as slots.
  std::vector<Index> KeyedPositions;
  std::string Keystream;
};

/// What one slot shows.
struct SlotReading
{
  Index Component = 0;    ///< the carrier, 1-based
  double Magnitude = 0.0; ///< c, eq. 9
  double Average = 0.0;   ///< a, of the references' magnitudes
  double Deviation = 0.0; ///< d, their population standard deviation
  bool Inverted = false;  ///< a secret key's keystream has the slot hold the opposite of its bit

  /// Eq. 12, with the keystream undone; c = a is below a.
  int Bit() const { return (this->Magnitude > this->Average) != this->Inverted ? 1 : 0; }

  /// (c - a) / d, with the opposite sign where Inverted: positive for a 1, negative for a 0; 0
  /// where d is 0.
  double Margin() const;
};

/// Components that must be there to read `bits` bits: the last one of the last slot, 1-based.
Index ComponentsNeeded(const SlotOptions& options, Index bits);

/// Throws InvalidInput when the options contradict each other or a message of this length.
void CheckSlots(const SlotOptions& options, Index bits);

/// Throws InvalidInput when the slots reach past the `available` harmonics of a mesh.
void CheckCapacity(const SlotOptions& options, Index bits, Index available);

/// Throws InvalidInput when slots would reach into the constant harmonics, of which there is one
/// per component of the mesh.
void CheckSlotsAboveKernel(const SlotOptions& options, Index kernelDimension);

/// Reads the first `bits` slots.
std::vector<SlotReading> ReadSlots(const Eigen::VectorXd& magnitudes, const SlotOptions& options,
  Index bits);

/// The readings' bits as a string of 0 and 1.
std::string MessageOf(const std::vector<SlotReading>& readings);

/// Eqs. 10 and 11: the magnitude that the carrier must get to hold `bit`; never negative.
double TargetMagnitude(const SlotReading& reading, int bit, const SlotOptions& options);

/// The change of the spectrum that embeds the message: zero but in the carriers' rows, which
/// keep their direction. A carrier of magnitude 0 gets the direction (1, 1, 1).
Spectrum SpectrumChange(const Spectrum& spectrum, const std::vector<SlotReading>& readings,
  const std::string& message, const SlotOptions& options);

} // namespace spectralwatermark

#endif

// SPDX-License-Identifier: BSD-3-Clause
/// The carriers of the robust scheme (RobustEmbedding.h): wave vectors, lattices, and the code.
#ifndef SpectralWatermark_Core_RobustScheme_CarrierSet_h
#define SpectralWatermark_Core_RobustScheme_CarrierSet_h

#include "Core/Payload/SecretKey.h"
#include "Core/Support/Types.h"

#include <string>

namespace spectralwatermark
{

/// What a secret and a number of bits decide.
struct CarrierSet
{
  Eigen::MatrixXd Waves;  ///< wave vectors, a row each, in 1 / scale of the frame
  Eigen::VectorXd Dither; ///< of each carrier, in [0, 1) steps
  std::string Whitening;  ///< of each carrier, 0 or 1
  Index MessageBits = 0;
  Index CheckBits = 0;

  Index Count() const { return this->Dither.size(); }
};

/// For messages of 1 to LargestMessage bits. Throws InvalidInput for others.
CarrierSet CarriersOf(const SecretKey& key, Index messageBits);
constexpr Index LargestMessage = 1024;

/// Words of the code that a message and its check fill, and bits of message that so many words hold beside
/// the check; 0 when the check alone fills them.
Index WordsOf(Index messageBits);
Index MessageBitsOf(Index words);

/// Bits of check that fill the last word beside a message of this length.
Index CheckBitsOf(Index messageBits);

/// The message and its check: what the code protects.
std::string DataOf(const std::string& message, const SecretKey& key, Index checkBits);

/// What the carriers hold for data, 12 bits of it a word. Bit i of word b sits in carrier i * words + b,
/// so that what happens to some waves is spread over all words.
std::string CodeOf(const std::string& data);

/// Steps that carriers are quantised with, in units of (scale of the frame)^3: a geometric series,
/// so that a reader can try them all.
constexpr int NumberOfSteps = 80;
double StepOfNumber(int number);

} // namespace spectralwatermark

#endif

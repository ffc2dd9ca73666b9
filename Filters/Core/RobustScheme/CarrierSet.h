// SPDX-License-Identifier: BSD-3-Clause
/// The carriers of the robust scheme (see RobustEmbedding.h): their wave vectors, the lattices that
/// they are quantised with, and the code that they hold.
#ifndef SpectralWatermark_Core_RobustScheme_CarrierSet_h
#define SpectralWatermark_Core_RobustScheme_CarrierSet_h

#include "Core/Payload/SecretKey.h"
#include "Core/Support/Types.h"

#include <string>

namespace spectralwatermark
{

/// The carriers that a secret key and a message length determine. Wave w has two carriers: the real
/// part of the transform is carrier w, the imaginary part is carrier w + Waves.rows().
struct CarrierSet
{
  Eigen::MatrixXd Waves;  ///< wave vectors, a row each, in 1 / scale of the frame
  Eigen::VectorXd Dither; ///< the dither of each carrier, in [0, 1) steps
  std::string Whitening;  ///< the whitening bit of each carrier, 0 or 1
  Index MessageBits = 0;  ///< the length of the message
  Index CheckBits = 0;    ///< the length of its check

  Index Count() const { return this->Dither.size(); }
};

/// The longest message that the robust scheme embeds, in bits.
constexpr Index LargestMessage = 1024;

/// The carriers for messages of this length. Throws InvalidInput unless it is from 1 to
/// LargestMessage.
CarrierSet CarriersOf(const SecretKey& key, Index messageBits);

/// The number of code words that a message of this length and its check fill.
Index WordsOf(Index messageBits);

/// The length of the longest message that this many code words hold together with its check, at
/// most LargestMessage; 0 when the check alone fills them.
Index MessageBitsOf(Index words);

/// The length of the check of a message of this length: at least 20 bits, and as many as fill the
/// last code word.
Index CheckBitsOf(Index messageBits);

/// The data that the code protects: the message, followed by its check of `checkBits` bits.
std::string DataOf(const std::string& message, const SecretKey& key, Index checkBits);

/// The code bits that the carriers hold for `data`, whose length is a multiple of 12. Carrier
/// i * words + b holds bit i of word b, so that damage to a few waves is spread over all words.
std::string CodeOf(const std::string& data);

/// The number of quantisation steps. They form a geometric series, short enough for a reader to try
/// them all.
constexpr int NumberOfSteps = 80;

/// The quantisation step with this number, from 0 to NumberOfSteps - 1, in (scale of the frame)^3.
double StepOfNumber(int number);

} // namespace spectralwatermark

#endif

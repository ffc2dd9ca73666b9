// SPDX-License-Identifier: BSD-3-Clause
/// The extended binary Golay code, which encodes 12 bits in 24.
///
/// Any two code words differ in at least 8 bits, so up to 3 wrong bits of 24 are always corrected;
/// soft decisions correct more. The code is that of M. J. E. Golay, "Notes on Digital Coding"
/// (1949), with the generator polynomial x^11 + x^9 + x^7 + x^6 + x^5 + x + 1 and a parity bit.
#ifndef SpectralWatermark_Core_Payload_GolayCode_h
#define SpectralWatermark_Core_Payload_GolayCode_h

#include <Eigen/Core>

#include <cstdint>

namespace spectralwatermark
{

/// The number of data bits in a code word.
constexpr int GolayDataBits = 12;

/// The length of a code word in bits.
constexpr int GolayCodeBits = 24;

/// Received soft bits: a row per word, 24 columns. A positive value speaks for a 0, a negative one
/// for a 1, and the magnitude is the confidence.
using SoftWords = Eigen::Ref<const Eigen::MatrixXf, 0, Eigen::OuterStride<>>;

/// Encodes the lowest 12 bits of `data`. In the code word, the lowest 12 bits are the data and the
/// others are the check bits.
std::uint32_t GolayEncode(std::uint32_t data);

/// Decodes the first row of `soft` to the 12 data bits whose code word fits best (maximum
/// likelihood). Ties are broken in a fixed order. Sets `fit` to the correlation with that word: the
/// sum of the soft bits, each negated where the word has a 1.
std::uint32_t GolayDecode(const SoftWords& soft, float& fit);

/// The `fit` of GolayDecode() for every row of `soft`.
Eigen::VectorXf GolayFits(const SoftWords& soft);

} // namespace spectralwatermark

#endif

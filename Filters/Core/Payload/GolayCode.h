// SPDX-License-Identifier: BSD-3-Clause
/// The extended binary Golay code: 12 bits in 24, any two words at least 8 apart, so that 3 wrong
/// bits of 24 are always mended and soft decisions mend more.
///
/// M. J. E. Golay, "Notes on Digital Coding" (1949); the generator polynomial is
/// x^11 + x^9 + x^7 + x^6 + x^5 + x + 1, with a parity bit.
#ifndef SpectralWatermark_Core_Payload_GolayCode_h
#define SpectralWatermark_Core_Payload_GolayCode_h

#include <Eigen/Core>

#include <cstdint>

namespace spectralwatermark
{

constexpr int GolayDataBits = 12;
constexpr int GolayCodeBits = 24;

/// Soft bits, positive where they say 0: a row for each word, 24 columns.
using SoftWords = Eigen::Ref<const Eigen::MatrixXf, 0, Eigen::OuterStride<>>;

/// The lowest 12 bits are the data's, the others the check's.
std::uint32_t GolayEncode(std::uint32_t data);

/// The data whose word fits the soft bits of one word best, always the same among equals. `fit` becomes
/// their sum, each with the sign that the word gives it.
std::uint32_t GolayDecode(const SoftWords& soft, float& fit);

/// What `fit` becomes for each of the words.
Eigen::VectorXf GolayFits(const SoftWords& soft);

} // namespace spectralwatermark

#endif

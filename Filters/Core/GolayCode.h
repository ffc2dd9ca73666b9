// SPDX-License-Identifier: BSD-3-Clause
/// The extended binary Golay code: 12 bits in 24, any two words at least 8 apart, so that 3 wrong
/// bits of 24 are always mended and soft decisions mend more.
///
/// M. J. E. Golay, "Notes on Digital Coding" (1949); the generator polynomial is
/// x^11 + x^9 + x^7 + x^6 + x^5 + x + 1, with a parity bit.
#ifndef SpectralWatermark_Core_GolayCode_h
#define SpectralWatermark_Core_GolayCode_h

#include <array>
#include <cstdint>

namespace spectralwatermark
{

constexpr int GolayDataBits = 12;
constexpr int GolayCodeBits = 24;

/// The lowest 12 bits are the data's, the others the check's.
std::uint32_t GolayEncode(std::uint32_t data);

/// The data whose word fits best: the largest sum of `soft`, each taken positive where the word has
/// a 0 and negative where it has a 1. Among equals the smallest data. `score` becomes that sum.
std::uint32_t GolayDecode(const std::array<double, GolayCodeBits>& soft, double& score);

} // namespace spectralwatermark

#endif

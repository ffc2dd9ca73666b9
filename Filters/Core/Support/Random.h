// SPDX-License-Identifier: BSD-3-Clause
/// Random numbers that depend on (seed, element) alone, so that they are the same on every
/// platform, for any number of threads and any order of evaluation.
#ifndef SpectralWatermark_Core_Support_Random_h
#define SpectralWatermark_Core_Support_Random_h

#include "Core/Support/Types.h"

#include <cstdint>
#include <vector>

namespace spectralwatermark
{

/// A uniform number in (0, 1).
double UniformRandom(std::uint64_t seed, std::uint64_t element);

/// A standard normal number (mean 0, variance 1).
double NormalRandom(std::uint64_t seed, std::uint64_t element);

/// A random permutation of the numbers from 0 to count - 1.
std::vector<Index> RandomOrder(Index count, std::uint64_t seed);

} // namespace spectralwatermark

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef SpectralWatermark_Core_Noise_h
#define SpectralWatermark_Core_Noise_h

#include "TriangleMesh.h"

#include <cstdint>

namespace spectralwatermark
{

/// A number in (0, 1), uniform, that depends on (seed, element) alone: the same on every platform,
/// for any number of threads and any order of evaluation.
double UniformRandom(std::uint64_t seed, std::uint64_t element);

/// A standard normal number likewise.
double NormalRandom(std::uint64_t seed, std::uint64_t element);

/// Section 3.3.3: every vertex moved along its normal by factor * N(0, 1) * mean edge length.
TriangleMesh::PointMatrix NoiseAlongNormals(const TriangleMesh& mesh, double factor,
  std::uint64_t seed);

} // namespace spectralwatermark

#endif

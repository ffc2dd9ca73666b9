// SPDX-License-Identifier: BSD-3-Clause
/// Attacks on the points of a mesh: those of the paper, and of Wang, Lavoue, Denis and Baskurt, "A Benchmark
/// for 3-D Mesh Watermarking" (2010). Random numbers depend on (seed, vertex) alone.
#ifndef SpectralWatermark_Core_Attacks_Attacks_h
#define SpectralWatermark_Core_Attacks_Attacks_h

#include "Core/Mesh/TriangleMesh.h"
#include "Core/Support/Progress.h"

#include <cstdint>

namespace spectralwatermark
{

/// Moves every vertex along its normal by factor * N(0, 1) * mean edge length (paper, 3.3.3).
TriangleMesh::PointMatrix NoiseAlongNormals(const TriangleMesh& mesh, double factor,
  std::uint64_t seed);

/// Every coordinate plus U[-1, 1] times amplitude times MeanDistanceToCentre().
TriangleMesh::PointMatrix NoiseUniform(const TriangleMesh& mesh, double amplitude,
  std::uint64_t seed);

/// Umbrella smoothing (UmbrellaSmoothing), `iterations` times.
TriangleMesh::PointMatrix LaplacianSmoothing(const TriangleMesh& mesh, double factor,
  int iterations, const Progress& progress);

/// Every coordinate rounded to the nearest of 2^bits levels along its axis, evenly from one side of the
/// bounding box to the other, as mesh coders do.
TriangleMesh::PointMatrix Quantize(const TriangleMesh& mesh, int bits);

/// x -> scale * rotation * x + translation.
struct SimilarityTransform
{
  Eigen::Matrix3d Rotation;    ///< uniform over all rotations
  double Scale;                ///< from 0.1 to 10, uniform in its logarithm
  Eigen::Vector3d Translation; ///< up to five MeanDistanceToCentre() along each axis
};
SimilarityTransform RandomSimilarity(const TriangleMesh& mesh, std::uint64_t seed);

} // namespace spectralwatermark

#endif

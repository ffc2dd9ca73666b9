// SPDX-License-Identifier: BSD-3-Clause
/// Attacks that move the points of a mesh: those of the paper, and those of Wang, Lavoue, Denis,
/// Baskurt and He, "A Benchmark for 3-D Mesh Watermarking" (2010).
///
/// Each function returns the new points, n x 3. Random numbers depend on (seed, vertex) alone, so
/// the result does not depend on the number of threads.
#ifndef SpectralWatermark_Core_Attacks_Attacks_h
#define SpectralWatermark_Core_Attacks_Attacks_h

#include "Core/Mesh/TriangleMesh.h"
#include "Core/Support/Progress.h"

#include <cstdint>

namespace spectralwatermark
{

/// Moves every vertex along its normal by factor * N(0, 1) * MeanEdgeLength() (paper, 3.3.3).
TriangleMesh::PointMatrix NoiseAlongNormals(const TriangleMesh& mesh, double factor,
  std::uint64_t seed);

/// Adds amplitude * U[-1, 1] * MeanDistanceToCentre() to every coordinate (benchmark).
TriangleMesh::PointMatrix NoiseUniform(const TriangleMesh& mesh, double amplitude,
  std::uint64_t seed);

/// Smooths the mesh `iterations` times by UmbrellaSmoothing with this factor (benchmark). Vertices
/// on boundaries stay. Throws Aborted.
TriangleMesh::PointMatrix LaplacianSmoothing(const TriangleMesh& mesh, double factor,
  int iterations, const Progress& progress);

/// Rounds every coordinate to the nearest of 2^bits levels, which divide each axis evenly from one
/// side of the bounding box to the other, as mesh coders do (benchmark).
TriangleMesh::PointMatrix Quantize(const TriangleMesh& mesh, int bits);

/// The map x -> Scale * Rotation * x + Translation.
struct SimilarityTransform
{
  Eigen::Matrix3d Rotation;
  double Scale;
  Eigen::Vector3d Translation; ///< in the model's units
};

/// A random similarity transform: the rotation is uniform over all rotations, the logarithm of the
/// scale is uniform from 0.1 to 10, and the translation is uniform up to five times
/// MeanDistanceToCentre() along each axis.
SimilarityTransform RandomSimilarity(const TriangleMesh& mesh, std::uint64_t seed);

} // namespace spectralwatermark

#endif

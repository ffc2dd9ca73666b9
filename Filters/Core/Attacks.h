// SPDX-License-Identifier: BSD-3-Clause
/// What the benchmark of Wang, Lavoue, Denis and Baskurt does to meshes: "A Benchmark for 3-D Mesh
/// Watermarking" (2010). Random numbers depend on (seed, vertex) alone.
#ifndef SpectralWatermark_Core_Attacks_h
#define SpectralWatermark_Core_Attacks_h

#include "Progress.h"
#include "TriangleMesh.h"

#include <cstdint>
#include <vector>

namespace spectralwatermark
{

/// Mean distance of the vertices to their centre: the benchmark's unit of length.
double MeanDistanceToCentre(const TriangleMesh& mesh);

/// Every coordinate plus U[-1, 1] times amplitude times MeanDistanceToCentre().
TriangleMesh::PointMatrix NoiseUniform(const TriangleMesh& mesh, double amplitude,
  std::uint64_t seed);

/// Smoothing by the umbrella operator: v + factor * (mean of v's neighbours - v), all vertices at once.
/// Vertices of edges that do not have two triangles stay where they are.
class UmbrellaSmoothing
{
public:
  explicit UmbrellaSmoothing(const TriangleMesh& mesh);

  TriangleMesh::PointMatrix Apply(const TriangleMesh::PointMatrix& points, double factor) const;

private:
  std::vector<std::vector<Index>> Neighbours; // none of vertices that stay
};

/// So many times.
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

/// The numbers from 0 to count - 1 in a random order.
std::vector<Index> RandomOrder(Index count, std::uint64_t seed);

/// Kobbelt's subdivision ("√3-Subdivision", 2000): a vertex in the middle of every triangle, old
/// edges flipped, old vertices relaxed. Boundaries keep their edges and vertices, and so do edges
/// with more than two triangles.
TriangleMesh SubdivideSqrt3(const TriangleMesh& mesh, int times, const Progress& progress);

} // namespace spectralwatermark

#endif

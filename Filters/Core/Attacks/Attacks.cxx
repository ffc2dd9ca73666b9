// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Attacks/Attacks.h"

#include "Core/Mesh/Measures.h"
#include "Core/Mesh/UmbrellaSmoothing.h"
#include "Core/Support/Random.h"

#include <Eigen/Geometry>

#include <cmath>

namespace spectralwatermark
{

TriangleMesh::PointMatrix NoiseAlongNormals(const TriangleMesh& mesh, double factor,
  std::uint64_t seed)
{
  const double scale = factor * MeanEdgeLength(mesh);
  TriangleMesh::PointMatrix points = mesh.Points;
  const TriangleMesh::PointMatrix normals = VertexNormals(mesh);
  for (Index v = 0; v < points.rows(); ++v)
  {
    points.row(v) += scale * NormalRandom(seed, static_cast<std::uint64_t>(v)) * normals.row(v);
  }
  return points;
}

TriangleMesh::PointMatrix NoiseUniform(const TriangleMesh& mesh, double amplitude,
  std::uint64_t seed)
{
  const double scale = amplitude * MeanDistanceToCentre(mesh);
  TriangleMesh::PointMatrix points = mesh.Points;
  for (Index v = 0; v < points.rows(); ++v)
  {
    for (Index axis = 0; axis < 3; ++axis)
    {
      const double u = UniformRandom(seed, static_cast<std::uint64_t>(3 * v + axis));
      points(v, axis) += scale * (2.0 * u - 1.0);
    }
  }
  return points;
}

TriangleMesh::PointMatrix LaplacianSmoothing(const TriangleMesh& mesh, double factor,
  int iterations, const Progress& progress)
{
  const UmbrellaSmoothing smoothing(mesh);
  TriangleMesh::PointMatrix points = mesh.Points;
  for (int k = 0; k < iterations; ++k)
  {
    points = smoothing.Apply(points, factor);
    progress.Report(static_cast<double>(k + 1) / iterations);
  }
  return points;
}

TriangleMesh::PointMatrix Quantize(const TriangleMesh& mesh, int bits)
{
  const double steps = std::ldexp(1.0, bits) - 1.0;
  TriangleMesh::PointMatrix points = mesh.Points;
  for (Index axis = 0; axis < 3; ++axis)
  {
    const double lowest = points.col(axis).minCoeff();
    const double size = points.col(axis).maxCoeff() - lowest;
    for (Index v = 0; v < points.rows() && size > 0.0; ++v)
    {
      points(v, axis) =
        lowest + std::round((points(v, axis) - lowest) / size * steps) / steps * size;
    }
  }
  return points;
}

SimilarityTransform RandomSimilarity(const TriangleMesh& mesh, std::uint64_t seed)
{
  // A normally distributed vector of length 1 is a uniformly distributed unit quaternion.
  Eigen::Vector4d quaternion;
  for (Index k = 0; k < 4; ++k)
  {
    quaternion[k] = NormalRandom(seed, static_cast<std::uint64_t>(k));
  }
  quaternion.normalize();
  SimilarityTransform transform;
  transform.Rotation =
    Eigen::Quaterniond(quaternion[0], quaternion[1], quaternion[2], quaternion[3])
      .toRotationMatrix();
  transform.Scale = std::pow(10.0, 2.0 * UniformRandom(seed, 4) - 1.0);
  for (Index axis = 0; axis < 3; ++axis)
  {
    transform.Translation[axis] = 5.0 * MeanDistanceToCentre(mesh) *
      (2.0 * UniformRandom(seed, static_cast<std::uint64_t>(5 + axis)) - 1.0);
  }
  return transform;
}

} // namespace spectralwatermark

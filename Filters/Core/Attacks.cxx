// SPDX-License-Identifier: BSD-3-Clause
#include "Attacks.h"

#include "Noise.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

namespace spectralwatermark
{

namespace
{

constexpr double Pi = 3.14159265358979323846;

// The neighbours of every vertex all of whose edges have two triangles; none of the others.
std::vector<std::vector<Index>> InnerNeighbours(const TriangleMesh& mesh,
  const std::map<Edge, std::vector<Index>>& triangles)
{
  const auto count = static_cast<std::size_t>(mesh.NumberOfVertices());
  std::vector<std::vector<Index>> neighbours(count);
  std::vector<bool> isInner(count, true);
  for (const auto& [edge, sides] : triangles)
  {
    const auto a = static_cast<std::size_t>(edge.first);
    const auto b = static_cast<std::size_t>(edge.second);
    neighbours[a].push_back(edge.second);
    neighbours[b].push_back(edge.first);
    isInner[a] = isInner[a] && sides.size() == 2;
    isInner[b] = isInner[b] && sides.size() == 2;
  }
  for (std::size_t v = 0; v < count; ++v)
  {
    if (!isInner[v])
    {
      neighbours[v].clear();
    }
  }
  return neighbours;
}

// v + factor(valence) * (mean of the neighbours - v) where there are any.
template <typename Factor>
TriangleMesh::PointMatrix Relax(const TriangleMesh::PointMatrix& points,
  const std::vector<std::vector<Index>>& neighboursOf, const Factor& factor)
{
  TriangleMesh::PointMatrix relaxed = points;
  for (Index v = 0; v < points.rows(); ++v)
  {
    const std::vector<Index>& neighbours = neighboursOf[static_cast<std::size_t>(v)];
    if (neighbours.empty())
    {
      continue;
    }
    Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
    for (const Index w : neighbours)
    {
      sum += points.row(w);
    }
    const auto valence = static_cast<double>(neighbours.size());
    relaxed.row(v) += factor(valence) * (sum / valence - points.row(v));
  }
  return relaxed;
}

} // namespace

double MeanDistanceToCentre(const TriangleMesh& mesh)
{
  const Eigen::RowVector3d centre = mesh.Points.colwise().mean();
  return (mesh.Points.rowwise() - centre).rowwise().norm().mean();
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

UmbrellaSmoothing::UmbrellaSmoothing(const TriangleMesh& mesh)
  : Neighbours(InnerNeighbours(mesh, TrianglesOfEdges(mesh)))
{
}

TriangleMesh::PointMatrix UmbrellaSmoothing::Apply(const TriangleMesh::PointMatrix& points,
  double factor) const
{
  return Relax(points, this->Neighbours, [factor](double) { return factor; });
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
  // A uniform unit quaternion is a normal vector of unit length.
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

std::vector<Index> RandomOrder(Index count, std::uint64_t seed)
{
  std::vector<Index> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), Index{ 0 });
  // Fisher and Yates; std::shuffle differs between implementations.
  for (Index k = count - 1; k > 0; --k)
  {
    const auto other = static_cast<Index>(
      UniformRandom(seed, static_cast<std::uint64_t>(k)) * static_cast<double>(k + 1));
    std::swap(order[static_cast<std::size_t>(k)], order[static_cast<std::size_t>(other)]);
  }
  return order;
}

namespace
{

TriangleMesh SubdivideOnce(const TriangleMesh& mesh)
{
  const std::map<Edge, std::vector<Index>> sides = TrianglesOfEdges(mesh);
  const Index n = mesh.NumberOfVertices();
  TriangleMesh fine;
  fine.Points.resize(n + mesh.NumberOfTriangles(), 3);
  fine.Points.topRows(n) = Relax(mesh.Points, InnerNeighbours(mesh, sides),
    [](double valence) { return (4.0 - 2.0 * std::cos(2.0 * Pi / valence)) / 9.0; });
  std::vector<std::array<Index, 3>> triangles;
  for (Index t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    const auto corners = mesh.Triangles.row(t);
    const Index middle = n + t;
    fine.Points.row(middle) =
      (mesh.Points.row(corners[0]) + mesh.Points.row(corners[1]) + mesh.Points.row(corners[2])) /
      3.0;
    for (int corner = 0; corner < 3; ++corner)
    {
      const Index a = corners[corner];
      const Index b = corners[(corner + 1) % 3];
      const std::vector<Index>& both = sides.at({ std::min(a, b), std::max(a, b) });
      if (both.size() != 2)
      {
        triangles.push_back({ a, b, middle });
        continue;
      }
      if (both[0] == t) // once for both sides
      {
        triangles.push_back({ a, n + both[1], middle });
        triangles.push_back({ n + both[1], b, middle });
      }
    }
  }
  fine.Triangles.resize(static_cast<Index>(triangles.size()), 3);
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      fine.Triangles(static_cast<Index>(t), corner) =
        triangles[t][static_cast<std::size_t>(corner)];
    }
  }
  return fine;
}

} // namespace

TriangleMesh SubdivideSqrt3(const TriangleMesh& mesh, int times, const Progress& progress)
{
  TriangleMesh fine = mesh;
  for (int k = 0; k < times; ++k)
  {
    fine = SubdivideOnce(fine);
    progress.Report(static_cast<double>(k + 1) / times);
  }
  return fine;
}

} // namespace spectralwatermark

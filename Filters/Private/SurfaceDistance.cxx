// SPDX-License-Identifier: BSD-3-Clause
#include "Private/SurfaceDistance.h"

#include "Core/Mesh/Measures.h"

#include <algorithm>
#include <cmath>

namespace spectralwatermark
{

namespace
{

constexpr double LeastSamples = 50000.0;

// Points of a surface, each standing for some area.
struct Samples
{
  std::vector<Eigen::RowVector3d> Points;
  std::vector<double> Areas;
};

// The middles of parts^2 triangles alike.
void Divide(const TriangleMesh& mesh, Index triangle, double area, int parts, Samples& samples)
{
  const Eigen::RowVector3d a = mesh.Points.row(mesh.Triangles(triangle, 0));
  const Eigen::RowVector3d u = (mesh.Points.row(mesh.Triangles(triangle, 1)) - a) / parts;
  const Eigen::RowVector3d v = (mesh.Points.row(mesh.Triangles(triangle, 2)) - a) / parts;
  for (int i = 0; i < parts; ++i)
  {
    for (int j = 0; i + j < parts; ++j)
    {
      const auto add = [&](double offset)
      {
        samples.Points.emplace_back(a + (i + offset) * u + (j + offset) * v);
        samples.Areas.push_back(area / (parts * parts));
      };
      add(1.0 / 3.0);
      if (i + j + 1 < parts)
      {
        add(2.0 / 3.0); // the one that points the other way
      }
    }
  }
}

Samples SampleSurface(const TriangleMesh& mesh)
{
  Eigen::VectorXd areas(mesh.NumberOfTriangles());
  for (Index t = 0; t < areas.size(); ++t)
  {
    areas[t] = 0.5 * AreaVector(mesh, t).norm();
  }
  const double most = areas.sum() / LeastSamples;
  Samples samples;
  for (Index t = 0; t < areas.size(); ++t)
  {
    const double parts = most > 0.0 ? std::ceil(std::sqrt(areas[t] / most)) : 1.0;
    Divide(mesh, t, areas[t], std::max(1, static_cast<int>(parts)), samples);
  }
  return samples;
}

} // namespace

SurfaceDistance DistanceTo(const ClosestPoints& other, const TriangleMesh& mesh, int threads,
  const Progress& progress)
{
  const Samples samples = SampleSurface(mesh);
  const auto inside = static_cast<Index>(samples.Points.size());
  TriangleMesh::PointMatrix points(inside + mesh.NumberOfVertices(), 3);
  for (Index p = 0; p < inside; ++p)
  {
    points.row(p) = samples.Points[static_cast<std::size_t>(p)];
  }
  points.bottomRows(mesh.NumberOfVertices()) = mesh.Points;
  const std::vector<SurfacePoint> closest = other.To(points, threads, progress);
  const auto apart = [&closest](Index p) { return closest[static_cast<std::size_t>(p)].Distance; };
  SurfaceDistance distance;
  double sum = 0.0;
  double area = 0.0;
  for (Index p = 0; p < inside; ++p)
  {
    const double part = samples.Areas[static_cast<std::size_t>(p)];
    sum += part * apart(p) * apart(p);
    area += part;
    distance.Largest = std::max(distance.Largest, apart(p));
  }
  distance.RootMeanSquare = area > 0.0 ? std::sqrt(sum / area) : 0.0;
  distance.AtVertices.resize(mesh.NumberOfVertices());
  for (Index v = 0; v < mesh.NumberOfVertices(); ++v)
  {
    distance.AtVertices[v] = apart(inside + v);
  }
  distance.Largest = std::max(distance.Largest, distance.AtVertices.maxCoeff());
  return distance;
}

} // namespace spectralwatermark

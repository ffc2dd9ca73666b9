// SPDX-License-Identifier: BSD-3-Clause
#include "Private/SurfaceComparison.h"

#include "Core/Distortion/BallNeighbourhood.h"
#include "Core/Distortion/StructuralDistortion.h"
#include "Core/Mesh/Measures.h"

#include <algorithm>
#include <cmath>

namespace spectralwatermark
{

namespace
{

// The smallest number of samples of a surface.
constexpr double LeastSamples = 50000.0;

// Points of a surface, each of which stands for some area.
struct Samples
{
  std::vector<Eigen::RowVector3d> Points;
  std::vector<double> Areas;
};

// Divides a triangle into parts^2 congruent ones and adds their centroids to the samples.
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
        // The neighbouring triangle, which points the other way.
        add(2.0 / 3.0);
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

// One of the two meshes of MSDM2, with the points of the other one that are closest to its
// vertices.
struct Side
{
  Side(const TriangleMesh& mesh, const ClosestPoints& other, int threads, const Progress& progress)
    : Balls(mesh)
    , Matches(other.To(mesh.Points, threads, progress))
    , Local(Eigen::VectorXd::Zero(mesh.NumberOfVertices()))
  {
  }

  BallNeighbourhood Balls;
  std::vector<SurfacePoint> Matches;
  Eigen::VectorXd Local;
};

} // namespace

SurfaceDistance DistanceTo(const ClosestPoints& other, const TriangleMesh& mesh, int threads,
  const Progress& progress)
{
  const Samples samples = SampleSurface(mesh);
  const auto inside = static_cast<Index>(samples.Points.size());
  TriangleMesh::PointMatrix points(inside + mesh.NumberOfVertices(), 3);
  for (Index p = 0; p < inside; ++p)
  {
    points.row(p) = samples.Points[p];
  }
  points.bottomRows(mesh.NumberOfVertices()) = mesh.Points;
  const std::vector<SurfacePoint> closest = other.To(points, threads, progress);
  const auto apart = [&closest](Index p) { return closest[p].Distance; };
  SurfaceDistance distance;
  double sum = 0.0;
  double area = 0.0;
  for (Index p = 0; p < inside; ++p)
  {
    const double part = samples.Areas[p];
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

PerceptualDistance Msdm2(const ClosestPoints& reference, const ClosestPoints& distorted,
  int threads, const Progress& progress)
{
  Side before(reference.Mesh(), distorted, threads, progress.Part(0.0, 0.1));
  Side after(distorted.Mesh(), reference, threads, progress.Part(0.1, 0.2));
  const double side = LongestSide(reference.Mesh().Points);
  const double part = 1.0 / static_cast<double>(Msdm2Radii.size());
  double done = 0.2;
  for (const double radius : Msdm2Radii)
  {
    const double ball = radius * side;
    const StructuralWindow window{ 5.0 * ball, true, 1 };
    const Eigen::VectorXd old = side * NormalCycleCurvature(before.Balls, ball, threads);
    const Eigen::VectorXd now = side * NormalCycleCurvature(after.Balls, ball, threads);
    progress.Report(done + 0.3 * 0.8 * part);
    before.Local += part *
      LocalStructuralDistortion(before.Balls, old, distorted.Interpolate(now, before.Matches),
        window, threads);
    progress.Report(done + 0.6 * 0.8 * part);
    after.Local += part *
      LocalStructuralDistortion(after.Balls, now, reference.Interpolate(old, after.Matches), window,
        threads);
    done += 0.8 * part;
    progress.Report(done);
  }
  return { 0.5 * (CubicMean(before.Local) + CubicMean(after.Local)), after.Local };
}

} // namespace spectralwatermark

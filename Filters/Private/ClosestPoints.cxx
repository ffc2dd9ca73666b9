// SPDX-License-Identifier: BSD-3-Clause
#include "Private/ClosestPoints.h"

#include "Core/Support/Parallel.h"
#include "Private/FilterExecution.h"
#include "Private/PolyDataMesh.h"

#include <vtkDataSet.h>
#include <vtkGenericCell.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>
#include <vtkStaticCellLocator.h>

#include <algorithm>
#include <string>

namespace spectralwatermark
{

namespace
{

// The number of points that one task takes.
constexpr Index PointsPerTask = 512;

// The number of points from one progress report to the next. An abort takes effect at a report.
constexpr Index PointsPerReport = 64 * PointsPerTask;

// Non-negative weights with sum 1. The weights that VTK computes are arbitrary in a triangle with
// almost no area.
Eigen::RowVector3d ValidWeights(const Eigen::RowVector3d& weights)
{
  const Eigen::RowVector3d inside = weights.cwiseMax(0.0).cwiseMin(1.0);
  const double sum = inside.sum();
  return sum > 0.0 ? Eigen::RowVector3d(inside / sum) : Eigen::RowVector3d::Constant(1.0 / 3.0);
}

SurfacePoint Closest(vtkStaticCellLocator* locator, vtkGenericCell* cell,
  const Eigen::RowVector3d& point)
{
  const NearestPoint nearest = FindNearest(locator, cell, point);
  SurfacePoint found;
  found.Triangle = nearest.Triangle;
  if (nearest.Triangle < 0)
  {
    return found;
  }
  found.Distance = nearest.Distance;
  // The search leaves the last cell that it tried, not the closest one.
  locator->GetDataSet()->GetCell(nearest.Triangle, cell);
  double inside[3];
  double parametric[3];
  int subId = 0;
  double unused = 0.0;
  cell->EvaluatePosition(nearest.Point.data(), inside, subId, parametric, unused,
    found.Weights.data());
  found.Weights = ValidWeights(found.Weights);
  return found;
}

} // namespace

NearestPoint FindNearest(vtkStaticCellLocator* locator, vtkGenericCell* cell,
  const Eigen::RowVector3d& from)
{
  NearestPoint nearest;
  vtkIdType triangle = -1;
  int subId = 0;
  double squared = 0.0;
  locator->FindClosestPoint(from.data(), nearest.Point.data(), cell, triangle, subId, squared);
  nearest.Triangle = triangle;
  nearest.Distance = (nearest.Point - from).norm();
  return nearest;
}

ClosestPoints::ClosestPoints(const TriangleMesh& surface)
  : Surface(surface)
  , PolyData(ToPolyData(surface, false))
{
  this->Locator->SetDataSet(this->PolyData);
  // The locator returns the first of several equally close triangles in a bin. It is built
  // sequentially, so that their order does not depend on threads.
  vtkSMPTools::LocalScope(vtkSMPTools::Config(std::string("Sequential")),
    [this]() { this->Locator->BuildLocator(); });
}

ClosestPoints::~ClosestPoints() = default;

std::vector<SurfacePoint> ClosestPoints::To(const TriangleMesh::PointMatrix& points, int threads,
  const Progress& progress) const
{
  std::vector<SurfacePoint> found(points.rows());
  for (Index begin = 0; begin < points.rows(); begin += PointsPerReport)
  {
    const Index end = std::min(points.rows(), begin + PointsPerReport);
    ForEachTask(threads, (end - begin + PointsPerTask - 1) / PointsPerTask,
      [&](Index task)
      {
        const vtkNew<vtkGenericCell> cell;
        const Index last = std::min(end, begin + (task + 1) * PointsPerTask);
        for (Index p = begin + task * PointsPerTask; p < last; ++p)
        {
          found[p] = Closest(this->Locator, cell, points.row(p));
        }
      });
    progress.Report(static_cast<double>(end) / static_cast<double>(points.rows()));
  }
  const auto isMissing = [](const SurfacePoint& point) { return point.Triangle < 0; };
  if (std::any_of(found.begin(), found.end(), isMissing))
  {
    throw InvalidInput("",
      "no triangle of the surface has an area, so there is nothing to measure the distance from",
      "repair the mesh");
  }
  return found;
}

Eigen::MatrixXd ClosestPoints::Interpolate(const Eigen::MatrixXd& values,
  const std::vector<SurfacePoint>& points) const
{
  Eigen::MatrixXd interpolated = Eigen::MatrixXd::Zero(points.size(), values.cols());
  for (Index p = 0; p < interpolated.rows(); ++p)
  {
    const SurfacePoint& point = points[p];
    for (int corner = 0; corner < 3; ++corner)
    {
      interpolated.row(p) +=
        point.Weights[corner] * values.row(this->Surface.Triangles(point.Triangle, corner));
    }
  }
  return interpolated;
}

Eigen::MatrixXd TransferToVertices(const TriangleMesh& from, const Eigen::MatrixXd& values,
  const TriangleMesh& to)
{
  if (SameTriangles(from, to))
  {
    return values;
  }
  const ClosestPoints closest(from);
  return closest.Interpolate(values, closest.To(to.Points, ThreadsOfVtk(), Progress()));
}

} // namespace spectralwatermark

// SPDX-License-Identifier: BSD-3-Clause
#include "Private/ClosestPoints.h"

#include "Core/Parallel.h"
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

constexpr Index PointsPerTask = 512;
constexpr Index PointsPerReport = 64 * PointsPerTask; // an abort is answered in between

SurfacePoint Closest(vtkStaticCellLocator* locator, vtkGenericCell* cell,
  const Eigen::RowVector3d& point)
{
  const double from[3] = { point[0], point[1], point[2] };
  double closest[3];
  vtkIdType triangle = 0;
  int subId = 0;
  double distance2 = 0.0;
  locator->FindClosestPoint(from, closest, cell, triangle, subId, distance2);
  SurfacePoint found;
  found.Triangle = triangle;
  locator->GetDataSet()->GetCell(triangle, cell); // the search leaves the last one it tried
  double inside[3];
  double parametric[3];
  double unused = 0.0;
  if (cell->EvaluatePosition(closest, inside, subId, parametric, unused, found.Weights.data()) < 0)
  {
    found.Weights.setConstant(1.0 / 3.0); // a triangle without area
  }
  found.Distance = (Eigen::RowVector3d(closest[0], closest[1], closest[2]) - point).norm();
  return found;
}

} // namespace

ClosestPoints::ClosestPoints(const TriangleMesh& surface)
  : Surface(surface)
  , PolyData(ToPolyData(surface, false))
{
  this->Locator->SetDataSet(this->PolyData);
  // Of triangles that are equally close, the one that comes first in its bin is taken: their order must
  // not depend on threads.
  vtkSMPTools::LocalScope(vtkSMPTools::Config(std::string("Sequential")),
    [this]() { this->Locator->BuildLocator(); });
}

ClosestPoints::~ClosestPoints() = default;

std::vector<SurfacePoint> ClosestPoints::To(const TriangleMesh::PointMatrix& points, int threads,
  const Progress& progress) const
{
  std::vector<SurfacePoint> found(static_cast<std::size_t>(points.rows()));
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
          found[static_cast<std::size_t>(p)] = Closest(this->Locator, cell, points.row(p));
        }
      });
    progress.Report(static_cast<double>(end) / static_cast<double>(points.rows()));
  }
  return found;
}

Eigen::MatrixXd ClosestPoints::Interpolate(const Eigen::MatrixXd& values,
  const std::vector<SurfacePoint>& points) const
{
  Eigen::MatrixXd interpolated =
    Eigen::MatrixXd::Zero(static_cast<Index>(points.size()), values.cols());
  for (Index p = 0; p < interpolated.rows(); ++p)
  {
    const SurfacePoint& point = points[static_cast<std::size_t>(p)];
    for (int corner = 0; corner < 3; ++corner)
    {
      interpolated.row(p) +=
        point.Weights[corner] * values.row(this->Surface.Triangles(point.Triangle, corner));
    }
  }
  return interpolated;
}

} // namespace spectralwatermark

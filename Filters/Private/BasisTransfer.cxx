// SPDX-License-Identifier: BSD-3-Clause
#include "Private/BasisTransfer.h"

#include <vtkGenericCell.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkStaticCellLocator.h>

#include <algorithm>

namespace spectralwatermark
{

namespace
{

bool SameTriangles(const TriangleMesh& a, const TriangleMesh& b)
{
  return a.NumberOfVertices() == b.NumberOfVertices() &&
    a.NumberOfTriangles() == b.NumberOfTriangles() && a.Triangles == b.Triangles;
}

} // namespace

Eigen::MatrixXd TransferToVertices(const TriangleMesh& from, const Eigen::MatrixXd& values,
  const TriangleMesh& to)
{
  if (SameTriangles(from, to))
  {
    return values;
  }
  const vtkSmartPointer<vtkPolyData> surface = ToPolyData(from, false);
  vtkNew<vtkStaticCellLocator> locator;
  locator->SetDataSet(surface);
  locator->BuildLocator();
  vtkNew<vtkGenericCell> cell;
  Eigen::MatrixXd transferred(to.NumberOfVertices(), values.cols());
  for (Index v = 0; v < to.NumberOfVertices(); ++v)
  {
    double point[3] = { to.Points(v, 0), to.Points(v, 1), to.Points(v, 2) };
    double closest[3];
    vtkIdType triangle = 0;
    int subId = 0;
    double distance2 = 0.0;
    locator->FindClosestPoint(point, closest, cell, triangle, subId, distance2);
    double parametric[3];
    double weights[3];
    double inside[3];
    if (cell->EvaluatePosition(closest, inside, subId, parametric, distance2, weights) < 0)
    {
      std::fill(weights, weights + 3, 1.0 / 3.0); // a triangle without area
    }
    transferred.row(v).setZero();
    for (int corner = 0; corner < 3; ++corner)
    {
      transferred.row(v) += weights[corner] * values.row(from.Triangles(triangle, corner));
    }
  }
  return transferred;
}

} // namespace spectralwatermark

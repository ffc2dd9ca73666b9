// SPDX-License-Identifier: BSD-3-Clause
#include "Private/BasisTransfer.h"

#include "Core/Support/Progress.h"

#include "Private/ClosestPoints.h"
#include "Private/FilterExecution.h"

namespace spectralwatermark
{

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

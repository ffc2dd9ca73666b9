// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Distortion/PointDifferences.h"

namespace spectralwatermark
{

TriangleMesh::PointMatrix GeometricLaplacian(const std::vector<Edge>& edges,
  const TriangleMesh::PointMatrix& points)
{
  // sum_j (v_i - v_j) / l_ij divided by sum_j 1 / l_ij. The differences come first, so that models
  // far from the origin lose no digits.
  TriangleMesh::PointMatrix sum = TriangleMesh::PointMatrix::Zero(points.rows(), 3);
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(points.rows());
  std::vector<Index> coincident;
  for (const auto& [i, j] : edges)
  {
    const Eigen::RowVector3d difference = points.row(i) - points.row(j);
    const double length = difference.norm();
    if (length > 0.0)
    {
      sum.row(i) += difference / length;
      sum.row(j) -= difference / length;
      weights[i] += 1.0 / length;
      weights[j] += 1.0 / length;
    }
    else
    {
      coincident.push_back(i);
      coincident.push_back(j);
    }
  }
  for (Index v = 0; v < points.rows(); ++v)
  {
    if (weights[v] > 0.0)
    {
      sum.row(v) /= weights[v];
    }
  }
  for (const Index v : coincident)
  {
    sum.row(v).setZero();
  }
  return sum;
}

Eigen::VectorXd GeometricDifference(const TriangleMesh::PointMatrix& reference,
  const TriangleMesh::PointMatrix& distorted)
{
  return (reference - distorted).rowwise().norm();
}

Eigen::VectorXd CurvatureDifference(const std::vector<Edge>& edges,
  const TriangleMesh::PointMatrix& reference, const TriangleMesh::PointMatrix& distorted)
{
  return (GeometricLaplacian(edges, reference) - GeometricLaplacian(edges, distorted))
    .rowwise()
    .norm();
}

} // namespace spectralwatermark

// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Harmonics/Transform.h"

#include <algorithm>

namespace spectralwatermark
{

Spectrum ForwardTransform(const ManifoldHarmonics& harmonics,
  const TriangleMesh::PointMatrix& points)
{
  // Points are taken relative to the centroid, so that a model far from the origin loses no digits.
  // Only the kernel's descriptors depend on the centroid, as all other harmonics are orthogonal to
  // constants.
  const Eigen::RowVector3d centroid = points.colwise().mean();
  const Eigen::MatrixXd weighted = harmonics.Mass * (points.rowwise() - centroid);
  Spectrum spectrum = harmonics.Basis.transpose() * weighted;
  const Index kernel = std::min(harmonics.KernelDimension, harmonics.Count());
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(points.rows());
  spectrum.topRows(kernel) +=
    (harmonics.Basis.leftCols(kernel).transpose() * (harmonics.Mass * ones)) * centroid;
  return spectrum;
}

TriangleMesh::PointMatrix InverseTransform(const ManifoldHarmonics& harmonics,
  const Spectrum& spectrum)
{
  return harmonics.Basis.leftCols(spectrum.rows()) * spectrum;
}

Eigen::VectorXd Magnitudes(const Spectrum& spectrum)
{
  return spectrum.rowwise().norm();
}

TriangleMesh::PointMatrix FilterPoints(const ManifoldHarmonics& harmonics,
  const TriangleMesh::PointMatrix& points, const Eigen::VectorXd& gains, bool keepResidual)
{
  const Spectrum spectrum = ForwardTransform(harmonics, points).topRows(gains.size());
  if (!keepResidual)
  {
    return InverseTransform(harmonics, gains.asDiagonal() * spectrum);
  }
  const Eigen::VectorXd change = gains.array() - 1.0;
  return points + InverseTransform(harmonics, change.asDiagonal() * spectrum);
}

} // namespace spectralwatermark

// SPDX-License-Identifier: BSD-3-Clause
#include "Core/RobustScheme/SolidFrame.h"

#include "Core/Mesh/Measures.h"
#include "Core/Support/Errors.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>

namespace spectralwatermark
{

namespace
{

using Eigen::Matrix3d;
using Eigen::RowVector3d;

// The ratio of volume to area^1.5 below which the volume is rounding error. For a sphere it is
// 0.094.
constexpr double SmallestSolidity = 1e-6;

// The moments of a solid about the origin, up to the second.
struct Moments
{
  double Volume = 0.0;
  RowVector3d First = RowVector3d::Zero();
  Matrix3d Second = Matrix3d::Zero();
};

Moments MomentsOf(const TriangleMesh& mesh)
{
  Moments moments;
  for (Index t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    const Corners c = CornersOf(mesh, t);
    const double volume = SignedVolume(c);
    const RowVector3d sum = c[0] + c[1] + c[2];
    moments.Volume += volume;
    moments.First += volume / 4.0 * sum;
    moments.Second += volume / 20.0 *
      (sum.transpose() * sum + c[0].transpose() * c[0] + c[1].transpose() * c[1] +
        c[2].transpose() * c[2]);
  }
  return moments;
}

// The integrals of x^3, y^3 and z^3 over the solid. Each triangle and the origin span a
// tetrahedron, which contributes V / 20 times the complete homogeneous cubic polynomial of the
// triangle's corners.
Eigen::Array3d ThirdMoments(const TriangleMesh& mesh)
{
  Eigen::Array3d moments = Eigen::Array3d::Zero();
  for (Index t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    const Corners c = CornersOf(mesh, t);
    const Eigen::Array3d a = c[0].transpose().array();
    const Eigen::Array3d b = c[1].transpose().array();
    const Eigen::Array3d d = c[2].transpose().array();
    const Eigen::Array3d first = a + b + d;
    const Eigen::Array3d second = a.square() + b.square() + d.square();
    const Eigen::Array3d third = a.cube() + b.cube() + d.cube();
    moments += SignedVolume(c) / 20.0 * (first.cube() + 3.0 * first * second + 2.0 * third) / 6.0;
  }
  return moments;
}

} // namespace

TriangleMesh::PointMatrix SolidFrame::ToFrame(const TriangleMesh::PointMatrix& points) const
{
  return (points.rowwise() - this->Origin) * this->Axes.transpose() / this->Scale;
}

TriangleMesh::PointMatrix SolidFrame::DifferencesFromFrame(
  const TriangleMesh::PointMatrix& changes) const
{
  return this->Scale * changes * this->Axes;
}

std::optional<SolidFrame> FrameIfAny(const TriangleMesh& oriented)
{
  // The moments are taken about the mean of the vertices: about a distant origin they would cancel.
  const RowVector3d centre = oriented.Points.colwise().mean();
  TriangleMesh mesh = oriented;
  mesh.Points.rowwise() -= centre;
  const Moments moments = MomentsOf(mesh);
  const double area = VertexAreas(mesh).sum();
  if (!(area > 0.0) || !(moments.Volume > SmallestSolidity * std::pow(area, 1.5)))
  {
    return std::nullopt;
  }
  const RowVector3d centroid = moments.First / moments.Volume;
  const Eigen::SelfAdjointEigenSolver<Matrix3d> principal(
    moments.Second / moments.Volume - centroid.transpose() * centroid);
  const Eigen::Vector3d variances = principal.eigenvalues().reverse();
  if (!(variances[2] > 0.0))
  {
    return std::nullopt;
  }
  SolidFrame frame;
  frame.Origin = centre + centroid;
  frame.Axes = principal.eigenvectors().rowwise().reverse().transpose();
  // The frame is right-handed, because a mirrored solid is a different solid.
  frame.Axes.row(2) *= frame.Axes.determinant() < 0.0 ? -1.0 : 1.0;
  frame.Scale = std::sqrt(variances.sum());
  mesh.Points = frame.ToFrame(oriented.Points);
  const Eigen::Array3d skewness = ThirdMoments(mesh) /
    (moments.Volume / std::pow(frame.Scale, 3) * (variances.array() / variances.sum()).pow(1.5));
  for (Index axis = 0; axis < 3; ++axis)
  {
    frame.Axes.row(axis) *= skewness[axis] < 0.0 ? -1.0 : 1.0;
  }
  const bool isLeftHanded = frame.Axes.determinant() < 0.0;
  if (isLeftHanded)
  {
    Index unclear = 0;
    skewness.abs().minCoeff(&unclear);
    frame.Axes.row(unclear) *= -1.0;
  }
  std::array<double, 3> clear = { std::abs(skewness[0]), std::abs(skewness[1]),
    std::abs(skewness[2]) };
  std::sort(clear.begin(), clear.end());
  // In a left-handed frame the least clear axis is reversed, so it must be clear which one that is.
  frame.Clearness = isLeftHanded ? clear[1] - clear[0] : clear[1];
  return frame;
}

SolidFrame FrameOf(const TriangleMesh& oriented)
{
  const std::optional<SolidFrame> frame = FrameIfAny(oriented);
  if (!frame)
  {
    throw InvalidInput("Scheme",
      "the surface encloses no volume, or is too open to have an inside, which the robust scheme "
      "needs",
      "close it, or use the paper's scheme");
  }
  return *frame;
}

SolidFrame RotatedByPi(const SolidFrame& frame, int turn)
{
  SolidFrame turned = frame;
  for (Index axis = 0; axis < 3; ++axis)
  {
    turned.Axes.row(axis) *= turn == 0 || axis == turn - 1 ? 1.0 : -1.0;
  }
  return turned;
}

} // namespace spectralwatermark

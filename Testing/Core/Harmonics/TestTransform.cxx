// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Harmonics/ManifoldHarmonics.h"
#include "Core/Harmonics/Transform.h"
#include "Support/Shapes.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

using namespace spectralwatermark;

namespace
{

ManifoldHarmonics Compute(const TriangleMesh& mesh, Index count, double tolerance = 1e-8)
{
  HarmonicsOptions options;
  options.Count = count;
  options.Tolerance = tolerance;
  return ComputeManifoldHarmonics(mesh, options);
}

double ReconstructionError(const TriangleMesh& mesh, const ManifoldHarmonics& harmonics, Index m)
{
  return (FilterPoints(harmonics, mesh.Points, Eigen::VectorXd::Ones(m), false) - mesh.Points)
    .norm();
}

Eigen::VectorXd MagnitudesOf(const TriangleMesh& mesh, Index count, double tolerance)
{
  return Magnitudes(ForwardTransform(Compute(mesh, count, tolerance), mesh.Points));
}

} // namespace

TEST(Transform, ReconstructionErrorFallsMonotonicallyToRounding)
{
  const TriangleMesh mesh = shapes::Bumpy(2);
  const ManifoldHarmonics harmonics = Compute(mesh, mesh.NumberOfVertices());
  double previous = mesh.Points.norm() * 2.0;
  for (const Index m : { 1, 2, 4, 10, 30, 80, 120, 162 })
  {
    // In the mass norm the error cannot grow; in the plain norm it does not either here.
    const double error = ReconstructionError(mesh, harmonics, m);
    EXPECT_LT(error, previous) << m;
    previous = error;
  }
  EXPECT_LT(previous, 1e-12 * mesh.Points.norm());
}

TEST(Transform, OfABasisColumnIsAUnitVector)
{
  const TriangleMesh mesh = shapes::Bumpy(3);
  const ManifoldHarmonics harmonics = Compute(mesh, 20);
  TriangleMesh::PointMatrix points = TriangleMesh::PointMatrix::Zero(mesh.NumberOfVertices(), 3);
  points.col(1) = harmonics.Basis.col(7);
  const Spectrum spectrum = ForwardTransform(harmonics, points);
  Spectrum expected = Spectrum::Zero(20, 3);
  expected(7, 1) = 1.0;
  EXPECT_LT((spectrum - expected).cwiseAbs().maxCoeff(), 1e-10);
}

// Section 3.3.1: magnitudes do not see rotations and translations, and grow with the square of
// a uniform scale.
TEST(Transform, MagnitudesFollowSimilarities)
{
  const TriangleMesh mesh = shapes::Bumpy(4);
  const double tolerance = 1e-12;
  const Eigen::VectorXd magnitudes = MagnitudesOf(mesh, 70, tolerance);
  const double bound = 1e-8 * magnitudes.tail(69).maxCoeff();

  TriangleMesh rotated = mesh;
  const Eigen::Matrix3d rotation =
    Eigen::AngleAxisd(1.234, Eigen::Vector3d(0.3, -1.0, 0.55).normalized()).toRotationMatrix();
  rotated.Points = mesh.Points * rotation.transpose();
  EXPECT_LT((MagnitudesOf(rotated, 70, tolerance) - magnitudes).cwiseAbs().maxCoeff(), bound);

  TriangleMesh moved = mesh;
  moved.Points.rowwise() += Eigen::RowVector3d(11.0, -7.0, 300.0);
  EXPECT_LT((MagnitudesOf(moved, 70, tolerance) - magnitudes).tail(69).cwiseAbs().maxCoeff(),
    bound);

  TriangleMesh scaled = mesh;
  scaled.Points *= 7.3;
  const Eigen::VectorXd expected = 7.3 * 7.3 * magnitudes;
  EXPECT_LT((MagnitudesOf(scaled, 70, tolerance) - expected).cwiseAbs().maxCoeff(),
    7.3 * 7.3 * bound);
}

TEST(Transform, FilterKeepsOrDropsTheResidual)
{
  const TriangleMesh mesh = shapes::Bumpy(3);
  const ManifoldHarmonics harmonics = Compute(mesh, 30);
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(30);
  EXPECT_LT((FilterPoints(harmonics, mesh.Points, ones, true) - mesh.Points).norm(), 1e-12);
  Eigen::VectorXd gains = ones;
  gains[12] = 2.0;
  const Spectrum before = ForwardTransform(harmonics, mesh.Points);
  const Spectrum after =
    ForwardTransform(harmonics, FilterPoints(harmonics, mesh.Points, gains, false));
  EXPECT_LT((after - gains.asDiagonal() * before).norm(), 1e-10 * before.norm());
}

// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Harmonics/BasisSimilarity.h"
#include "Core/Harmonics/ManifoldHarmonics.h"
#include "Support/Shapes.h"

#include <Eigen/QR>
#include <gtest/gtest.h>

#include <cmath>

using namespace spectralwatermark;

namespace
{

constexpr double Tolerance = 1e-6;

ManifoldHarmonics Compute(const TriangleMesh& mesh, Index count)
{
  HarmonicsOptions options;
  options.Count = count;
  return ComputeManifoldHarmonics(mesh, options);
}

} // namespace

TEST(BasisSimilarity, ABasisIsItself)
{
  const ManifoldHarmonics basis = Compute(shapes::Bumpy(3), 40);
  const Eigen::VectorXd similarity = BasisSimilarity(basis, basis.Basis, Tolerance);
  EXPECT_EQ(similarity.size(), 40);
  EXPECT_NEAR(similarity.minCoeff(), 1.0, 1e-12);
}

TEST(BasisSimilarity, SignAndLengthDoNotMatter)
{
  const ManifoldHarmonics basis = Compute(shapes::Bumpy(3), 20);
  const Eigen::VectorXd similarity = BasisSimilarity(basis, -3.0 * basis.Basis, Tolerance);
  EXPECT_NEAR(similarity.minCoeff(), 1.0, 1e-12);
}

// Two harmonics mixed by an angle: its cosine.
TEST(BasisSimilarity, MixingByAnAngleGivesItsCosine)
{
  const ManifoldHarmonics basis = Compute(shapes::Bumpy(3), 20);
  Eigen::MatrixXd mixed = basis.Basis;
  const double angle = 0.7;
  mixed.col(10) = std::cos(angle) * basis.Basis.col(10) + std::sin(angle) * basis.Basis.col(11);
  mixed.col(11) = std::cos(angle) * basis.Basis.col(11) - std::sin(angle) * basis.Basis.col(10);
  const Eigen::VectorXd similarity = BasisSimilarity(basis, mixed, Tolerance);
  EXPECT_NEAR(similarity[10], std::cos(angle), 1e-10);
  EXPECT_NEAR(similarity[11], std::cos(angle), 1e-10);
  EXPECT_NEAR(similarity[9], 1.0, 1e-10);
}

// On a sphere harmonics turn freely within each l: as spaces they are the same.
TEST(BasisSimilarity, RepeatedEigenvaluesAreComparedAsSpaces)
{
  const ManifoldHarmonics basis = Compute(shapes::Icosphere(3), 9);
  Eigen::MatrixXd turned = basis.Basis;
  const Eigen::Matrix3d random = Eigen::Matrix3d::Random();
  const Eigen::Matrix3d rotation = random.householderQr().householderQ();
  turned.middleCols(1, 3) = basis.Basis.middleCols(1, 3) * rotation;
  EXPECT_NEAR(BasisSimilarity(basis, turned, Tolerance).minCoeff(), 1.0, 1e-9);
  EXPECT_LT(BasisSimilarity(basis, turned, 0.0).segment(1, 3).minCoeff(), 0.99);
}

TEST(BasisSimilarity, OrthogonalOrEmptyIsZero)
{
  const ManifoldHarmonics basis = Compute(shapes::Bumpy(3), 20);
  Eigen::MatrixXd other = basis.Basis;
  other.col(4) = basis.Basis.col(15);
  other.col(5).setZero();
  const Eigen::VectorXd similarity = BasisSimilarity(basis, other, Tolerance);
  EXPECT_NEAR(similarity[4], 0.0, 1e-10);
  EXPECT_EQ(similarity[5], 0.0);
}

// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Eigensolver/Residuals.h"
#include "Support/EigenProblems.h"
#include "Support/Shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

using namespace spectralwatermark;
using namespace eigenproblems;

// A unit vector with an eigenvalue that is off by d: d / (lambda + 1 / area).
TEST(Residuals, AreKnownForDiagonalMatrices)
{
  const OwnedProblem problem = DiagonalProblem({ 1.0, 5.0, 20.0 });
  const Eigen::MatrixXd vectors = 3.0 * Eigen::MatrixXd::Identity(3, 3);
  const Eigen::Vector3d exact(1.0, 5.0, 20.0);
  EXPECT_EQ(RelativeResiduals(problem.Stiffness, problem.Mass, 2.0, exact, vectors).norm(), 0.0);
  const Eigen::Vector3d off(1.5, 4.0, 20.0);
  const Eigen::VectorXd residuals =
    RelativeResiduals(problem.Stiffness, problem.Mass, 2.0, off, vectors);
  EXPECT_NEAR(residuals[0], 0.5 / 2.0, 1e-15);
  EXPECT_NEAR(residuals[1], 1.0 / 4.5, 1e-15);
  EXPECT_EQ(residuals[2], 0.0);
}

TEST(Residuals, AreScaledByTheAreaAtEigenvalue0)
{
  const OwnedProblem problem = DiagonalProblem({ 0.1, 5.0 });
  const Eigen::MatrixXd vector = Eigen::MatrixXd::Identity(2, 1);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(1);
  for (const double area : { 0.5, 1.0, 8.0 })
  {
    EXPECT_NEAR(RelativeResiduals(problem.Stiffness, problem.Mass, area, zero, vector)[0],
      0.1 * area, 1e-14);
  }
}

TEST(Residuals, OfBlocksAreThoseOfTheirColumns)
{
  const OwnedProblem problem(shapes::Bumpy(2), MassMatrix::Consistent);
  const Index rows = problem.Mass.rows();
  const Eigen::MatrixXd vectors = Eigen::MatrixXd::Random(rows, 2 * BlockWidth);
  const Eigen::VectorXd values = Eigen::VectorXd::LinSpaced(2 * BlockWidth, 0.0, 300.0);
  const Eigen::VectorXi order = Eigen::VectorXi::LinSpaced(rows, 0, static_cast<int>(rows) - 1);
  const Eigen::VectorXd expected =
    RelativeResiduals(problem.Stiffness, problem.Mass, 1.0, values, vectors);
  const Eigen::VectorXd ofBlocks =
    MultiVectorResiduals(problem.Stiffness, problem.Mass, values, ToMultiVector(vectors, order), 2);
  EXPECT_LT((ofBlocks - expected).cwiseAbs().maxCoeff(), 1e-12 * expected.maxCoeff());
}

// A column of zeros fills up a block: it has no residual.
TEST(Residuals, OfZerosAreZero)
{
  const OwnedProblem problem = DiagonalProblem({ 1.0, 2.0, 3.0 });
  const MultiVector zeros(1, BlockVector::Zero(3, BlockWidth));
  EXPECT_EQ(MultiVectorResiduals(problem.Stiffness, problem.Mass, Eigen::VectorXd::Ones(BlockWidth),
              zeros, 1)
              .norm(),
    0.0);
}

TEST(Residuals, FloorsAreTheRoundingOfTheLargestEntry)
{
  const OwnedProblem problem = DiagonalProblem({ 1.0, 5.0, 2000.0 });
  const Eigen::MatrixXd vectors = 7.0 * Eigen::MatrixXd::Identity(3, 2);
  const Eigen::VectorXd floors =
    ResidualFloors(problem.Stiffness, problem.Mass, 1.0, Eigen::Vector2d(1.0, 5.0), vectors);
  const double rounding = 8.0 * std::numeric_limits<double>::epsilon() * 2000.0;
  EXPECT_NEAR(floors[0] / (rounding / 2.0), 1.0, 1e-12);
  EXPECT_NEAR(floors[1] / (rounding / 6.0), 1.0, 1e-12);
}

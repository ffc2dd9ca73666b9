// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Eigensolver/DenseSolver.h"
#include "Support/EigenProblems.h"
#include "Support/Shapes.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

using namespace spectralwatermark;
using namespace eigenproblems;

TEST(DenseSolver, FindsTheWholeSpectrum)
{
  const OwnedProblem problem(shapes::Bumpy(2));
  const EigenPairs pairs = SolveDense(problem, problem.Rank);
  ASSERT_TRUE(pairs.Complete);
  // A second construction: the symmetric standard problem D^-1/2 S D^-1/2.
  const Eigen::VectorXd scale = Eigen::VectorXd(problem.Mass.diagonal()).cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd standard =
    scale.asDiagonal() * Eigen::MatrixXd(problem.Stiffness) * scale.asDiagonal();
  const Eigen::VectorXd expected = standard.selfadjointView<Eigen::Lower>().eigenvalues();
  EXPECT_LT((pairs.Values - expected).cwiseAbs().maxCoeff(), 1e-10 * expected.maxCoeff());
}

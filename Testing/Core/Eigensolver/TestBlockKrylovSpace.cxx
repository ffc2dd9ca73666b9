// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Eigensolver/BlockKrylovSpace.h"
#include "Core/Harmonics/LaplaceOperator.h"
#include "Core/Support/Errors.h"
#include "Support/Shapes.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>

using namespace spectralwatermark;

namespace
{

constexpr double Shift = 10.3;

Eigen::MatrixXd Dense(const MultiVector& blocks)
{
  Eigen::MatrixXd dense(blocks.front().rows(), BlockWidth * static_cast<Index>(blocks.size()));
  for (std::size_t k = 0; k < blocks.size(); ++k)
  {
    dense.middleCols(BlockWidth * static_cast<Index>(k), BlockWidth) = blocks[k];
  }
  return dense;
}

ShiftedFactorization FactorizationOf(const TriangleMesh& mesh)
{
  const LaplaceOperator op = AssembleLaplaceOperator(mesh, MassMatrix::Lumped);
  ShiftedFactorization factorization(op.Stiffness, op.Mass);
  factorization.Factorize(Shift, 2);
  return factorization;
}

} // namespace

// The Lanczos relation A Q = Q T + R, where R is in the last block's columns and the next block's span.
TEST(BlockKrylovSpace, ProjectsTheOperator)
{
  const ShiftedFactorization factorization = FactorizationOf(shapes::Bumpy(2));
  BlockKrylovSpace space(factorization, {}, {}, 1, 2);
  for (int k = 0; k < 4; ++k)
  {
    ASSERT_TRUE(space.Extend());
  }
  ASSERT_TRUE(space.Reorthogonalize());
  const Index size = space.Size();
  ASSERT_EQ(size, 4 * BlockWidth);
  const Index all = size + BlockWidth;
  const Eigen::MatrixXd q = Dense(space.Combine(Eigen::MatrixXd::Identity(all, all)));
  const Eigen::MatrixXd mass = factorization.Mass();
  EXPECT_LT((q.transpose() * mass * q - Eigen::MatrixXd::Identity(all, all)).cwiseAbs().maxCoeff(),
    1e-13);

  const Eigen::MatrixXd shifted = Eigen::MatrixXd(factorization.Stiffness()) - Shift * mass;
  const Eigen::MatrixXd image = shifted.partialPivLu().solve(mass * q.leftCols(size));
  Eigen::MatrixXd expected = q.leftCols(size) * space.Projected();
  expected.rightCols(BlockWidth) += q.rightCols(BlockWidth) * space.LastCoupling();
  EXPECT_LT((image - expected).norm(), 1e-11 * image.norm());
}

TEST(BlockKrylovSpace, StaysOrthogonalToWhatIsLocked)
{
  const ShiftedFactorization factorization = FactorizationOf(shapes::Bumpy(2));
  BlockVector first = BlockVector::Zero(factorization.Size(), BlockWidth);
  first.col(0).setOnes();
  first.col(0) /= std::sqrt(first.col(0).dot(factorization.Mass() * first.col(0)));
  const MultiVector locked = { first };
  BlockKrylovSpace space(factorization, locked, {}, 1, 1);
  ASSERT_TRUE(space.Extend());
  ASSERT_TRUE(space.Extend());
  const Index all = space.Size() + BlockWidth;
  const Eigen::MatrixXd q = Dense(space.Combine(Eigen::MatrixXd::Identity(all, all)));
  EXPECT_LT((first.col(0).transpose() * factorization.Mass() * q).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(BlockKrylovSpace, BeginsWithTheSpanOfAGoodGuess)
{
  const ShiftedFactorization factorization = FactorizationOf(shapes::Bumpy(2));
  const BlockVector start = RandomBlockVector(factorization.Size(), 7, 1);
  BlockKrylovSpace space(factorization, {}, start, 1, 1);
  const Eigen::MatrixXd q = Dense(space.Combine(Eigen::MatrixXd::Identity(BlockWidth, BlockWidth)));
  const Eigen::MatrixXd inSpan = q * (q.transpose() * (factorization.Mass() * start));
  EXPECT_LT((inSpan - start).norm(), 1e-2 * start.norm());
}

// Twelve vertices: a second block of eight does not fit, and nor does a first beside eight that are locked.
TEST(BlockKrylovSpace, ReportsWhenNothingIsNew)
{
  const ShiftedFactorization factorization = FactorizationOf(shapes::Icosphere(0));
  BlockKrylovSpace space(factorization, {}, {}, 1, 1);
  EXPECT_FALSE(space.Extend());
  const MultiVector locked = space.Combine(Eigen::MatrixXd::Identity(BlockWidth, BlockWidth));
  EXPECT_THROW(BlockKrylovSpace(factorization, locked, {}, 2, 1), SolverFailure);
}

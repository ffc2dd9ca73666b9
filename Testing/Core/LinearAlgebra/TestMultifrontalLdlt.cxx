// SPDX-License-Identifier: BSD-3-Clause
#include "Core/LinearAlgebra/MultiVector.h"
#include "Core/LinearAlgebra/MultifrontalLdlt.h"
#include "Support/SparseMatrices.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <limits>

using namespace spectralwatermark;
using sparsematrices::DissectedGrid;
using sparsematrices::Grid;
using sparsematrices::InPostorder;
using sparsematrices::RandomMatrix;
using sparsematrices::Shape;
using sparsematrices::Shapes;

TEST(MultifrontalLdlt, SolvesAndCountsNegativeEigenvalues)
{
  for (const Shape& shape : Shapes())
  {
    SCOPED_TRACE(shape.Name);
    const SparseMatrix matrix = InPostorder(shape.Matrix);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> dense{ Eigen::MatrixXd(matrix) };
    MultifrontalLdlt factors(matrix);
    ASSERT_TRUE(factors.Factorize(matrix, 2));
    EXPECT_EQ(factors.NegativePivots(), (dense.eigenvalues().array() < 0.0).count());

    const BlockVector expected = BlockVector::Random(matrix.cols(), BlockWidth);
    BlockVector x = matrix * expected;
    factors.Solve(x, 2);
    // Factors without pivoting may lose some digits.
    EXPECT_LT((x - expected).norm(), 1e-8 * expected.norm());
  }
}

TEST(MultifrontalLdlt, GivesTheSameBytesForAnyNumberOfThreadsAndUsedAgain)
{
  // Many small fronts, and one that several threads work on.
  for (const SparseMatrix& shape : { DissectedGrid(90, 1.7), RandomMatrix(700, 0.01, 6) })
  {
    const SparseMatrix matrix = InPostorder(shape);
    const BlockVector right = BlockVector::Random(matrix.cols(), BlockWidth);
    MultifrontalLdlt alone(matrix);
    MultifrontalLdlt together(matrix);
    ASSERT_TRUE(together.Factorize(SparseMatrix(2.0 * matrix), 2));
    ASSERT_TRUE(alone.Factorize(matrix, 1));
    ASSERT_TRUE(together.Factorize(matrix, 3));
    BlockVector x = right;
    BlockVector y = right;
    alone.Solve(x, 1);
    together.Solve(y, 3);
    EXPECT_EQ(x, y);
  }
}

TEST(MultifrontalLdlt, ReportsAPivotThatIsZeroOrNotANumber)
{
  SparseMatrix matrix = InPostorder(Grid(20, 1.7));
  MultifrontalLdlt factors(matrix);
  for (const double bad :
    { 0.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity() })
  {
    SparseMatrix broken = matrix;
    broken.coeffRef(0, 0) = bad; // nothing is eliminated before it
    EXPECT_FALSE(factors.Factorize(broken, 2));
  }
  EXPECT_TRUE(factors.Factorize(matrix, 2));
}

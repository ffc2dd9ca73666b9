// SPDX-License-Identifier: BSD-3-Clause
// Multivectors against Eigen's dense algebra.
#include "Core/LinearAlgebra/MultiVector.h"

#include <gtest/gtest.h>

#include <vector>

using namespace spectralwatermark;

namespace
{

constexpr Index Rows = 5000; // several chunks and a part of one

MultiVector RandomBlocks(std::size_t count)
{
  MultiVector blocks;
  for (std::size_t k = 0; k < count; ++k)
  {
    blocks.emplace_back(BlockVector::Random(Rows, BlockWidth));
  }
  return blocks;
}

Eigen::MatrixXd Dense(const MultiVector& blocks)
{
  Eigen::MatrixXd dense(blocks.front().rows(), BlockWidth * static_cast<Index>(blocks.size()));
  for (std::size_t k = 0; k < blocks.size(); ++k)
  {
    dense.middleCols(BlockWidth * static_cast<Index>(k), BlockWidth) = blocks[k];
  }
  return dense;
}

} // namespace

TEST(MultiVector, ProjectSubtractAndCombineAreMatrixProducts)
{
  const MultiVector basis = RandomBlocks(3);
  const Eigen::MatrixXd q = Dense(basis);
  const MultiVector y = RandomBlocks(2);
  const Eigen::MatrixXd c = InnerProducts(basis, y, 2);
  EXPECT_LT((c - q.transpose() * Dense(y)).cwiseAbs().maxCoeff(), 1e-10);

  MultiVector w = y;
  SubtractCombination(basis, c, w.data(), 2);
  EXPECT_LT((Dense(w) - (Dense(y) - q * c)).cwiseAbs().maxCoeff(), 1e-9);

  const Eigen::MatrixXd coefficients = Eigen::MatrixXd::Random(19, 11); // no multiple of eight
  const MultiVector combined = LinearCombination(basis, coefficients, 2);
  ASSERT_EQ(combined.size(), 2u);
  EXPECT_LT((Dense(combined).leftCols(11) - q.leftCols(19) * coefficients).cwiseAbs().maxCoeff(),
    1e-12);
  EXPECT_EQ(Dense(combined).rightCols(5).cwiseAbs().maxCoeff(), 0.0);
}

TEST(MultiVector, NothingProjectsToNothing)
{
  const MultiVector y = RandomBlocks(1);
  EXPECT_EQ(InnerProducts(MultiVectorView(y.data(), 0), y, 2).size(), 0);
}

// Diagonal or not, a matrix in between is a matrix in between.
TEST(MultiVector, ProjectsThroughASparseMatrix)
{
  const MultiVector basis = RandomBlocks(2);
  const MultiVector y = RandomBlocks(1);
  SparseMatrix a(Rows, Rows);
  a.setIdentity();
  a *= 3.0;
  for (const bool diagonal : { true, false })
  {
    if (!diagonal)
    {
      a.coeffRef(7, 4000) = 5.0;
      a.coeffRef(4000, 7) = 5.0;
      a.makeCompressed();
    }
    const Eigen::MatrixXd expected = Dense(basis).transpose() * (a * Dense(y));
    MultiVector room;
    EXPECT_LT((InnerProducts(basis, a, y, room, 2) - expected).cwiseAbs().maxCoeff(), 1e-10);
    const Eigen::MatrixXd gram = Dense(basis).transpose() * (a * Dense(basis));
    EXPECT_LT((GramMatrix(a, basis, 2) - gram).cwiseAbs().maxCoeff(), 1e-9);
  }
}

TEST(MultiVector, DividesByATriangle)
{
  const BlockVector w = BlockVector::Random(Rows, BlockWidth);
  Eigen::MatrixXd r = Eigen::MatrixXd::Random(8, 8).triangularView<Eigen::Upper>();
  r.diagonal().array() += 3.0;
  BlockVector divided = w;
  SolveTriangularRight(r, divided, 2);
  EXPECT_LT((divided * r - w).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(MultiVector, ResultsDoNotDependOnTheThreads)
{
  const MultiVector basis = RandomBlocks(4);
  const MultiVector y = RandomBlocks(1);
  EXPECT_EQ(InnerProducts(basis, y, 1), InnerProducts(basis, y, 3));
}

TEST(MultiVector, SelectedColumnsAreTheOnesAskedFor)
{
  const MultiVector blocks = RandomBlocks(3);
  const std::vector<Index> columns = { 23, 0, 8, 9, 9, 2, 17, 16, 1, 10 };
  const Eigen::MatrixXd selected = Dense(SelectColumns(blocks, columns, 2));
  ASSERT_EQ(selected.cols(), 16);
  EXPECT_EQ(selected.leftCols(10), Dense(blocks)(Eigen::all, columns));
  EXPECT_EQ(selected.rightCols(6).cwiseAbs().maxCoeff(), 0.0);
}

TEST(MultiVector, ColumnsComeBackFromBlocks)
{
  const Eigen::MatrixXd columns = Eigen::MatrixXd::Random(50, 21);
  Eigen::VectorXi order = Eigen::VectorXi::LinSpaced(50, 49, 0);
  const std::vector<Index> wanted = { 0, 1, 5, 7, 19, 20 }; // none of the second block
  EXPECT_EQ(TakeColumns(ToMultiVector(columns, order), wanted, order, 2),
    columns(Eigen::all, wanted));
}

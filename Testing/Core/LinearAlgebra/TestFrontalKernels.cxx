// SPDX-License-Identifier: BSD-3-Clause
// The loops of the multifrontal method against Eigen's dense algebra.
#include "Core/LinearAlgebra/FrontalKernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

using namespace spectralwatermark;

namespace
{

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Symmetric and indefinite, and sound without pivoting.
Rows RandomPivots(Index count)
{
  const Rows random = Rows::Random(count, count);
  Rows matrix = random + random.transpose();
  for (Index k = 0; k < count; ++k)
  {
    matrix(k, k) += (k % 3 == 1 ? -4.0 : 4.0) * static_cast<double>(count);
  }
  return matrix;
}

// L of a block that holds it under its diagonal.
Rows UnitLower(const Rows& block)
{
  return block.triangularView<Eigen::UnitLower>();
}

// Lazy products compile in a tenth of the time.
Rows Product(const Rows& a, const Rows& b)
{
  return a.lazyProduct(b);
}

// L D R^T.
Rows Product(const Rows& l, const Eigen::VectorXd& d, const Rows& r)
{
  return Product(l * d.asDiagonal(), r.transpose());
}

struct Factorized
{
  explicit Factorized(Index count)
    : Matrix(RandomPivots(count))
    , Block(count, count + 3) // rows are further apart than they are long
    , InverseD(count)
  {
    this->Block.leftCols(count) = this->Matrix;
    this->IsSound =
      this->Pivots.Factorize(this->Block.data(), this->Block.cols(), count, this->InverseD.data());
    this->L = UnitLower(this->Block.leftCols(count));
    this->D = this->InverseD.cwiseInverse();
  }

  Rows Matrix;
  Rows Block;
  Eigen::VectorXd InverseD;
  PivotBlock Pivots;
  bool IsSound = false;
  Rows L;
  Eigen::VectorXd D;
};

} // namespace

TEST(FrontalKernels, PivotsFactorizeTheirBlock)
{
  for (const Index count : { Index{ 1 }, Index{ 5 }, Index{ 8 }, Index{ 19 }, PivotsAtOnce })
  {
    const Factorized block(count);
    ASSERT_TRUE(block.IsSound);
    const Rows product = Product(block.L, block.D, block.L);
    EXPECT_LT((product - block.Matrix).cwiseAbs().maxCoeff(),
      1e-13 * block.Matrix.cwiseAbs().maxCoeff())
      << count;
  }
}

TEST(FrontalKernels, PivotsThatAreZeroOrNotFiniteAreReported)
{
  for (const double bad : { 0.0, std::numeric_limits<double>::quiet_NaN(),
         std::numeric_limits<double>::infinity(), 1e-320 })
  {
    Rows block = RandomPivots(6);
    block(0, 0) = bad;
    double inverseD[PivotsAtOnce];
    EXPECT_FALSE(PivotBlock().Factorize(block.data(), block.cols(), 6, inverseD)) << bad;
  }
}

TEST(FrontalKernels, RowsUnderTheBlockBecomeTheirsOfL)
{
  for (const Index count : { Index{ 1 }, Index{ 7 }, Index{ 16 }, PivotsAtOnce })
  {
    const Factorized block(count);
    const Rows below = Rows::Random(9, count + 2);
    Rows rows = below;
    block.Pivots.SolveRows(rows.data(), rows.cols(), rows.rows());
    const Rows product = Product(rows.leftCols(count), block.D, block.L);
    EXPECT_LT((product - below.leftCols(count)).cwiseAbs().maxCoeff(), 1e-12) << count;
    EXPECT_EQ(rows.rightCols(2), below.rightCols(2)) << count;
  }
}

TEST(FrontalKernels, ProductsAreSubtractedFromAStripOfEightColumns)
{
  constexpr Index depth = 13;
  const Factorized block(depth);
  for (const Index count : { 3, 8, 21 }) // rows, the first of which are the strip's own
  {
    const Rows before = Rows::Random(count, depth + RowWidth);
    Rows after = before;
    block.Pivots.SubtractProduct(after.data(), after.cols(), 0, depth, count);
    const Rows l = before.leftCols(depth);
    const Index width = std::min(RowWidth, count);
    Rows expected = before;
    expected.middleCols(depth, width) -= Product(l, block.D, l.topRows(width));
    EXPECT_LT((after - expected).cwiseAbs().maxCoeff(), 1e-11) << count;
  }
}

TEST(FrontalKernels, FrontsAreAddedToTheirPlaces)
{
  const std::vector<int> place = { 1, 2, 5, 9 };
  const Rows front = Rows::Random(4, 6);
  Rows sum = Rows::Random(10, 11);
  Rows expected = sum;
  for (Index i = 0; i < 4; ++i)
  {
    for (Index j = 0; j <= i; ++j)
    {
      expected(place[i], place[j]) += front(i, j);
    }
  }
  AddFront(front.data(), front.cols(), place.data(), 4, sum.data(), sum.cols());
  EXPECT_EQ(sum, expected);
}

// One supernode of eleven rows, three of the five below it in the top of the tree, with eight right-hand
// sides: L D L^T x = b by both substitutions.
TEST(FrontalKernels, SubstitutionsSolveWithOneSupernode)
{
  for (const Index width : { 1, 2, 3, 4, 7, 11 })
  {
    constexpr Index belowCount = 5;
    const std::vector<int> below = { 12, 13, 20, 21, 22 };
    std::vector<int> topRow(23, -1);
    topRow[20] = 0;
    topRow[21] = 1;
    topRow[22] = 2;
    Rows l = Rows::Random(width + belowCount, width);
    const Eigen::VectorXd d = Eigen::VectorXd::LinSpaced(width, 1.0, 3.0);
    const Eigen::VectorXd inverseD = d.cwiseInverse();
    const SupernodeFactor factor = { l.data(), inverseD.data(), width, below.data(), 2,
      belowCount };
    const Rows own11 = UnitLower(l.topRows(width));
    const Rows l21 = l.bottomRows(belowCount);

    const Rows right = Rows::Random(width, RowWidth);
    Rows own = right;
    Rows x = Rows::Zero(23, RowWidth);
    Rows top = Rows::Zero(3, RowWidth);
    SubstituteForward(factor, own.data(), x.data(), topRow.data(), top.data());
    EXPECT_LT((Product(own11, own) - right).cwiseAbs().maxCoeff(), 1e-11) << width;
    const Rows pushed = -Product(l21, own);
    EXPECT_LT((x.middleRows(12, 2) - pushed.topRows(2)).cwiseAbs().maxCoeff(), 1e-11) << width;
    EXPECT_LT((top - pushed.bottomRows(3)).cwiseAbs().maxCoeff(), 1e-11) << width;

    Rows known = Rows::Random(23, RowWidth);
    const Rows forward = own;
    SubstituteBack(factor, own.data(), known.data());
    Rows ofBelow(belowCount, RowWidth);
    for (Index k = 0; k < belowCount; ++k)
    {
      ofBelow.row(k) = known.row(below[k]);
    }
    const Rows residual = Product(own11.transpose(), own) + Product(l21.transpose(), ofBelow) -
      inverseD.asDiagonal() * forward;
    EXPECT_LT(residual.cwiseAbs().maxCoeff(), 1e-10) << width;
  }
}

// SPDX-License-Identifier: BSD-3-Clause
// The multifrontal factorisation against Eigen's dense algebra and its simplicial LDL^T.
#include "Core/LinearAlgebra/MultiVector.h"
#include "Core/LinearAlgebra/MultifrontalLdlt.h"
#include "Core/LinearAlgebra/Supernodes.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <set>
#include <vector>

using namespace spectralwatermark;
using Eigen::Index;

namespace
{

using SparseMatrix = Eigen::SparseMatrix<double>;

// Symmetric and indefinite, with about `density` of its entries.
SparseMatrix RandomMatrix(Index size, double density, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  std::bernoulli_distribution isThere(density);
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < size; ++j)
  {
    entries.emplace_back(j, j, 4.0 * value(random));
    for (int i = 0; i < j; ++i)
    {
      if (isThere(random))
      {
        const double entry = value(random);
        entries.emplace_back(i, j, entry);
        entries.emplace_back(j, i, entry);
      }
    }
  }
  SparseMatrix matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

// A grid, four neighbours each, as surfaces have.
SparseMatrix Grid(int width, double diagonal)
{
  std::vector<Eigen::Triplet<double>> entries;
  const auto connect = [&entries](int a, int b)
  {
    entries.emplace_back(a, b, -1.0);
    entries.emplace_back(b, a, -1.0);
  };
  for (int y = 0; y < width; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      const int k = y * width + x;
      entries.emplace_back(k, k, diagonal);
      if (x + 1 < width)
      {
        connect(k, k + 1);
      }
      if (y + 1 < width)
      {
        connect(k, k + width);
      }
    }
  }
  SparseMatrix matrix(width * width, width * width);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

// Nested dissection by hand: the halves of the longer side, then the line between them.
void Dissect(int x0, int x1, int y0, int y1, int width, std::vector<int>& order)
{
  if (x0 >= x1 || y0 >= y1)
  {
    return;
  }
  if (x1 - x0 < y1 - y0)
  {
    const int y = (y0 + y1) / 2;
    Dissect(x0, x1, y0, y, width, order);
    Dissect(x0, x1, y + 1, y1, width, order);
    for (int x = x0; x < x1; ++x)
    {
      order.push_back(y * width + x);
    }
    return;
  }
  const int x = (x0 + x1) / 2;
  Dissect(x0, x, y0, y1, width, order);
  Dissect(x + 1, x1, y0, y1, width, order);
  for (int y = y0; y < y1; ++y)
  {
    order.push_back(y * width + x);
  }
}

SparseMatrix InOrder(const SparseMatrix& matrix, const Eigen::VectorXi& order)
{
  const Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> toNew =
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int>(order).inverse();
  SparseMatrix permuted;
  permuted = matrix.twistedBy(toNew);
  return permuted;
}

SparseMatrix DissectedGrid(int width, double diagonal)
{
  std::vector<int> order;
  Dissect(0, width, 0, width, width, order);
  return InOrder(Grid(width, diagonal),
    Eigen::Map<Eigen::VectorXi>(order.data(), static_cast<Index>(order.size())));
}

SparseMatrix InPostorder(const SparseMatrix& matrix)
{
  return InOrder(matrix, Postorder(matrix));
}

struct Shape
{
  const char* Name;
  SparseMatrix Matrix;
};

std::vector<Shape> Shapes()
{
  SparseMatrix dense = RandomMatrix(150, 1.0, 1); // one supernode, wider than what is done at once
  SparseMatrix diagonal = RandomMatrix(60, 0.0, 2);
  SparseMatrix one = RandomMatrix(1, 0.0, 3);
  return { { "one", one }, { "diagonal", diagonal }, { "dense", dense },
    { "sparse", RandomMatrix(400, 0.004, 4) }, { "fuller", RandomMatrix(300, 0.03, 5) },
    { "grid", Grid(20, 1.7) }, { "dissected grid", DissectedGrid(25, 1.7) } };
}

} // namespace

TEST(Supernodes, APostorderHasChildrenBeforeParentsAndStaysAsItIs)
{
  for (const Shape& shape : Shapes())
  {
    SCOPED_TRACE(shape.Name);
    const Eigen::VectorXi order = Postorder(shape.Matrix);
    const std::set<int> rows(order.begin(), order.end());
    ASSERT_EQ(static_cast<Index>(rows.size()), shape.Matrix.cols());
    EXPECT_EQ(*rows.begin(), 0);
    EXPECT_EQ(*rows.rbegin(), shape.Matrix.cols() - 1);
    EXPECT_EQ(Postorder(InPostorder(shape.Matrix)),
      Eigen::VectorXi::LinSpaced(order.size(), 0, static_cast<int>(order.size()) - 1));
  }
}

TEST(Supernodes, HaveARowForEveryEntryOfTheFactor)
{
  for (const Shape& shape : Shapes())
  {
    SCOPED_TRACE(shape.Name);
    const SparseMatrix matrix = InPostorder(shape.Matrix);
    const SupernodeTree tree = FindSupernodes(matrix);
    Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower, Eigen::NaturalOrdering<int>> reference;
    reference.analyzePattern(matrix);
    reference.factorize(matrix);
    const SparseMatrix l = reference.matrixL().nestedExpression();
    Index next = 0;
    std::size_t kept = 0;
    for (const Supernode& node : tree.Nodes)
    {
      EXPECT_EQ(node.First, next); // every column in one, in their order
      next += node.Width;
      std::set<Index> rows(node.Below.begin(), node.Below.end());
      EXPECT_EQ(rows.size(), node.Below.size());
      for (Index j = node.First; j < next; ++j)
      {
        rows.insert(j);
      }
      for (Index j = node.First; j < next; ++j)
      {
        for (SparseMatrix::InnerIterator entry(l, j); entry; ++entry)
        {
          EXPECT_TRUE(rows.count(entry.row()) > 0) << entry.row() << ", " << j;
        }
      }
      EXPECT_EQ(node.Offset, kept);
      kept += rows.size() * static_cast<std::size_t>(node.Width);
    }
    EXPECT_EQ(next, matrix.cols());
    EXPECT_EQ(tree.Entries, kept);
  }
}

TEST(Supernodes, GroupsHaveNothingToDoWithEachOther)
{
  const SupernodeTree tree = FindSupernodes(InPostorder(DissectedGrid(60, 1.7)));
  std::vector<int> groupOf(tree.Nodes.size(), -2);
  for (const int s : tree.Top)
  {
    groupOf[static_cast<std::size_t>(s)] = -1;
  }
  for (std::size_t k = 0; k < tree.Groups.size(); ++k)
  {
    EXPECT_FALSE(tree.Groups[k].empty());
    for (const int s : tree.Groups[k])
    {
      EXPECT_EQ(groupOf[static_cast<std::size_t>(s)], -2);
      groupOf[static_cast<std::size_t>(s)] = static_cast<int>(k);
    }
  }
  for (std::size_t s = 0; s < tree.Nodes.size(); ++s)
  {
    ASSERT_NE(groupOf[s], -2);
    if (const int parent = tree.Nodes[s].Parent; parent >= 0)
    {
      const int above = groupOf[static_cast<std::size_t>(parent)];
      EXPECT_TRUE(above == groupOf[s] || above == -1);
    }
  }
}

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

TEST(MultifrontalLdlt, AreTheSameBytesForAnyNumberOfThreadsAndUsedAgain)
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

TEST(MultifrontalLdlt, SayWhenAPivotIsZeroOrNotANumber)
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

// The first column meets all: L is full. Nothing of its size is allocated before a factorisation.
TEST(Supernodes, CountMoreEntriesThanAnIntHolds)
{
  constexpr int size = 47000;
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < size; ++j)
  {
    entries.emplace_back(j, j, 1.0);
    entries.emplace_back(0, j, 1.0);
    entries.emplace_back(j, 0, 1.0);
  }
  SparseMatrix pattern(size, size);
  pattern.setFromTriplets(entries.begin(), entries.end());
  const SupernodeTree tree = FindSupernodes(pattern);
  ASSERT_EQ(tree.Nodes.size(), 1U);
  EXPECT_EQ(tree.Entries, std::size_t{ size } * std::size_t{ size });
  EXPECT_GT(tree.Entries, std::size_t{ std::numeric_limits<int>::max() });
}

// SPDX-License-Identifier: BSD-3-Clause
#include "Core/LinearAlgebra/Supernodes.h"
#include "Support/SparseMatrices.h"

#include <Eigen/SparseCholesky>
#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <vector>

using namespace spectralwatermark;
using sparsematrices::DissectedGrid;
using sparsematrices::InPostorder;
using sparsematrices::Shape;
using sparsematrices::Shapes;

TEST(Supernodes, APostorderHasChildrenBeforeParentsAndDoesNotChangeAgain)
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

TEST(Supernodes, GroupsAreIndependent)
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

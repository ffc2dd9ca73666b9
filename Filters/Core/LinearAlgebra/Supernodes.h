// SPDX-License-Identifier: BSD-3-Clause
/// What the factor L of a sparse symmetric matrix will look like, from the pattern alone.
#ifndef SpectralWatermark_Core_LinearAlgebra_Supernodes_h
#define SpectralWatermark_Core_LinearAlgebra_Supernodes_h

#include "Core/Support/Types.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <cstddef>
#include <vector>

namespace spectralwatermark
{

/// Neighbouring columns of L with the same rows below them, or nearly: the zeros between are kept.
struct Supernode
{
  int First = 0;   ///< column,
  int Width = 0;   ///< and how many
  int Parent = -1; ///< the supernode that the first of the rows below is a column of; -1: none
  std::vector<int> Children; ///< ascending
  std::vector<int> Below;    ///< rows under the supernode's own, ascending
  std::vector<int> InParent; ///< of each of Below: its place among the parent's rows
  std::size_t Offset = 0;    ///< of its values among those of L
  std::size_t TopBegin = 0;  ///< from here on, Below lie in the top of the tree

  int Height() const { return this->Width + static_cast<int>(this->Below.size()); }
};

/// Supernodes that have nothing to do with each other's columns: groups of subtrees of the elimination
/// tree, about equally heavy, and above them the top, the first separators of a nested dissection.
/// They are the same for any number of threads.
///
/// J. W. H. Liu, "The Role of Elimination Trees in Sparse Factorization" (1990).
struct SupernodeTree
{
  std::vector<Supernode> Nodes; ///< children before their parents
  std::size_t Entries = 0;      ///< of L as it is kept
  std::vector<std::vector<int>> Groups;
  std::vector<int> Top;    ///< supernodes, ascending
  std::vector<int> TopRow; ///< of each row: which row of the top it is, or -1
  int TopRows = 0;
};

/// A postorder of the elimination tree, the largest child last, so that supernodes can be wide.
/// Column k of the new order is column result[k] of the pattern. A postordered pattern stays as it
/// is.
Eigen::VectorXi Postorder(const SparseMatrix& pattern);

/// For a symmetric pattern in postorder.
SupernodeTree FindSupernodes(const SparseMatrix& pattern);

} // namespace spectralwatermark

#endif

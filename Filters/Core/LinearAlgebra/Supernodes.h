// SPDX-License-Identifier: BSD-3-Clause
/// The structure of the factor L of a sparse symmetric matrix, computed from the pattern alone.
#ifndef SpectralWatermark_Core_LinearAlgebra_Supernodes_h
#define SpectralWatermark_Core_LinearAlgebra_Supernodes_h

#include "Core/Support/Types.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <cstddef>
#include <vector>

namespace spectralwatermark
{

/// Neighbouring columns of L with the same rows below them, or nearly the same: the zeros between
/// are stored.
struct Supernode
{
  int First = 0;             ///< the first column
  int Width = 0;             ///< number of columns
  int Parent = -1;           ///< the supernode whose columns include the first row below; -1: none
  std::vector<int> Children; ///< supernodes that have this one as their parent, ascending
  std::vector<int> Below;    ///< rows below the supernode's own, ascending
  std::vector<int> InParent; ///< for each row of Below, its position among the parent's rows
  std::size_t Offset = 0;    ///< where the supernode's values begin among those of L
  std::size_t TopBegin = 0;  ///< position in Below of the first row in the top of the tree

  /// The number of rows, the supernode's own included.
  int Height() const { return this->Width + static_cast<int>(this->Below.size()); }
};

/// The tree of supernodes, divided into groups that can be eliminated independently of each other.
/// A group consists of subtrees of the elimination tree; the groups are about equally heavy. Above
/// them is the top, which holds the first separators of a nested dissection. The division does not
/// depend on the number of threads.
///
/// J. W. H. Liu, "The Role of Elimination Trees in Sparse Factorization" (1990).
struct SupernodeTree
{
  std::vector<Supernode> Nodes;         ///< children before their parents
  std::size_t Entries = 0;              ///< entries of L as it is stored
  std::vector<std::vector<int>> Groups; ///< the supernodes of each group, ascending
  std::vector<int> Top;                 ///< the supernodes of the top, ascending
  std::vector<int> TopRow; ///< for each row, its position among the rows of the top, or -1
  int TopRows = 0;         ///< number of rows of the top
};

/// A postorder of the elimination tree, with the largest child last, so that supernodes can be
/// wide. Column k of the new order is column result[k] of the pattern. A pattern that is already
/// in this order stays unchanged.
Eigen::VectorXi Postorder(const SparseMatrix& pattern);

/// The supernodes of a symmetric pattern, which must be in postorder.
SupernodeTree FindSupernodes(const SparseMatrix& pattern);

} // namespace spectralwatermark

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef SpectralWatermark_Core_Substitution_h
#define SpectralWatermark_Core_Substitution_h

#include "Panels.h"

namespace spectralwatermark
{

/// Forward and backward substitution with a sparse L D L^T for eight right-hand sides at a time.
///
/// Columns of L that lie in different subtrees of the elimination tree have nothing to do with each
/// other: a few groups of subtrees, about equally heavy, are worked on at once, and the columns
/// above them (the first separators of a nested dissection) one after the other. The groups, and
/// with them every sum, are the same for any number of threads.
///
/// J. W. H. Liu, "The Role of Elimination Trees in Sparse Factorization" (1990).
class Substitution
{
public:
  /// L is unit lower triangular without its diagonal, by columns, rows ascending.
  explicit Substitution(const Eigen::SparseMatrix<double>& l);
  Substitution() = default;

  /// X <- (L D L^T)^-1 X, for any L of the pattern given.
  void Solve(const Eigen::SparseMatrix<double>& l, const Eigen::VectorXd& inverseD, Panel& x,
    int threads) const;

private:
  using Columns = std::vector<int>; // ascending

  void PlaceColumns(const std::vector<int>& parent, const std::vector<int>& groupOfRoot);

  std::vector<Columns> Groups;
  Columns Top;
  std::vector<int> TopIndex; // of each row: its place in Top, or -1
  std::vector<int> TopBegin; // of each column: where its rows in Top begin
};

} // namespace spectralwatermark

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef SpectralWatermark_Core_LinearAlgebra_MultifrontalLdlt_h
#define SpectralWatermark_Core_LinearAlgebra_MultifrontalLdlt_h

#include "Core/LinearAlgebra/MultiVector.h"
#include "Core/LinearAlgebra/Supernodes.h"

namespace spectralwatermark
{

/// L D L^T of a sparse symmetric matrix, without pivoting, by the multifrontal method: each supernode
/// is eliminated in a dense matrix of its rows (its front), and what that changes in the rows below
/// it is added to its parent's front. Dense loops do nearly all of the work.
///
/// I. S. Duff, J. K. Reid, "The Multifrontal Solution of Indefinite Sparse Symmetric Linear
/// Equations" (1983).
class MultifrontalLdlt
{
public:
  /// For matrices with this pattern, which is in postorder (see Postorder()).
  explicit MultifrontalLdlt(const SparseMatrix& pattern);

  /// False when a pivot is zero, or not a number.
  bool Factorize(const SparseMatrix& matrix, int threads);

  /// By Sylvester's law of inertia, as many as the matrix has negative eigenvalues.
  Index NegativePivots() const { return (this->InverseD.array() < 0.0).count(); }

  /// X <- (L D L^T)^-1 X.
  void Solve(BlockVector& x, int threads) const;

private:
  struct Front
  {
    Index Stride = 0;
    std::vector<double> Values; // by rows; only the lower triangle means something
  };

  bool Eliminate(int s, const SparseMatrix& matrix, std::vector<Front>& fronts, int threads);
  void Assemble(const Supernode& node, const SparseMatrix& matrix, std::vector<Front>& fronts,
    Front& front) const;

  SupernodeTree Tree;
  std::vector<int>
    Place;           // of each entry of the matrix: its row in the front; -1: over the diagonal
  Eigen::VectorXd L; // of each supernode its rows, by rows
  Eigen::VectorXd InverseD;
};

} // namespace spectralwatermark

#endif

// SPDX-License-Identifier: BSD-3-Clause
/// The multifrontal factorisation of a sparse symmetric matrix.
#ifndef SpectralWatermark_Core_LinearAlgebra_MultifrontalLdlt_h
#define SpectralWatermark_Core_LinearAlgebra_MultifrontalLdlt_h

#include "Core/LinearAlgebra/MultiVector.h"
#include "Core/LinearAlgebra/Supernodes.h"

namespace spectralwatermark
{

/// L D L^T of a sparse symmetric matrix, without pivoting, by the multifrontal method. Each
/// supernode is eliminated in a dense matrix of its rows, its front. The update that this makes to
/// the rows below is added to the front of the parent. Dense loops do nearly all of the work.
///
/// I. S. Duff, J. K. Reid, "The Multifrontal Solution of Indefinite Sparse Symmetric Linear
/// Equations" (1983).
class MultifrontalLdlt
{
public:
  /// Prepares for matrices with this pattern, which must be in postorder (see Postorder()).
  explicit MultifrontalLdlt(const SparseMatrix& pattern);

  /// Computes L and D. Returns false when a pivot is zero or not a number.
  bool Factorize(const SparseMatrix& matrix, int threads);

  /// The number of negative pivots. By Sylvester's law of inertia, it is also the number of
  /// negative eigenvalues of the matrix.
  Index NegativePivots() const { return (this->InverseD.array() < 0.0).count(); }

  /// X <- (L D L^T)^-1 X.
  void Solve(BlockVector& x, int threads) const;

private:
  struct Front
  {
    Index Stride = 0;
    std::vector<double> Values; // by rows; only the lower triangle is used
  };

  // Assembles the front of supernode `s` and eliminates its columns. False as for Factorize().
  bool Eliminate(int s, const SparseMatrix& matrix, std::vector<Front>& fronts, int threads);

  // Sums the entries of the matrix and the fronts of the children, which are freed, into `front`.
  void Assemble(const Supernode& node, const SparseMatrix& matrix, std::vector<Front>& fronts,
    Front& front) const;

  SupernodeTree Tree;
  // For each entry of the matrix, its row in the front; -1 above the diagonal.
  std::vector<int> Place;
  // The rows of each supernode, one supernode after the other.
  Eigen::VectorXd L;
  Eigen::VectorXd InverseD;
};

} // namespace spectralwatermark

#endif

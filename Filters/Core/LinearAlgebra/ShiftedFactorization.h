// SPDX-License-Identifier: BSD-3-Clause
/// The factorisation of a shifted pencil S - sigma M.
#ifndef SpectralWatermark_Core_LinearAlgebra_ShiftedFactorization_h
#define SpectralWatermark_Core_LinearAlgebra_ShiftedFactorization_h

#include "Core/LinearAlgebra/MultiVector.h"
#include "Core/LinearAlgebra/MultifrontalLdlt.h"

#include <optional>

namespace spectralwatermark
{

/// L D L^T of S - sigma M, in an order that keeps L sparse. Solvers see only this interface, so the
/// factorisation behind it can be replaced. This one is multifrontal, in the order of METIS's
/// nested dissection, and solves for eight right-hand sides at a time.
///
/// The rows of all blocks are in the order of elimination.
class ShiftedFactorization
{
public:
  /// Permutes both matrices to the order of elimination. This is a postorder, with the same fill,
  /// of `order` (the Order() of a pencil with the same pattern) or, where none is given, of METIS's
  /// order.
  ShiftedFactorization(const SparseMatrix& stiffness, const SparseMatrix& mass,
    const Eigen::VectorXi& order = Eigen::VectorXi());

  /// Factorises S - shift M and returns the number of eigenvalues below the shift (by Sylvester's
  /// law of inertia). Throws SolverFailure when the factorisation breaks down.
  Index Factorize(double shift, int threads);

  /// The relative error ||B - (S - shift M) X|| / ||B|| of a solve; the right-hand side is B = M Z
  /// with a random Z. Factors without pivoting lose digits where a leading part of the matrix is
  /// nearly singular, which depends on the shift. The error is usually about 1e-14, and rarely much
  /// larger.
  double SolveError(int threads) const;

  /// X <- (S - shift M)^-1 X.
  void Solve(BlockVector& x, int threads) const;

  /// X <- (S - shift M)^-1 M X for every block. With `refine`, one step of iterative refinement
  /// removes the error that factorising without pivoting leaves.
  void SolveWithMass(MultiVector& x, bool refine, int threads) const;

  Index Size() const { return this->PermutedMass.rows(); }

  /// The matrices in the order of elimination.
  const SparseMatrix& Stiffness() const { return this->PermutedStiffness; }
  const SparseMatrix& Mass() const { return this->PermutedMass; }

  /// The order of elimination: row i here is row Order()[i] of the matrices given to the
  /// constructor.
  const Eigen::VectorXi& Order() const { return this->OriginalRow; }

private:
  Eigen::VectorXi OriginalRow;
  SparseMatrix PermutedStiffness;
  SparseMatrix PermutedMass;
  SparseMatrix Shifted; // S - shift M
  // Set by the constructor, which can build it only once the order is known.
  std::optional<MultifrontalLdlt> Factors;
};

} // namespace spectralwatermark

#endif

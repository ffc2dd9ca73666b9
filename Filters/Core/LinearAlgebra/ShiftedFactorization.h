// SPDX-License-Identifier: BSD-3-Clause
#ifndef SpectralWatermark_Core_LinearAlgebra_ShiftedFactorization_h
#define SpectralWatermark_Core_LinearAlgebra_ShiftedFactorization_h

#include "Core/LinearAlgebra/MultiVector.h"
#include "Core/LinearAlgebra/MultifrontalLdlt.h"

#include <optional>

namespace spectralwatermark
{

/// L D L^T of S - sigma M, in an order that keeps L sparse. The seam behind which factorisations
/// take each other's place: this one is multifrontal after METIS's nested dissection, with
/// triangular solves for eight right-hand sides at a time.
///
/// Blocks are in the factorisation's order of rows throughout.
class ShiftedFactorization
{
public:
  /// Both matrices are kept in the order of elimination: the one given, as from Order() of matrices
  /// with the same pattern, or METIS's; a postorder of it that eliminates just as well.
  ShiftedFactorization(const SparseMatrix& stiffness, const SparseMatrix& mass,
    const Eigen::VectorXi& order = Eigen::VectorXi());

  /// Factorises S - shift M; returns how many eigenvalues lie under the shift (Sylvester's law of
  /// inertia). Throws SolverFailure when it breaks down.
  Index Factorize(double shift, int threads);

  /// ||B - (S - shift M) X|| / ||B|| of a solve with a random right-hand side M Z. Factors without
  /// pivoting lose digits where a leading part of the matrix is nearly singular, which hangs on the
  /// shift: about 1e-14 as a rule, and rarely much more.
  double SolveError(int threads) const;

  /// X <- (S - shift M)^-1 X.
  void Solve(BlockVector& x, int threads) const;

  /// X <- (S - shift M)^-1 M X for every block; with `refine`, one step of iterative refinement
  /// takes away the noise that factors without pivoting leave.
  void SolveWithMass(MultiVector& x, bool refine, int threads) const;

  Index Size() const { return this->PermutedMass.rows(); }

  const SparseMatrix& Stiffness() const { return this->PermutedStiffness; }
  const SparseMatrix& Mass() const { return this->PermutedMass; }

  /// Row i here is row Order()[i] of the matrices as they were given.
  const Eigen::VectorXi& Order() const { return this->OriginalRow; }

private:
  Eigen::VectorXi OriginalRow;
  SparseMatrix PermutedStiffness;
  SparseMatrix PermutedMass;
  SparseMatrix Shifted;                    // S - shift M
  std::optional<MultifrontalLdlt> Factors; // always there once constructed
};

} // namespace spectralwatermark

#endif

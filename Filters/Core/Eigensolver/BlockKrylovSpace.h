// SPDX-License-Identifier: BSD-3-Clause
#ifndef SpectralWatermark_Core_Eigensolver_BlockKrylovSpace_h
#define SpectralWatermark_Core_Eigensolver_BlockKrylovSpace_h

#include "Core/LinearAlgebra/MultiVector.h"
#include "Core/LinearAlgebra/ShiftedFactorization.h"

#include <cstdint>
#include <vector>

namespace spectralwatermark
{

/// The Krylov space of (S - sigma M)^-1 M from a starting block, with an M-orthonormal basis, and the
/// operator projected on it.
class BlockKrylovSpace
{
public:
  /// Begins with the given block, or a random one when it is empty, and stays M-orthogonal to `locked`.
  /// Throws SolverFailure when too few vertices have mass.
  BlockKrylovSpace(const ShiftedFactorization& factorization, MultiVector locked, BlockVector start,
    std::uint64_t seed, int threads);

  /// The number of vectors that the operator has been applied to: the size of the projected problem.
  Index Size() const { return BlockWidth * static_cast<Index>(this->Diagonal.size()); }

  /// Applies the operator to the last block and appends what is new in it. False when nothing is new: the
  /// space is invariant then.
  bool Extend();

  /// Makes all blocks orthogonal to the last digit, as needed before Projected(). False as Extend().
  bool Reorthogonalize();

  /// The operator in the basis: block tridiagonal, Size() x Size().
  Eigen::MatrixXd Projected() const;

  /// What the operator maps the last block to beyond the space, as a factor of the next block.
  const Eigen::MatrixXd& LastCoupling() const { return this->Coupling.back(); }

  /// Linear combinations of the basis, the last block included.
  MultiVector Combine(const Eigen::MatrixXd& coefficients) const;

private:
  // Q^T M W
  Eigen::MatrixXd Project(const MultiVectorView& q, const BlockVector* w, std::size_t count) const;

  // W <- W - Q Q^T M W; returns Q^T M W.
  Eigen::MatrixXd ProjectOut(const MultiVectorView& q, BlockVector* w, std::size_t count = 1) const;

  // W <- Q with W = Q R and Q^T M Q = I, by Cholesky of the Gram matrix. Q is orthonormal to the square of
  // W's condition, so that the last digit takes a second pass. Returns R; returns nothing when some
  // direction keeps hardly any of W's length, or of `length` if that is more.
  Eigen::MatrixXd Orthonormalize(BlockVector& w, double length = 0.0) const;

  MultiVectorView All() const { return MultiVectorView(this->Basis.data(), this->Basis.size()); }
  MultiVectorView Last(std::size_t count) const;

  bool Begin(BlockVector start);

  const ShiftedFactorization& Factorization;
  int Threads;
  std::size_t Locked;
  MultiVector Basis; // the locked blocks, then the Krylov blocks
  std::vector<Eigen::MatrixXd> Diagonal;
  std::vector<Eigen::MatrixXd> Coupling;
  std::size_t Pending = 0;     // last blocks that are orthogonal to the two before them only
  double Largest = 0.0;        // eigenvalue of the operator, as far as the space shows it
  mutable MultiVector Product; // workspace for M W
};

} // namespace spectralwatermark

#endif

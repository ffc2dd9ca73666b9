// SPDX-License-Identifier: BSD-3-Clause
/// A block Krylov space of a shift-inverted pencil.
#ifndef SpectralWatermark_Core_Eigensolver_BlockKrylovSpace_h
#define SpectralWatermark_Core_Eigensolver_BlockKrylovSpace_h

#include "Core/LinearAlgebra/MultiVector.h"
#include "Core/LinearAlgebra/ShiftedFactorization.h"

#include <cstdint>
#include <vector>

namespace spectralwatermark
{

/// The Krylov space of the operator (S - sigma M)^-1 M for a starting block, with an M-orthonormal
/// basis, and the projection of the operator onto it.
class BlockKrylovSpace
{
public:
  /// Begins with the block `start`, or with a random one when it is empty. The space stays
  /// M-orthogonal to `locked`. Throws SolverFailure when too few vertices have mass.
  BlockKrylovSpace(const ShiftedFactorization& factorization, MultiVector locked, BlockVector start,
    std::uint64_t seed, int threads);

  /// The size of the projected problem: the number of vectors that the operator was applied to.
  Index Size() const { return BlockWidth * static_cast<Index>(this->Diagonal.size()); }

  /// Applies the operator to the last block and appends the part of the image outside the space.
  /// Returns false when there is no such part: the space is then invariant.
  bool Extend();

  /// Makes all blocks orthogonal to the last digit, which Projected() requires. Returns false as
  /// Extend() does.
  bool Reorthogonalize();

  /// The operator in the basis: a block tridiagonal matrix, Size() x Size().
  Eigen::MatrixXd Projected() const;

  /// The coupling of the last block to the next one: the coefficients, in the next block, of the
  /// part of its image outside the space. Empty when the space is invariant.
  const Eigen::MatrixXd& LastCoupling() const { return this->Coupling.back(); }

  /// Linear combinations of the basis, the last block included.
  MultiVector Combine(const Eigen::MatrixXd& coefficients) const;

private:
  // Returns Q^T M W.
  Eigen::MatrixXd Project(const MultiVectorView& q, const BlockVector* w, std::size_t count) const;

  // W <- W - Q Q^T M W; returns Q^T M W.
  Eigen::MatrixXd ProjectOut(const MultiVectorView& q, BlockVector* w, std::size_t count = 1) const;

  // W <- Q with W = Q R and Q^T M Q = I, by Cholesky of the Gram matrix. The error in Q grows with
  // the square of W's condition number, so the last digit takes a second pass. Returns R, or an
  // empty matrix when some direction keeps hardly any of W's length, or of `length` if that is
  // greater.
  Eigen::MatrixXd Orthonormalize(BlockVector& w, double length = 0.0) const;

  // All blocks, the locked ones included.
  MultiVectorView All() const { return MultiVectorView(this->Basis.data(), this->Basis.size()); }

  // The last Krylov blocks, `count` of them or all.
  MultiVectorView Last(std::size_t count) const;

  // Makes `start` the first block. False when too little of it is outside the locked blocks.
  bool Begin(BlockVector start);

  const ShiftedFactorization& Factorization;
  int Threads;
  std::size_t Locked;                    // number of locked blocks
  MultiVector Basis;                     // the locked blocks, then the Krylov blocks
  std::vector<Eigen::MatrixXd> Diagonal; // the diagonal blocks of the projected operator
  std::vector<Eigen::MatrixXd> Coupling; // the blocks below the diagonal

  // The number of last blocks that are orthogonal only to the two blocks before them.
  std::size_t Pending = 0;

  // An estimate of the operator's largest eigenvalue: the largest diagonal entry so far.
  double Largest = 0.0;

  mutable MultiVector Product; // workspace for M W
};

} // namespace spectralwatermark

#endif

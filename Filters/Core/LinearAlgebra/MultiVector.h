// SPDX-License-Identifier: BSD-3-Clause
/// Dense algebra on blocks of vectors: eight vectors side by side, one row of eight per vertex.
///
/// Everything that a block Krylov method does with its basis streams it from memory. Blocks make
/// each row one or two registers wide, so that it is loaded once for all eight vectors, and suit
/// triangular solves with eight right-hand sides as they are.
#ifndef SpectralWatermark_Core_LinearAlgebra_MultiVector_h
#define SpectralWatermark_Core_LinearAlgebra_MultiVector_h

#include "Core/Support/Types.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <cstdint>
#include <vector>

namespace spectralwatermark
{

constexpr Index BlockWidth = 8;

using BlockVector = Eigen::Matrix<double, Eigen::Dynamic, BlockWidth, Eigen::RowMajor>;
using MultiVector = std::vector<BlockVector>;

/// So many blocks are worked on together where a basis goes by: more push each other out of the
/// cache.
constexpr std::size_t BlocksAtOnce = 8;

/// Some consecutive blocks of a basis.
struct MultiVectorView
{
  MultiVectorView(const BlockVector* first, std::size_t count)
    : First(first)
    , Count(static_cast<Index>(count))
  {
  }
  MultiVectorView(const MultiVector& blocks)
    : MultiVectorView(blocks.data(), blocks.size())
  {
  }

  const BlockVector* First;
  Index Count;
};

/// Rows of a block are worked on in chunks of this many, whatever the number of threads, so that
/// sums come out the same to the last bit.
constexpr Index RowsPerChunk = 2048;

/// A block with nothing in it yet. Large ones ask the system for huge pages, which what streams them
/// from memory gains from.
BlockVector MakeBlockVector(Index rows);

/// Standard normal numbers, the same for any number of threads.
BlockVector RandomBlockVector(Index rows, std::uint64_t seed, int threads);

/// Q^T Y: a row for each vector of `basis`, a column for each of `y`. The basis is streamed from
/// memory once for all of `y`, which should be BlocksAtOnce blocks or fewer.
Eigen::MatrixXd InnerProducts(const MultiVectorView& basis, const MultiVectorView& y, int threads);

/// Q^T A Y for a symmetric A; `product` is room for A Y, kept to be used again. A diagonal A costs next
/// to nothing.
Eigen::MatrixXd InnerProducts(const MultiVectorView& basis, const SparseMatrix& a,
  const MultiVectorView& y, MultiVector& product, int threads);

/// W -= Q C, with C as InnerProducts() gives it; W are as many blocks as C has columns for.
void SubtractCombination(const MultiVectorView& basis, const Eigen::MatrixXd& c, BlockVector* w,
  int threads);

/// W <- W R^-1 for an upper triangular R of size eight.
void SolveTriangularRight(const Eigen::MatrixXd& r, BlockVector& w, int threads);

/// Y = A X for a sparse symmetric A (compressed, as everywhere here).
void MultiplyBlock(const SparseMatrix& a, const BlockVector& x, BlockVector& y, int threads);

/// The linear combinations Q C of the first vectors of the basis, as many as C has rows, as blocks,
/// the last one filled up with zeros.
MultiVector LinearCombination(const MultiVectorView& basis, const Eigen::MatrixXd& c, int threads);

/// V^T A V for a symmetric A.
Eigen::MatrixXd GramMatrix(const SparseMatrix& a, const MultiVector& v, int threads);

/// The columns with these numbers (counted through all blocks), in this order, as blocks, the last
/// one filled up with zeros.
MultiVector SelectColumns(const MultiVector& blocks, const std::vector<Index>& columns,
  int threads);

/// Columns as blocks, the last one filled up with zeros: row i of a block is row order[i].
MultiVector ToMultiVector(const Eigen::MatrixXd& columns, const Eigen::VectorXi& order);

/// The inverse of ToMultiVector(), for the columns with these ascending numbers. Blocks are freed one by
/// one, so that the vectors are not in memory twice.
Eigen::MatrixXd TakeColumns(MultiVector blocks, const std::vector<Index>& columns,
  const Eigen::VectorXi& order, int threads);

} // namespace spectralwatermark

#endif

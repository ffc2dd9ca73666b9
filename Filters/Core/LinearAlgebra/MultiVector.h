// SPDX-License-Identifier: BSD-3-Clause
/// Dense algebra on blocks of eight vectors, stored side by side: one row of eight per vertex.
///
/// A block Krylov method streams its basis from memory in everything it does. Blocks make each row
/// one or two registers wide, so that it is loaded once for all eight vectors. They also suit
/// triangular solves with eight right-hand sides without a conversion.
#ifndef SpectralWatermark_Core_LinearAlgebra_MultiVector_h
#define SpectralWatermark_Core_LinearAlgebra_MultiVector_h

#include "Core/Support/Types.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <cstdint>
#include <vector>

namespace spectralwatermark
{

/// The number of vectors in a block.
constexpr Index BlockWidth = 8;

/// A block of eight vectors, a column each.
using BlockVector = Eigen::Matrix<double, Eigen::Dynamic, BlockWidth, Eigen::RowMajor>;

/// Any number of vectors, in blocks of eight.
using MultiVector = std::vector<BlockVector>;

/// The number of blocks that are processed together while a basis is streamed. More of them would
/// evict each other from the cache.
constexpr std::size_t BlocksAtOnce = 8;

/// Consecutive blocks of a basis, which must outlive the view.
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

/// The number of rows of a block that are processed as one chunk. It does not depend on the number
/// of threads, so that sums are the same to the last bit.
constexpr Index RowsPerChunk = 2048;

/// An uninitialised block. Large ones ask the system for huge pages, which makes streaming them
/// from memory faster.
BlockVector MakeBlockVector(Index rows);

/// A block of standard normal numbers, the same for any number of threads.
BlockVector RandomBlockVector(Index rows, std::uint64_t seed, int threads);

/// Q^T Y: a row for each vector of `basis`, a column for each of `y`. The basis is streamed from
/// memory once for all of `y`, which should be BlocksAtOnce blocks or fewer.
Eigen::MatrixXd InnerProducts(const MultiVectorView& basis, const MultiVectorView& y, int threads);

/// Q^T A Y for a symmetric A. `product` is a workspace for A Y that later calls can reuse. A
/// diagonal A adds almost no cost.
Eigen::MatrixXd InnerProducts(const MultiVectorView& basis, const SparseMatrix& a,
  const MultiVectorView& y, MultiVector& product, int threads);

/// W -= Q C, with C as InnerProducts() returns it. W has one block for every eight columns of C.
void SubtractCombination(const MultiVectorView& basis, const Eigen::MatrixXd& c, BlockVector* w,
  int threads);

/// W <- W R^-1 for an upper triangular R of size eight.
void SolveTriangularRight(const Eigen::MatrixXd& r, BlockVector& w, int threads);

/// Y = A X for a sparse symmetric A in compressed mode.
void MultiplyBlock(const SparseMatrix& a, const BlockVector& x, BlockVector& y, int threads);

/// The linear combinations Q C as blocks, the last one padded with zeros. Q are the first vectors
/// of the basis, as many as C has rows.
MultiVector LinearCombination(const MultiVectorView& basis, const Eigen::MatrixXd& c, int threads);

/// V^T A V for a symmetric A.
Eigen::MatrixXd GramMatrix(const SparseMatrix& a, const MultiVector& v, int threads);

/// The columns with these numbers (counted through all blocks), in this order, as blocks, the last
/// one padded with zeros.
MultiVector SelectColumns(const MultiVector& blocks, const std::vector<Index>& columns,
  int threads);

/// The columns as blocks, the last one padded with zeros. Row i of a block is row order[i] of
/// `columns`.
MultiVector ToMultiVector(const Eigen::MatrixXd& columns, const Eigen::VectorXi& order);

/// The inverse of ToMultiVector(), for the columns with these ascending numbers. Each block is
/// freed once it is copied, so that the vectors are not in memory twice.
Eigen::MatrixXd TakeColumns(MultiVector blocks, const std::vector<Index>& columns,
  const Eigen::VectorXi& order, int threads);

} // namespace spectralwatermark

#endif

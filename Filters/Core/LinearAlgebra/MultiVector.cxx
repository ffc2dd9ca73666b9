// SPDX-License-Identifier: BSD-3-Clause
#include "Core/LinearAlgebra/MultiVector.h"

#include "Core/LinearAlgebra/SimdRow.h"
#include "Core/Support/Parallel.h"
#include "Core/Support/Random.h"

#ifdef __linux__
#include <sys/mman.h>
#endif

#include <cstdint>

namespace spectralwatermark
{

namespace
{

Index ChunkCount(Index rows)
{
  return (rows + RowsPerChunk - 1) / RowsPerChunk;
}

// Coefficients of a block: a row of eight for each vector of a basis.
using Small = Eigen::Matrix<double, Eigen::Dynamic, BlockWidth, Eigen::RowMajor>;

} // namespace

// c (8 x 8, row-major) += q^T y
MULTIVERSIONED void BlockOuterProduct(const double* q, const double* y, Index rows, double* c)
{
  SimdRow sum[8];
  for (int i = 0; i < 8; ++i)
  {
    sum[i] = SimdRows(c)[i];
  }
  for (Index r = 0; r < rows; ++r)
  {
    const SimdRow right = SimdRows(y)[r];
    const double* left = q + 8 * r;
    for (int i = 0; i < 8; ++i)
    {
      sum[i] += left[i] * right;
    }
  }
  for (int i = 0; i < 8; ++i)
  {
    SimdRows(c)[i] = sum[i];
  }
}

// w += q c, c 8 x 8 row-major
MULTIVERSIONED void AccumulateBlock(const double* q, const double* c, Index rows, double* w)
{
  SimdRow right[8];
  for (int j = 0; j < 8; ++j)
  {
    right[j] = SimdRows(c)[j];
  }
  Index r = 0;
  for (; r + 4 <= rows; r += 4)
  {
    SimdRow sum[4];
    for (int i = 0; i < 4; ++i)
    {
      sum[i] = SimdRows(w)[r + i];
    }
    const double* left = q + 8 * r;
    for (int j = 0; j < 8; ++j)
    {
      for (int i = 0; i < 4; ++i)
      {
        sum[i] += left[8 * i + j] * right[j];
      }
    }
    for (int i = 0; i < 4; ++i)
    {
      SimdRows(w)[r + i] = sum[i];
    }
  }
  for (; r < rows; ++r)
  {
    SimdRow sum = SimdRows(w)[r];
    for (int j = 0; j < 8; ++j)
    {
      sum += q[8 * r + j] * right[j];
    }
    SimdRows(w)[r] = sum;
  }
}

MULTIVERSIONED void MultiplyRows(const int* outer, const int* inner, const double* value,
  Index begin, Index end, const double* x, double* y)
{
  for (Index j = begin; j < end; ++j)
  {
    SimdRow sum{};
    for (int p = outer[j]; p < outer[j + 1]; ++p)
    {
      sum += value[p] * SimdRows(x)[inner[p]];
    }
    SimdRows(y)[j] = sum;
  }
}

namespace
{

// The columns of C for each block of the result, padded with zeros in both directions.
std::vector<Small> CoefficientsByBlock(const Eigen::MatrixXd& c, const MultiVectorView& basis)
{
  std::vector<Small> coefficients;
  for (Index first = 0; first < c.cols(); first += BlockWidth)
  {
    const Index columns = std::min(BlockWidth, c.cols() - first);
    coefficients.emplace_back(Small::Zero(BlockWidth * basis.Count, BlockWidth));
    coefficients.back().topLeftCorner(c.rows(), columns) = c.middleCols(first, columns);
  }
  return coefficients;
}

} // namespace

BlockVector MakeBlockVector(Index rows)
{
  BlockVector block(rows, BlockWidth);
#if defined(__linux__) && defined(MADV_HUGEPAGE)
  constexpr std::size_t hugePage = std::size_t{ 1 } << 21;
  const std::size_t bytes = block.size() * sizeof(double);
  char* begin = reinterpret_cast<char*>(block.data());
  const std::size_t skipped =
    (hugePage - reinterpret_cast<std::uintptr_t>(begin) % hugePage) % hugePage;
  if (bytes >= skipped + hugePage)
  {
    // This is only a hint, so its failure does not matter.
    madvise(begin + skipped, (bytes - skipped) / hugePage * hugePage, MADV_HUGEPAGE);
  }
#endif
  return block;
}

BlockVector RandomBlockVector(Index rows, std::uint64_t seed, int threads)
{
  BlockVector block = MakeBlockVector(rows);
  ForEachTask(threads, ChunkCount(rows),
    [&](Index chunk)
    {
      const Index end = std::min(rows, (chunk + 1) * RowsPerChunk) * BlockWidth;
      for (Index i = chunk * RowsPerChunk * BlockWidth; i < end; ++i)
      {
        block.data()[i] = NormalRandom(seed, static_cast<std::uint64_t>(i));
      }
    });
  return block;
}

namespace
{

// Q^T Y, with the rows of Y multiplied by `scale` if there is one.
Eigen::MatrixXd ProjectScaled(const MultiVectorView& basis, const MultiVectorView& y,
  const double* scale, int threads)
{
  const Index rows = basis.Count > 0 ? basis.First[0].rows() : 0;
  const Index chunks = ChunkCount(rows);
  // Each group of chunks has a partial sum. The groups are few, so that adding the sums is cheap,
  // and do not depend on the number of threads.
  const Index groups = std::min<Index>(chunks, 8);
  const Index pairs = basis.Count * y.Count;
  std::vector<Small> partial(groups, Small::Zero(8 * pairs, 8));
  ForEachTask(threads, groups,
    [&](Index group)
    {
      double* sum = partial[group].data();
      MultiVector scaled(scale != nullptr ? y.Count : 0);
      std::vector<const double*> right(y.Count);
      for (Index chunk = group * chunks / groups; chunk < (group + 1) * chunks / groups; ++chunk)
      {
        const Index begin = chunk * RowsPerChunk;
        const Index count = std::min(RowsPerChunk, rows - begin);
        for (Index j = 0; j < y.Count; ++j)
        {
          right[j] = y.First[j].data() + 8 * begin;
          if (scale != nullptr)
          {
            scaled[j] = Eigen::Map<const Eigen::VectorXd>(scale + begin, count).asDiagonal() *
              y.First[j].middleRows(begin, count);
            right[j] = scaled[j].data();
          }
        }
        for (Index pair = 0; pair < pairs; ++pair)
        {
          BlockOuterProduct(basis.First[pair / y.Count].data() + 8 * begin, right[pair % y.Count],
            count, sum + 64 * pair);
        }
      }
    });
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(8 * basis.Count, 8 * y.Count);
  for (const Small& sum : partial)
  {
    for (Index pair = 0; pair < pairs; ++pair)
    {
      result.block<8, 8>(8 * (pair / y.Count), 8 * (pair % y.Count)) += sum.middleRows<8>(8 * pair);
    }
  }
  return result;
}

bool IsDiagonal(const SparseMatrix& a)
{
  if (a.nonZeros() != a.cols())
  {
    return false;
  }
  for (Index j = 0; j < a.cols(); ++j)
  {
    if (a.outerIndexPtr()[j] != j || a.innerIndexPtr()[j] != j)
    {
      return false;
    }
  }
  return true;
}

} // namespace

Eigen::MatrixXd InnerProducts(const MultiVectorView& basis, const MultiVectorView& y, int threads)
{
  return ProjectScaled(basis, y, nullptr, threads);
}

Eigen::MatrixXd InnerProducts(const MultiVectorView& basis, const SparseMatrix& a,
  const MultiVectorView& y, MultiVector& product, int threads)
{
  if (IsDiagonal(a))
  {
    return ProjectScaled(basis, y, a.valuePtr(), threads);
  }
  product.resize(std::max<std::size_t>(product.size(), y.Count));
  for (Index k = 0; k < y.Count; ++k)
  {
    MultiplyBlock(a, y.First[k], product[k], threads);
  }
  return ProjectScaled(basis, MultiVectorView(product.data(), y.Count), nullptr, threads);
}

void SubtractCombination(const MultiVectorView& basis, const Eigen::MatrixXd& c, BlockVector* w,
  int threads)
{
  const Index outputs = c.cols() / BlockWidth;
  const std::vector<Small> negative = CoefficientsByBlock(-c, basis);
  ForEachTask(threads, basis.Count > 0 ? ChunkCount(basis.First[0].rows()) : 0,
    [&](Index chunk)
    {
      const Index begin = chunk * RowsPerChunk;
      const Index rows = std::min(RowsPerChunk, basis.First[0].rows() - begin);
      for (Index k = 0; k < basis.Count; ++k)
      {
        for (Index output = 0; output < outputs; ++output)
        {
          AccumulateBlock(basis.First[k].data() + BlockWidth * begin,
            negative[output].data() + 64 * k, rows, w[output].data() + BlockWidth * begin);
        }
      }
    });
}

void SolveTriangularRight(const Eigen::MatrixXd& r, BlockVector& w, int threads)
{
  using Square = Eigen::Matrix<double, BlockWidth, BlockWidth, Eigen::RowMajor>;
  const Square inverse =
    r.triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(BlockWidth, BlockWidth));
  ForEachTask(threads, ChunkCount(w.rows()),
    [&](Index chunk)
    {
      const Index begin = chunk * RowsPerChunk;
      const Index rows = std::min(RowsPerChunk, w.rows() - begin);
      const BlockVector old = w.middleRows(begin, rows);
      w.middleRows(begin, rows).setZero();
      AccumulateBlock(old.data(), inverse.data(), rows, w.data() + 8 * begin);
    });
}

void MultiplyBlock(const SparseMatrix& a, const BlockVector& x, BlockVector& y, int threads)
{
  if (y.rows() != x.rows())
  {
    y = MakeBlockVector(x.rows());
  }
  ForEachTask(threads, ChunkCount(x.rows()),
    [&](Index chunk)
    {
      const Index begin = chunk * RowsPerChunk;
      MultiplyRows(a.outerIndexPtr(), a.innerIndexPtr(), a.valuePtr(), begin,
        std::min(begin + RowsPerChunk, x.rows()), x.data(), y.data());
    });
}

MultiVector LinearCombination(const MultiVectorView& basis, const Eigen::MatrixXd& c, int threads)
{
  const Index rows = basis.Count > 0 ? basis.First[0].rows() : 0;
  const std::vector<Small> coefficients = CoefficientsByBlock(c, basis);
  MultiVector result;
  for (std::size_t output = 0; output < coefficients.size(); ++output)
  {
    result.push_back(MakeBlockVector(rows));
  }
  // Few enough rows that a tile of the whole basis stays in the cache.
  constexpr Index rowsPerTile = 256;
  ForEachTask(threads, (rows + rowsPerTile - 1) / rowsPerTile,
    [&](Index tile)
    {
      const Index begin = tile * rowsPerTile;
      const Index count = std::min(rowsPerTile, rows - begin);
      for (std::size_t output = 0; output < result.size(); ++output)
      {
        result[output].middleRows(begin, count).setZero();
        for (Index k = 0; k < basis.Count; ++k)
        {
          AccumulateBlock(basis.First[k].data() + BlockWidth * begin,
            coefficients[output].data() + 64 * k, count,
            result[output].data() + BlockWidth * begin);
        }
      }
    });
  return result;
}

Eigen::MatrixXd GramMatrix(const SparseMatrix& a, const MultiVector& v, int threads)
{
  const Index size = BlockWidth * static_cast<Index>(v.size());
  Eigen::MatrixXd gram(size, size);
  MultiVector product;
  for (std::size_t first = 0; first < v.size(); first += BlocksAtOnce)
  {
    const std::size_t count = std::min(BlocksAtOnce, v.size() - first);
    const Index column = BlockWidth * static_cast<Index>(first);
    const Index columns = BlockWidth * static_cast<Index>(count);
    gram.block(0, column, column + columns, columns) =
      InnerProducts(MultiVectorView(v.data(), first + count), a,
        MultiVectorView(v.data() + first, count), product, threads);
  }
  gram.triangularView<Eigen::StrictlyLower>() = gram.transpose();
  return gram;
}

MultiVector SelectColumns(const MultiVector& blocks, const std::vector<Index>& columns, int threads)
{
  const Index rows = blocks.empty() ? 0 : blocks.front().rows();
  MultiVector result;
  for (std::size_t first = 0; first < columns.size(); first += BlockWidth)
  {
    result.push_back(MakeBlockVector(rows));
    const std::size_t count = std::min<std::size_t>(BlockWidth, columns.size() - first);
    double* target = result.back().data();
    ForEachTask(threads, ChunkCount(rows),
      [&](Index chunk)
      {
        const Index begin = chunk * RowsPerChunk;
        const Index end = std::min(begin + RowsPerChunk, rows);
        for (std::size_t c = 0; c < BlockWidth; ++c)
        {
          const Index column = c < count ? columns[first + c] : 0;
          const double* source = blocks[column / BlockWidth].data() + column % BlockWidth;
          for (Index row = begin; row < end; ++row)
          {
            target[BlockWidth * row + static_cast<Index>(c)] =
              c < count ? source[BlockWidth * row] : 0.0;
          }
        }
      });
  }
  return result;
}

MultiVector ToMultiVector(const Eigen::MatrixXd& columns, const Eigen::VectorXi& order)
{
  MultiVector blocks;
  for (Index first = 0; first < columns.cols(); first += BlockWidth)
  {
    BlockVector block = MakeBlockVector(order.size());
    const Index count = std::min(BlockWidth, columns.cols() - first);
    for (Index row = 0; row < order.size(); ++row)
    {
      block.row(row).tail(BlockWidth - count).setZero();
      block.row(row).head(count) = columns.row(order[row]).segment(first, count);
    }
    blocks.push_back(std::move(block));
  }
  return blocks;
}

Eigen::MatrixXd TakeColumns(MultiVector blocks, const std::vector<Index>& columns,
  const Eigen::VectorXi& order, int threads)
{
  Eigen::MatrixXd result(order.size(), static_cast<Index>(columns.size()));
  std::size_t begin = 0;
  for (std::size_t k = 0; k < blocks.size(); ++k)
  {
    std::size_t end = begin;
    while (end < columns.size() && columns[end] / BlockWidth == static_cast<Index>(k))
    {
      ++end;
    }
    ForEachTask(threads, ChunkCount(order.size()),
      [&](Index chunk)
      {
        const Index last = std::min((chunk + 1) * RowsPerChunk, order.size());
        for (Index row = chunk * RowsPerChunk; row < last; ++row)
        {
          for (std::size_t c = begin; c < end; ++c)
          {
            result(order[row], static_cast<Index>(c)) = blocks[k](row, columns[c] % BlockWidth);
          }
        }
      });
    blocks[k].resize(0, BlockWidth);
    begin = end;
  }
  return result;
}

} // namespace spectralwatermark

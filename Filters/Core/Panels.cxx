// SPDX-License-Identifier: BSD-3-Clause
#include "Panels.h"

#include "Noise.h"
#include "PanelRows.h"
#include "Parallel.h"

#ifdef __linux__
#include <sys/mman.h>
#endif

#include <cstdint>

namespace spectralwatermark
{

using Eigen::Index;

namespace
{

Index ChunkCount(Index rows)
{
  return (rows + RowsPerChunk - 1) / RowsPerChunk;
}

// A row of eight for each vector of a basis.
using Small = Eigen::Matrix<double, Eigen::Dynamic, PanelWidth, Eigen::RowMajor>;

} // namespace

// c (8 x 8, row-major) += q^T y
WIDEST_INSTRUCTIONS void PanelOuter(const double* q, const double* y, Index rows, double* c)
{
  Row sum[8];
  for (int i = 0; i < 8; ++i)
  {
    sum[i] = Rows(c)[i];
  }
  for (Index r = 0; r < rows; ++r)
  {
    const Row right = Rows(y)[r];
    const double* left = q + 8 * r;
    for (int i = 0; i < 8; ++i)
    {
      sum[i] += left[i] * right;
    }
  }
  for (int i = 0; i < 8; ++i)
  {
    Rows(c)[i] = sum[i];
  }
}

// w += q c, c 8 x 8 row-major
WIDEST_INSTRUCTIONS void PanelAccumulate(const double* q, const double* c, Index rows, double* w)
{
  Row right[8];
  for (int j = 0; j < 8; ++j)
  {
    right[j] = Rows(c)[j];
  }
  Index r = 0;
  for (; r + 4 <= rows; r += 4)
  {
    Row sum[4];
    for (int i = 0; i < 4; ++i)
    {
      sum[i] = Rows(w)[r + i];
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
      Rows(w)[r + i] = sum[i];
    }
  }
  for (; r < rows; ++r)
  {
    Row sum = Rows(w)[r];
    for (int j = 0; j < 8; ++j)
    {
      sum += q[8 * r + j] * right[j];
    }
    Rows(w)[r] = sum;
  }
}

WIDEST_INSTRUCTIONS void MultiplyRows(const int* outer, const int* inner, const double* value,
  Index begin, Index end, const double* x, double* y)
{
  for (Index j = begin; j < end; ++j)
  {
    Row sum{};
    for (int p = outer[j]; p < outer[j + 1]; ++p)
    {
      sum += value[p] * Rows(x)[inner[p]];
    }
    Rows(y)[j] = sum;
  }
}

namespace
{

// The columns of C for each panel that comes out, filled up with zeros in both directions.
std::vector<Small> CoefficientsByPanel(const Eigen::MatrixXd& c, const PanelRange& basis)
{
  std::vector<Small> coefficients;
  for (Index first = 0; first < c.cols(); first += PanelWidth)
  {
    const Index columns = std::min(PanelWidth, c.cols() - first);
    coefficients.emplace_back(Small::Zero(PanelWidth * basis.Count, PanelWidth));
    coefficients.back().topLeftCorner(c.rows(), columns) = c.middleCols(first, columns);
  }
  return coefficients;
}

} // namespace

Panel MakePanel(Index rows)
{
  Panel panel(rows, PanelWidth);
#if defined(__linux__) && defined(MADV_HUGEPAGE)
  constexpr std::size_t hugePage = std::size_t{ 1 } << 21;
  const std::size_t bytes = static_cast<std::size_t>(panel.size()) * sizeof(double);
  char* begin = reinterpret_cast<char*>(panel.data());
  const std::size_t skipped =
    (hugePage - reinterpret_cast<std::uintptr_t>(begin) % hugePage) % hugePage;
  if (bytes >= skipped + hugePage)
  {
    // A hint: may fail.
    madvise(begin + skipped, (bytes - skipped) / hugePage * hugePage, MADV_HUGEPAGE);
  }
#endif
  return panel;
}

Panel RandomPanel(Index rows, std::uint64_t seed, int threads)
{
  Panel panel = MakePanel(rows);
  ForEachTask(threads, ChunkCount(rows),
    [&](Index chunk)
    {
      const Index end = std::min(rows, (chunk + 1) * RowsPerChunk) * PanelWidth;
      for (Index i = chunk * RowsPerChunk * PanelWidth; i < end; ++i)
      {
        panel.data()[i] = NormalRandom(seed, static_cast<std::uint64_t>(i));
      }
    });
  return panel;
}

namespace
{

// Q^T Y, with the rows of Y multiplied by `scale` if there is one.
Eigen::MatrixXd ProjectScaled(const PanelRange& basis, const PanelRange& y, const double* scale,
  int threads)
{
  const Index rows = basis.Count > 0 ? basis.First[0].rows() : 0;
  const Index chunks = ChunkCount(rows);
  // A partial sum for each group of chunks: few enough to add up, the same for any threads.
  const Index groups = std::min<Index>(chunks, 8);
  const Index pairs = basis.Count * y.Count;
  std::vector<Small> partial(static_cast<std::size_t>(groups), Small::Zero(8 * pairs, 8));
  ForEachTask(threads, groups,
    [&](Index group)
    {
      double* sum = partial[static_cast<std::size_t>(group)].data();
      Panels scaled(scale != nullptr ? static_cast<std::size_t>(y.Count) : 0);
      std::vector<const double*> right(static_cast<std::size_t>(y.Count));
      for (Index chunk = group * chunks / groups; chunk < (group + 1) * chunks / groups; ++chunk)
      {
        const Index begin = chunk * RowsPerChunk;
        const Index count = std::min(RowsPerChunk, rows - begin);
        for (Index j = 0; j < y.Count; ++j)
        {
          const auto column = static_cast<std::size_t>(j);
          right[column] = y.First[j].data() + 8 * begin;
          if (scale != nullptr)
          {
            scaled[column] = Eigen::Map<const Eigen::VectorXd>(scale + begin, count).asDiagonal() *
              y.First[j].middleRows(begin, count);
            right[column] = scaled[column].data();
          }
        }
        for (Index pair = 0; pair < pairs; ++pair)
        {
          PanelOuter(basis.First[pair / y.Count].data() + 8 * begin,
            right[static_cast<std::size_t>(pair % y.Count)], count, sum + 64 * pair);
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

bool IsDiagonal(const Eigen::SparseMatrix<double>& a)
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

Eigen::MatrixXd ProjectPanels(const PanelRange& basis, const PanelRange& y, int threads)
{
  return ProjectScaled(basis, y, nullptr, threads);
}

Eigen::MatrixXd ProjectPanels(const PanelRange& basis, const Eigen::SparseMatrix<double>& a,
  const PanelRange& y, Panels& product, int threads)
{
  if (IsDiagonal(a))
  {
    return ProjectScaled(basis, y, a.valuePtr(), threads);
  }
  product.resize(std::max(product.size(), static_cast<std::size_t>(y.Count)));
  for (Index k = 0; k < y.Count; ++k)
  {
    MultiplyPanel(a, y.First[k], product[static_cast<std::size_t>(k)], threads);
  }
  return ProjectScaled(basis, PanelRange(product.data(), static_cast<std::size_t>(y.Count)),
    nullptr, threads);
}

void SubtractPanels(const PanelRange& basis, const Eigen::MatrixXd& c, Panel* w, int threads)
{
  const Index outputs = c.cols() / PanelWidth;
  const std::vector<Small> negative = CoefficientsByPanel(-c, basis);
  ForEachTask(threads, basis.Count > 0 ? ChunkCount(basis.First[0].rows()) : 0,
    [&](Index chunk)
    {
      const Index begin = chunk * RowsPerChunk;
      const Index rows = std::min(RowsPerChunk, basis.First[0].rows() - begin);
      for (Index k = 0; k < basis.Count; ++k)
      {
        for (Index output = 0; output < outputs; ++output)
        {
          PanelAccumulate(basis.First[k].data() + PanelWidth * begin,
            negative[static_cast<std::size_t>(output)].data() + 64 * k, rows,
            w[output].data() + PanelWidth * begin);
        }
      }
    });
}

void SolveTriangularRight(const Eigen::MatrixXd& r, Panel& w, int threads)
{
  using Square = Eigen::Matrix<double, PanelWidth, PanelWidth, Eigen::RowMajor>;
  const Square inverse =
    r.triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(PanelWidth, PanelWidth));
  ForEachTask(threads, ChunkCount(w.rows()),
    [&](Index chunk)
    {
      const Index begin = chunk * RowsPerChunk;
      const Index rows = std::min(RowsPerChunk, w.rows() - begin);
      const Panel old = w.middleRows(begin, rows);
      w.middleRows(begin, rows).setZero();
      PanelAccumulate(old.data(), inverse.data(), rows, w.data() + 8 * begin);
    });
}

void MultiplyPanel(const Eigen::SparseMatrix<double>& a, const Panel& x, Panel& y, int threads)
{
  if (y.rows() != x.rows())
  {
    y = MakePanel(x.rows());
  }
  ForEachTask(threads, ChunkCount(x.rows()),
    [&](Index chunk)
    {
      const Index begin = chunk * RowsPerChunk;
      MultiplyRows(a.outerIndexPtr(), a.innerIndexPtr(), a.valuePtr(), begin,
        std::min(begin + RowsPerChunk, x.rows()), x.data(), y.data());
    });
}

Panels CombinePanels(const PanelRange& basis, const Eigen::MatrixXd& c, int threads)
{
  const Index rows = basis.Count > 0 ? basis.First[0].rows() : 0;
  const std::vector<Small> coefficients = CoefficientsByPanel(c, basis);
  Panels result;
  for (std::size_t output = 0; output < coefficients.size(); ++output)
  {
    result.push_back(MakePanel(rows));
  }
  constexpr Index rowsPerTile = 256; // few enough that a tile of the whole basis stays in the cache
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
          PanelAccumulate(basis.First[k].data() + PanelWidth * begin,
            coefficients[output].data() + 64 * k, count,
            result[output].data() + PanelWidth * begin);
        }
      }
    });
  return result;
}

Eigen::MatrixXd GramOfPanels(const Eigen::SparseMatrix<double>& a, const Panels& v, int threads)
{
  const Index size = PanelWidth * static_cast<Index>(v.size());
  Eigen::MatrixXd gram(size, size);
  Panels product;
  for (std::size_t first = 0; first < v.size(); first += PanelsAtOnce)
  {
    const std::size_t count = std::min(PanelsAtOnce, v.size() - first);
    const Index column = PanelWidth * static_cast<Index>(first);
    const Index columns = PanelWidth * static_cast<Index>(count);
    gram.block(0, column, column + columns, columns) =
      ProjectPanels(PanelRange(v.data(), first + count), a, PanelRange(v.data() + first, count),
        product, threads);
  }
  gram.triangularView<Eigen::StrictlyLower>() = gram.transpose();
  return gram;
}

Panels SelectColumns(const Panels& panels, const std::vector<Index>& columns, int threads)
{
  const Index rows = panels.empty() ? 0 : panels.front().rows();
  Panels result;
  for (std::size_t first = 0; first < columns.size(); first += PanelWidth)
  {
    result.push_back(MakePanel(rows));
    const std::size_t count = std::min<std::size_t>(PanelWidth, columns.size() - first);
    double* target = result.back().data();
    ForEachTask(threads, ChunkCount(rows),
      [&](Index chunk)
      {
        const Index begin = chunk * RowsPerChunk;
        const Index end = std::min(begin + RowsPerChunk, rows);
        for (std::size_t c = 0; c < PanelWidth; ++c)
        {
          const Index column = c < count ? columns[first + c] : 0;
          const double* source =
            panels[static_cast<std::size_t>(column / PanelWidth)].data() + column % PanelWidth;
          for (Index row = begin; row < end; ++row)
          {
            target[PanelWidth * row + static_cast<Index>(c)] =
              c < count ? source[PanelWidth * row] : 0.0;
          }
        }
      });
  }
  return result;
}

Panels ToPanels(const Eigen::MatrixXd& columns, const Eigen::VectorXi& order)
{
  Panels panels;
  for (Index first = 0; first < columns.cols(); first += PanelWidth)
  {
    Panel panel = MakePanel(order.size());
    const Index count = std::min(PanelWidth, columns.cols() - first);
    for (Index row = 0; row < order.size(); ++row)
    {
      panel.row(row).tail(PanelWidth - count).setZero();
      panel.row(row).head(count) = columns.row(order[row]).segment(first, count);
    }
    panels.push_back(std::move(panel));
  }
  return panels;
}

Eigen::MatrixXd TakeColumns(Panels panels, const std::vector<Index>& columns,
  const Eigen::VectorXi& order, int threads)
{
  Eigen::MatrixXd result(order.size(), static_cast<Index>(columns.size()));
  std::size_t begin = 0;
  for (std::size_t k = 0; k < panels.size(); ++k)
  {
    std::size_t end = begin;
    while (end < columns.size() && columns[end] / PanelWidth == static_cast<Index>(k))
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
            result(order[row], static_cast<Index>(c)) = panels[k](row, columns[c] % PanelWidth);
          }
        }
      });
    panels[k].resize(0, PanelWidth);
    begin = end;
  }
  return result;
}

} // namespace spectralwatermark

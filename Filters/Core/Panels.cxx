// SPDX-License-Identifier: BSD-3-Clause
#include "Panels.h"

#include "Parallel.h"

// The widest instructions that the machine has are chosen when the library is loaded; sanitizers
// cannot run that early.
#ifdef __has_feature
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define CHOSEN_TOO_EARLY
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define CHOSEN_TOO_EARLY
#endif
#if defined(__x86_64__) && defined(__GNUC__) && !defined(CHOSEN_TOO_EARLY)
#define WIDEST_INSTRUCTIONS __attribute__((target_clones("avx512f", "arch=haswell", "default")))
#else
#define WIDEST_INSTRUCTIONS
#endif

namespace spectralwatermark
{

using Eigen::Index;

// A row of a panel. Aligned to a double only, as rows of any buffer are.
typedef double Row __attribute__((vector_size(64), aligned(8), may_alias));

namespace
{

inline const Row* Rows(const double* data)
{
  return reinterpret_cast<const Row*>(data);
}
inline Row* Rows(double* data)
{
  return reinterpret_cast<Row*>(data);
}

Index ChunkCount(Index rows)
{
  return (rows + RowsPerChunk - 1) / RowsPerChunk;
}

// Where row `begin` of each panel is.
std::vector<const double*> RowsFrom(const PanelRange& basis, Index begin)
{
  std::vector<const double*> rows;
  for (Index k = 0; k < basis.Count; ++k)
  {
    rows.push_back(basis.First[k].data() + PanelWidth * begin);
  }
  return rows;
}

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

// w += sign * sum over panels q_k c_k, c_k 8 x 8 row-major
WIDEST_INSTRUCTIONS void PanelAccumulate(const double* const* q, Index panels, const double* c,
  Index rows, double* w)
{
  Index r = 0;
  for (; r + 4 <= rows; r += 4)
  {
    Row sum[4];
    for (int i = 0; i < 4; ++i)
    {
      sum[i] = Rows(w)[r + i];
    }
    for (Index k = 0; k < panels; ++k)
    {
      const double* left = q[k] + 8 * r;
      const Row* right = Rows(c) + 8 * k;
      for (int j = 0; j < 8; ++j)
      {
        const Row row = right[j];
        sum[0] += left[j] * row;
        sum[1] += left[8 + j] * row;
        sum[2] += left[16 + j] * row;
        sum[3] += left[24 + j] * row;
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
    for (Index k = 0; k < panels; ++k)
    {
      for (int j = 0; j < 8; ++j)
      {
        sum += q[k][8 * r + j] * Rows(c)[8 * k + j];
      }
    }
    Rows(w)[r] = sum;
  }
}

WIDEST_INSTRUCTIONS void SolveColumns(const int* outer, const int* inner, const double* value,
  const double* inverseD, Index n, double* x)
{
  for (Index j = 0; j < n; ++j)
  {
    const Row xj = Rows(x)[j];
    for (int p = outer[j]; p < outer[j + 1]; ++p)
    {
      Rows(x)[inner[p]] -= value[p] * xj;
    }
  }
  for (Index j = n - 1; j >= 0; --j)
  {
    Row sum = inverseD[j] * Rows(x)[j];
    for (int p = outer[j]; p < outer[j + 1]; ++p)
    {
      sum -= value[p] * Rows(x)[inner[p]];
    }
    Rows(x)[j] = sum;
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

Eigen::MatrixXd ProjectPanel(const PanelRange& basis, const Panel& y, int threads)
{
  const Index count = basis.Count;
  const Index chunks = ChunkCount(y.rows());
  using Small = Eigen::Matrix<double, Eigen::Dynamic, PanelWidth, Eigen::RowMajor>;
  // A partial sum for each group of chunks: few enough to add up, the same for any threads.
  const Index groups = std::min<Index>(chunks, 8);
  std::vector<Small> partial(static_cast<std::size_t>(groups), Small::Zero(8 * count, 8));
  ForEachTask(threads, groups,
    [&](Index group)
    {
      Small& sum = partial[static_cast<std::size_t>(group)];
      for (Index chunk = group * chunks / groups; chunk < (group + 1) * chunks / groups; ++chunk)
      {
        const Index begin = chunk * RowsPerChunk;
        const Index rows = std::min(RowsPerChunk, y.rows() - begin);
        for (Index k = 0; k < count; ++k)
        {
          PanelOuter(basis.First[k].data() + 8 * begin, y.data() + 8 * begin, rows,
            sum.data() + 64 * k);
        }
      }
    });
  for (Index group = 1; group < groups; ++group)
  {
    partial[0] += partial[static_cast<std::size_t>(group)];
  }
  return partial[0];
}

void SubtractPanels(const PanelRange& basis, const Eigen::MatrixXd& c, Panel& w, int threads)
{
  const Eigen::Matrix<double, Eigen::Dynamic, PanelWidth, Eigen::RowMajor> negative = -c;
  ForEachTask(threads, ChunkCount(w.rows()),
    [&](Index chunk)
    {
      const Index begin = chunk * RowsPerChunk;
      const std::vector<const double*> q = RowsFrom(basis, begin);
      PanelAccumulate(q.data(), basis.Count, negative.data(),
        std::min(RowsPerChunk, w.rows() - begin), w.data() + 8 * begin);
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
      const double* q = old.data();
      PanelAccumulate(&q, 1, inverse.data(), rows, w.data() + 8 * begin);
    });
}

void MultiplyPanel(const Eigen::SparseMatrix<double>& a, const Panel& x, Panel& y, int threads)
{
  y.resize(x.rows(), PanelWidth);
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
  const Index outputs = (c.cols() + PanelWidth - 1) / PanelWidth;
  using Small = Eigen::Matrix<double, Eigen::Dynamic, PanelWidth, Eigen::RowMajor>;
  std::vector<Small> coefficients;
  for (Index output = 0; output < outputs; ++output)
  {
    const Index columns = std::min(PanelWidth, c.cols() - output * PanelWidth);
    coefficients.emplace_back(Small::Zero(PanelWidth * basis.Count, PanelWidth));
    coefficients.back().topLeftCorner(c.rows(), columns) =
      c.middleCols(output * PanelWidth, columns);
  }
  Panels result(static_cast<std::size_t>(outputs), Panel::Zero(rows, PanelWidth));
  constexpr Index rowsPerTile = 256; // few enough that a tile of the whole basis stays in the cache
  ForEachTask(threads, (rows + rowsPerTile - 1) / rowsPerTile,
    [&](Index tile)
    {
      const Index begin = tile * rowsPerTile;
      const std::vector<const double*> q = RowsFrom(basis, begin);
      for (std::size_t output = 0; output < result.size(); ++output)
      {
        PanelAccumulate(q.data(), basis.Count, coefficients[output].data(),
          std::min(rowsPerTile, rows - begin), result[output].data() + PanelWidth * begin);
      }
    });
  return result;
}

Panels ToPanels(const Eigen::MatrixXd& columns, const Eigen::VectorXi& order)
{
  Panels panels;
  for (Index first = 0; first < columns.cols(); first += PanelWidth)
  {
    Panel panel = Panel::Zero(order.size(), PanelWidth);
    const Index count = std::min(PanelWidth, columns.cols() - first);
    for (Index row = 0; row < order.size(); ++row)
    {
      panel.row(row).head(count) = columns.row(order[row]).segment(first, count);
    }
    panels.push_back(std::move(panel));
  }
  return panels;
}

Eigen::VectorXd ColumnOf(const Panels& panels, Index column, const Eigen::VectorXi& order)
{
  const auto values =
    panels[static_cast<std::size_t>(column / PanelWidth)].col(column % PanelWidth);
  Eigen::VectorXd result(order.size());
  for (Index row = 0; row < order.size(); ++row)
  {
    result[order[row]] = values[row];
  }
  return result;
}

void SolveFactorized(const Eigen::SparseMatrix<double>& l, const Eigen::VectorXd& inverseD,
  Panel& x)
{
  SolveColumns(l.outerIndexPtr(), l.innerIndexPtr(), l.valuePtr(), inverseD.data(), x.rows(),
    x.data());
}

} // namespace spectralwatermark

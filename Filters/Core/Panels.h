// SPDX-License-Identifier: BSD-3-Clause
/// Dense algebra on panels: eight vectors side by side, one row of eight per vertex.
///
/// Everything that a block Krylov method does with its basis streams it from memory. Panels make
/// each row one or two registers wide, so that it is loaded once for all eight vectors, and suit
/// triangular solves with eight right-hand sides as they are.
#ifndef SpectralWatermark_Core_Panels_h
#define SpectralWatermark_Core_Panels_h

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <cstdint>
#include <vector>

namespace spectralwatermark
{

constexpr Eigen::Index PanelWidth = 8;

using Panel = Eigen::Matrix<double, Eigen::Dynamic, PanelWidth, Eigen::RowMajor>;
using Panels = std::vector<Panel>;

/// So many panels are worked on together where a basis goes by: more push each other out of the
/// cache.
constexpr std::size_t PanelsAtOnce = 8;

/// Some consecutive panels of a basis.
struct PanelRange
{
  PanelRange(const Panel* first, std::size_t count)
    : First(first)
    , Count(static_cast<Eigen::Index>(count))
  {
  }
  PanelRange(const Panels& panels)
    : PanelRange(panels.data(), panels.size())
  {
  }

  const Panel* First;
  Eigen::Index Count;
};

/// Rows of a panel are worked on in chunks of this many, whatever the number of threads, so that
/// sums come out the same to the last bit.
constexpr Eigen::Index RowsPerChunk = 2048;

/// A panel with nothing in it yet. Large ones ask the system for huge pages, which what streams them
/// from memory gains from.
Panel MakePanel(Eigen::Index rows);

/// Standard normal numbers, the same for any number of threads.
Panel RandomPanel(Eigen::Index rows, std::uint64_t seed, int threads);

/// Q^T Y: a row for each vector of `basis`, a column for each of `y`. The basis is streamed from
/// memory once for all of `y`, which should be PanelsAtOnce panels or fewer.
Eigen::MatrixXd ProjectPanels(const PanelRange& basis, const PanelRange& y, int threads);

/// Q^T A Y for a symmetric A; `product` is room for A Y, kept to be used again. A diagonal A costs next
/// to nothing.
Eigen::MatrixXd ProjectPanels(const PanelRange& basis, const Eigen::SparseMatrix<double>& a,
  const PanelRange& y, Panels& product, int threads);

/// W -= Q C, with C as ProjectPanels() gives it; W are as many panels as C has columns for.
void SubtractPanels(const PanelRange& basis, const Eigen::MatrixXd& c, Panel* w, int threads);

/// W <- W R^-1 for an upper triangular R of size eight.
void SolveTriangularRight(const Eigen::MatrixXd& r, Panel& w, int threads);

/// Y = A X for a sparse symmetric A (compressed, as everywhere here).
void MultiplyPanel(const Eigen::SparseMatrix<double>& a, const Panel& x, Panel& y, int threads);

/// The linear combinations Q C of the first vectors of the basis, as many as C has rows, as panels,
/// the last one filled up with zeros.
Panels CombinePanels(const PanelRange& basis, const Eigen::MatrixXd& c, int threads);

/// V^T A V for a symmetric A.
Eigen::MatrixXd GramOfPanels(const Eigen::SparseMatrix<double>& a, const Panels& v, int threads);

/// The columns with these numbers (counted through all panels), in this order, as panels, the last
/// one filled up with zeros.
Panels SelectColumns(const Panels& panels, const std::vector<Eigen::Index>& columns, int threads);

/// Columns as panels, the last one filled up with zeros: row i of a panel is row order[i].
Panels ToPanels(const Eigen::MatrixXd& columns, const Eigen::VectorXi& order);

/// The inverse of ToPanels(), for the columns with these ascending numbers. Panels are freed one by
/// one, so that the vectors are not in memory twice.
Eigen::MatrixXd TakeColumns(Panels panels, const std::vector<Eigen::Index>& columns,
  const Eigen::VectorXi& order, int threads);

} // namespace spectralwatermark

#endif

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

#include <vector>

namespace spectralwatermark
{

constexpr Eigen::Index PanelWidth = 8;

using Panel = Eigen::Matrix<double, Eigen::Dynamic, PanelWidth, Eigen::RowMajor>;
using Panels = std::vector<Panel>;

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

/// Q^T Y for all panels Q of `basis`: a row for each of their vectors, eight columns.
Eigen::MatrixXd ProjectPanel(const PanelRange& basis, const Panel& y, int threads);

/// W -= Q C, with C as ProjectPanel() gives it.
void SubtractPanels(const PanelRange& basis, const Eigen::MatrixXd& c, Panel& w, int threads);

/// W <- W R^-1 for an upper triangular R of size eight.
void SolveTriangularRight(const Eigen::MatrixXd& r, Panel& w, int threads);

/// Y = A X for a sparse symmetric A, or a row scaling when A is diagonal.
void MultiplyPanel(const Eigen::SparseMatrix<double>& a, const Panel& x, Panel& y, int threads);

/// The linear combinations Q C of the basis, as panels, the last one filled up with zeros.
Panels CombinePanels(const PanelRange& basis, const Eigen::MatrixXd& c, int threads);

/// Columns as panels, the last one filled up with zeros: row i of a panel is row order[i].
Panels ToPanels(const Eigen::MatrixXd& columns, const Eigen::VectorXi& order);

/// The inverse of ToPanels() for one column.
Eigen::VectorXd ColumnOf(const Panels& panels, Eigen::Index column, const Eigen::VectorXi& order);

/// Solves L D L^T X = B in place for a unit lower triangular L without its diagonal, by columns.
void SolveFactorized(const Eigen::SparseMatrix<double>& l, const Eigen::VectorXd& inverseD,
  Panel& x);

} // namespace spectralwatermark

#endif

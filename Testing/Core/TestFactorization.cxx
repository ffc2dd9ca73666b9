// SPDX-License-Identifier: BSD-3-Clause
// Panels and the factorisation they go through, against Eigen's dense algebra.
#include "Core/LaplaceOperator.h"
#include "Core/ShiftedFactorization.h"
#include "Support/Shapes.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

using namespace spectralwatermark;

namespace
{

constexpr Index Rows = 5000; // several chunks and a part of one

Panels RandomPanels(std::size_t count)
{
  Panels panels;
  for (std::size_t k = 0; k < count; ++k)
  {
    panels.emplace_back(Panel::Random(Rows, PanelWidth));
  }
  return panels;
}

Eigen::MatrixXd Dense(const Panels& panels)
{
  Eigen::MatrixXd dense(panels.front().rows(), PanelWidth * static_cast<Index>(panels.size()));
  for (std::size_t k = 0; k < panels.size(); ++k)
  {
    dense.middleCols(PanelWidth * static_cast<Index>(k), PanelWidth) = panels[k];
  }
  return dense;
}

} // namespace

TEST(Panels, ProjectSubtractAndCombineAreMatrixProducts)
{
  const Panels basis = RandomPanels(3);
  const Eigen::MatrixXd q = Dense(basis);
  const Panel y = Panel::Random(Rows, PanelWidth);
  const Eigen::MatrixXd c = ProjectPanel(basis, y, 2);
  EXPECT_LT((c - q.transpose() * y).cwiseAbs().maxCoeff(), 1e-10);

  Panel w = y;
  SubtractPanels(basis, c, w, 2);
  EXPECT_LT((w - (y - q * c)).cwiseAbs().maxCoeff(), 1e-9);

  const Eigen::MatrixXd coefficients = Eigen::MatrixXd::Random(24, 11); // no multiple of eight
  const Panels combined = CombinePanels(basis, coefficients, 2);
  ASSERT_EQ(combined.size(), 2u);
  EXPECT_LT((Dense(combined).leftCols(11) - q * coefficients).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_EQ(Dense(combined).rightCols(5).cwiseAbs().maxCoeff(), 0.0);
}

TEST(Panels, TriangularDivision)
{
  const Panel w = Panel::Random(Rows, PanelWidth);
  Eigen::MatrixXd r = Eigen::MatrixXd::Random(8, 8).triangularView<Eigen::Upper>();
  r.diagonal().array() += 3.0;
  Panel divided = w;
  SolveTriangularRight(r, divided, 2);
  EXPECT_LT((divided * r - w).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(Panels, ResultsDoNotDependOnTheThreads)
{
  const Panels basis = RandomPanels(4);
  const Panel y = Panel::Random(Rows, PanelWidth);
  EXPECT_EQ(ProjectPanel(basis, y, 1), ProjectPanel(basis, y, 3));
}

TEST(Panels, ColumnsComeBackFromPanels)
{
  const Eigen::MatrixXd columns = Eigen::MatrixXd::Random(50, 13);
  Eigen::VectorXi order = Eigen::VectorXi::LinSpaced(50, 49, 0);
  const Panels panels = ToPanels(columns, order);
  for (Index k = 0; k < 13; ++k)
  {
    EXPECT_EQ(ColumnOf(panels, k, order), columns.col(k));
  }
}

TEST(ShiftedFactorization, SolvesAndCountsEigenvalues)
{
  const TriangleMesh mesh = shapes::Bumpy(3);
  for (const MassMatrix kind : { MassMatrix::Lumped, MassMatrix::Consistent })
  {
    const LaplaceOperator op = AssembleLaplaceOperator(mesh, kind);
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> dense(
      Eigen::MatrixXd(op.Stiffness), Eigen::MatrixXd(op.Mass));
    ShiftedFactorization factorization(op.Stiffness, op.Mass);
    for (const Index k : { 0, 3, 20, 100, 400 })
    {
      const double shift = 0.5 * (dense.eigenvalues()[k] + dense.eigenvalues()[k + 1]);
      EXPECT_EQ(factorization.Factorize(shift), k + 1);
      EXPECT_LT(factorization.SolveError(), 1e-8);

      // In the original order of rows: (S - shift M) X = M B.
      const Eigen::MatrixXd right = Eigen::MatrixXd::Random(mesh.NumberOfVertices(), 8);
      Panels x = ToPanels(right, factorization.Order());
      factorization.SolveWithMass(x, true, 2);
      for (Index column = 0; column < 8; ++column)
      {
        const Eigen::VectorXd solution = ColumnOf(x, column, factorization.Order());
        const Eigen::VectorXd product = op.Mass * right.col(column);
        EXPECT_LT((op.Stiffness * solution - shift * (op.Mass * solution) - product).norm(),
          1e-10 * product.norm());
      }
    }
  }
}

// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Harmonics/LaplaceOperator.h"
#include "Core/LinearAlgebra/MultiVector.h"
#include "Core/LinearAlgebra/ShiftedFactorization.h"
#include "Support/Shapes.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <utility>
#include <vector>

using namespace spectralwatermark;

TEST(ShiftedFactorization, SolutionsDoNotDependOnTheThreads)
{
  const LaplaceOperator op = AssembleLaplaceOperator(shapes::Bumpy(4), MassMatrix::Lumped);
  ShiftedFactorization factorization(op.Stiffness, op.Mass);
  factorization.Factorize(30.0, 2);
  const BlockVector right = BlockVector::Random(op.Mass.rows(), BlockWidth);
  BlockVector alone = right;
  BlockVector together = right;
  factorization.Solve(alone, 1);
  factorization.Solve(together, 3);
  EXPECT_EQ(alone, together);
}

TEST(ShiftedFactorization, TakesAnOrderThatIsGiven)
{
  const LaplaceOperator op = AssembleLaplaceOperator(shapes::Bumpy(3), MassMatrix::Lumped);
  ShiftedFactorization chosen(op.Stiffness, op.Mass);
  ShiftedFactorization given(op.Stiffness, op.Mass, chosen.Order());
  EXPECT_EQ(given.Order(), chosen.Order());

  // One that is no postorder is made one.
  const Eigen::VectorXi reversed =
    Eigen::VectorXi::LinSpaced(op.Mass.rows(), static_cast<int>(op.Mass.rows()) - 1, 0);
  ShiftedFactorization other(op.Stiffness, op.Mass, reversed);
  EXPECT_NE(other.Order(), chosen.Order());
  EXPECT_EQ(other.Factorize(300.0, 2), chosen.Factorize(300.0, 2));
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
      EXPECT_EQ(factorization.Factorize(shift, 2), k + 1);
      EXPECT_LT(factorization.SolveError(1), 1e-8);

      // In the original order of rows: (S - shift M) X = M B.
      const Eigen::MatrixXd right = Eigen::MatrixXd::Random(mesh.NumberOfVertices(), 8);
      MultiVector x = ToMultiVector(right, factorization.Order());
      factorization.SolveWithMass(x, true, 2);
      const std::vector<Index> all = { 0, 1, 2, 3, 4, 5, 6, 7 };
      const Eigen::MatrixXd solution = TakeColumns(std::move(x), all, factorization.Order(), 1);
      const Eigen::MatrixXd product = op.Mass * right;
      EXPECT_LT((op.Stiffness * solution - shift * (op.Mass * solution) - product).norm(),
        1e-10 * product.norm());
    }
  }
}

// Several components are several trees: the substitution must not depend on there being one root.
TEST(ShiftedFactorization, SolvesOnSeveralComponents)
{
  const TriangleMesh one = shapes::Icosphere(2);
  const TriangleMesh mesh = shapes::Union({ one, one, one }, 4.0);
  const LaplaceOperator op = AssembleLaplaceOperator(mesh, MassMatrix::Lumped);
  ShiftedFactorization factorization(op.Stiffness, op.Mass);
  EXPECT_EQ(factorization.Factorize(1.0, 2), 3);
  EXPECT_LT(factorization.SolveError(2), 1e-12);
}

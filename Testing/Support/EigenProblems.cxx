// SPDX-License-Identifier: BSD-3-Clause
#include "Support/EigenProblems.h"

#include "Core/Eigensolver/DenseSolver.h"
#include "Core/Support/Errors.h"
#include "Support/Shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace eigenproblems
{

OwnedProblem FlatTorus(Index cells)
{
  const TriangleMesh square = shapes::Rectangle(cells, cells, 1.0, 1.0);
  const LaplaceOperator op = AssembleLaplaceOperator(square, MassMatrix::Lumped);
  SparseMatrix glue(square.NumberOfVertices(), cells * cells);
  for (Index j = 0; j <= cells; ++j)
  {
    for (Index i = 0; i <= cells; ++i)
    {
      glue.insert(j * (cells + 1) + i, (j % cells) * cells + i % cells) = 1.0;
    }
  }
  OwnedProblem torus;
  torus.Stiffness = glue.transpose() * op.Stiffness * glue;
  torus.Mass = glue.transpose() * op.Mass * glue;
  torus.Kernel = Eigen::MatrixXd::Ones(cells * cells, 1);
  torus.Rank = cells * cells;
  return torus;
}

std::vector<double> FlatTorusSpectrum(Index count)
{
  std::vector<double> values;
  for (int i = -30; i <= 30; ++i)
  {
    for (int j = -30; j <= 30; ++j)
    {
      values.push_back(4.0 * Pi * Pi * (i * i + j * j));
    }
  }
  std::sort(values.begin(), values.end());
  values.resize(static_cast<std::size_t>(count));
  return values;
}

OwnedProblem DiagonalProblem(const std::vector<double>& values)
{
  const auto count = static_cast<Index>(values.size());
  OwnedProblem problem;
  problem.Stiffness.resize(count, count);
  problem.Mass.resize(count, count);
  for (Index k = 0; k < count; ++k)
  {
    problem.Stiffness.insert(k, k) = values[k] / static_cast<double>(count);
    problem.Mass.insert(k, k) = 1.0 / static_cast<double>(count);
  }
  problem.Stiffness.makeCompressed();
  problem.Mass.makeCompressed();
  problem.Kernel.resize(count, 0);
  problem.Rank = count;
  return problem;
}

EigenPairs SolveDense(const OwnedProblem& problem, Index count)
{
  EigensolverOptions options;
  options.Count = count;
  return DenseSolver().Solve(problem.View(), options, Progress());
}

double OrthonormalityError(const OwnedProblem& problem, const EigenPairs& pairs)
{
  const Eigen::MatrixXd gram = pairs.Vectors.transpose() * (problem.Mass * pairs.Vectors);
  return (gram - Eigen::MatrixXd::Identity(gram.rows(), gram.cols())).cwiseAbs().maxCoeff();
}

std::string FailureOf(const Eigensolver& solver, const OwnedProblem& problem)
{
  EigensolverOptions options;
  options.Count = 20;
  try
  {
    solver.Solve(problem.View(), options, Progress());
  }
  catch (const SolverFailure& failure)
  {
    return failure.what();
  }
  return "none";
}

void ExpectSameSpectrum(const Eigen::VectorXd& a, const Eigen::VectorXd& b)
{
  ASSERT_EQ(a.size(), b.size());
  for (Index k = 0; k < a.size(); ++k)
  {
    EXPECT_NEAR(a[k], b[k], 1e-9 * (1.0 + b[k])) << "eigenvalue " << k + 1;
  }
}

} // namespace eigenproblems

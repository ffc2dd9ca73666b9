// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Eigensolver/DenseSolver.h"

#include "Core/Eigensolver/Residuals.h"

#include <Eigen/Eigenvalues>

namespace spectralwatermark
{

// Solves M h = mu (S + M) h, with mu = 1 / (lambda + 1), instead of S h = lambda M h: S + M is
// positive definite even where M is only semi-definite (vertices without mass have mu = 0).
EigenPairs DenseSolver::Solve(const EigenProblem& problem, const EigensolverOptions& options,
  const Progress& progress) const
{
  progress.Report(0.0);
  const Eigen::MatrixXd mass(problem.Mass);
  const Eigen::MatrixXd shifted = Eigen::MatrixXd(problem.Stiffness) + mass;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(mass, shifted);
  if (solver.info() != Eigen::Success)
  {
    throw SolverFailure("the dense eigensolver did not converge");
  }
  progress.Report(0.9);

  const Index count = std::min(options.Count, problem.Rank);
  EigenPairs pairs;
  pairs.Vectors.resize(mass.rows(), count);
  for (Index k = 0; k < count; ++k)
  {
    const Index column = mass.rows() - 1 - k; // Eigen sorts mu ascending
    const Eigen::VectorXd vector = solver.eigenvectors().col(column);
    pairs.Vectors.col(k) = vector / std::sqrt(vector.dot(mass * vector));
  }
  const Index kernel = std::min(count, problem.Kernel.cols());
  pairs.Vectors.leftCols(kernel) = problem.Kernel.leftCols(kernel);
  Orthonormalize(problem.Mass, pairs.Vectors);

  pairs.Values = Eigen::VectorXd::Zero(count);
  for (Index k = kernel; k < count; ++k)
  {
    pairs.Values[k] = pairs.Vectors.col(k).dot(problem.Stiffness * pairs.Vectors.col(k));
  }
  pairs.Residuals =
    RelativeResiduals(problem.Stiffness, problem.Mass, 1.0, pairs.Values, pairs.Vectors);
  pairs.Bands = 1;
  pairs.Complete = count == options.Count;
  progress.Report(1.0);
  return pairs;
}

} // namespace spectralwatermark

// SPDX-License-Identifier: BSD-3-Clause
/// Eigenproblems with known spectra, and what must hold of their solutions.
#ifndef SpectralWatermark_Testing_EigenProblems_h
#define SpectralWatermark_Testing_EigenProblems_h

#include "Core/Eigensolver/Eigensolver.h"
#include "Core/Harmonics/LaplaceOperator.h"

#include <string>
#include <vector>

namespace eigenproblems
{

using namespace spectralwatermark;

/// The problem of a mesh, scaled to unit area as the interface asks.
struct OwnedProblem
{
  explicit OwnedProblem(const TriangleMesh& mesh, MassMatrix kind = MassMatrix::Lumped)
  {
    LaplaceOperator op = AssembleLaplaceOperator(mesh, kind);
    this->Stiffness = op.Stiffness;
    this->Mass = op.Mass / op.Area;
    this->Kernel = op.Kernel * std::sqrt(op.Area);
    this->Rank = op.Rank;
  }
  OwnedProblem() = default;

  EigenProblem View() const { return { this->Stiffness, this->Mass, this->Kernel, this->Rank }; }

  SparseMatrix Stiffness;
  SparseMatrix Mass;
  Eigen::MatrixXd Kernel;
  Index Rank = 0;
};

/// The unit square with opposite sides glued: a flat torus of area 1. No such surface lies in
/// space, but its matrices come from the square's by adding what is glued.
OwnedProblem FlatTorus(Index cells);

/// The smallest `count` of 4 pi^2 (i^2 + j^2) over all integers, ascending.
std::vector<double> FlatTorusSpectrum(Index count);

/// Diagonal matrices with these eigenvalues.
OwnedProblem DiagonalProblem(const std::vector<double>& values);

template <typename Solver>
EigenPairs SolveBanded(const OwnedProblem& problem, Index count, Index bandSize, int threads = 1)
{
  EigensolverOptions options;
  options.Count = count;
  options.BandSize = bandSize;
  options.Threads = threads;
  return Solver().Solve(problem.View(), options, Progress());
}

EigenPairs SolveDense(const OwnedProblem& problem, Index count);

double OrthonormalityError(const OwnedProblem& problem, const EigenPairs& pairs);

/// The text of the SolverFailure that 20 eigenpairs end in; "none" when they do not.
std::string FailureOf(const Eigensolver& solver, const OwnedProblem& problem);

void ExpectSameSpectrum(const Eigen::VectorXd& a, const Eigen::VectorXd& b);

} // namespace eigenproblems

#endif

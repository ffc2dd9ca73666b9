// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Eigensolver/SpectraSolver.h"

#include "Core/Eigensolver/SpectrumSlicing.h"
#include "Core/LinearAlgebra/MultiVector.h"

#include <Eigen/SparseCholesky>
#include <Spectra/SymGEigsShiftSolver.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace spectralwatermark
{

namespace
{

using Factorization = Eigen::SimplicialLDLT<SparseMatrix>;

// Number of restarts after which a Lanczos run ends.
constexpr int MaximumRestarts = 300;

// Ratio of the residual of the original problem to that of the shift-inverted one, which damps high
// frequencies. Spectra's stopping criterion applies to the latter.
constexpr double ResidualAmplification = 100.0;

// Reports the progress of one Lanczos run, measured by the number of solves that it usually takes.
class SolveCounter
{
public:
  SolveCounter(const Progress& progress, Index expected)
    : Listener(progress)
    , Expected(static_cast<double>(expected))
  {
  }

  void Count()
  {
    ++this->Done;
    const double ratio = static_cast<double>(this->Done) / this->Expected;
    // Linear up to 80 %, then ever slower, because the number of restarts is unknown.
    this->Listener.Report(ratio < 0.8 ? ratio : 1.0 - 0.2 * std::exp(-(ratio - 0.8) / 0.2));
  }

private:
  const Progress& Listener;
  double Expected;
  Index Done = 0;
};

// y = P (S - sigma M)^-1 x, with P the M-orthogonal projection off the locked vectors.
class ShiftInvertOperator
{
public:
  using Scalar = double;

  ShiftInvertOperator(const Factorization& factorization, const SparseMatrix& mass,
    const Eigen::MatrixXd& locked, SolveCounter& counter)
    : Solver(factorization)
    , Locked(locked)
    , MassLocked(mass * locked)
    , Counter(counter)
  {
  }

  Index rows() const { return this->Solver.rows(); }
  Index cols() const { return this->Solver.cols(); }

  // Does nothing: the caller factorises, because it also needs the inertia.
  void set_shift(double) {}

  void perform_op(const double* in, double* out) const
  {
    this->Counter.Count();
    Eigen::Map<Eigen::VectorXd> y(out, this->rows());
    y = this->Solver.solve(Eigen::Map<const Eigen::VectorXd>(in, this->cols()));
    if (this->Locked.cols() > 0)
    {
      y -= this->Locked * (this->MassLocked.transpose() * y).eval();
    }
  }

private:
  const Factorization& Solver;
  const Eigen::MatrixXd& Locked;
  Eigen::MatrixXd MassLocked;
  SolveCounter& Counter;
};

// y = M x.
class MassOperator
{
public:
  using Scalar = double;

  explicit MassOperator(const SparseMatrix& mass)
    : Mass(mass)
  {
  }
  Index rows() const { return this->Mass.rows(); }
  Index cols() const { return this->Mass.cols(); }
  void perform_op(const double* in, double* out) const
  {
    Eigen::Map<Eigen::VectorXd>(out, this->rows()).noalias() =
      this->Mass * Eigen::Map<const Eigen::VectorXd>(in, this->cols());
  }

private:
  const SparseMatrix& Mass;
};

class SpectraShiftInvert : public ShiftInvertSolver
{
public:
  explicit SpectraShiftInvert(const EigenProblem& problem)
    : Problem(problem)
    , SameOrder(Eigen::VectorXi::LinSpaced(problem.Mass.rows(), 0,
        static_cast<int>(problem.Mass.rows()) - 1))
  {
    this->Factors.analyzePattern(problem.Stiffness + problem.Mass);
  }

  Index DefaultBandSize(Index wanted) const override { return wanted <= 110 ? 110 : 60; }
  bool FirstShiftInside() const override { return false; }

  Index Factorize(double shift, const Progress& progress) override
  {
    progress.Report(0.0);
    this->Shift = shift;
    this->Factors.factorize(this->Problem.Stiffness - shift * this->Problem.Mass);
    if (this->Factors.info() != Eigen::Success)
    {
      throw SolverFailure("the factorisation of the shifted Laplacian broke down");
    }
    return (this->Factors.vectorD().array() < 0.0).count();
  }

  Band FindNearest(BandRequest request, const Progress& progress) override;

  const SparseMatrix& Stiffness() const override { return this->Problem.Stiffness; }
  const SparseMatrix& Mass() const override { return this->Problem.Mass; }
  const Eigen::VectorXi& Order() const override { return this->SameOrder; }

private:
  Eigen::MatrixXd AllColumns(MultiVector blocks) const
  {
    std::vector<Index> columns(BlockWidth * blocks.size());
    std::iota(columns.begin(), columns.end(), Index{ 0 });
    return TakeColumns(std::move(blocks), columns, this->SameOrder, 1);
  }

  const EigenProblem& Problem;
  Eigen::VectorXi SameOrder;
  Factorization Factors;
  double Shift = 0.0;
};

Band SpectraShiftInvert::FindNearest(BandRequest request, const Progress& progress)
{
  const Index n = this->Problem.Stiffness.rows();
  // Spectra searches both sides of the shift alike.
  const bool oneSide = request.AnySide || request.Below == 0;
  const Index above = request.Above + request.Window;
  const Index count =
    std::min(oneSide ? request.Below + above : 2 * std::max(request.Below, above), n - 2);
  const Index subspace = std::min(n, std::max<Index>(2 * count + 1, 24));
  SolveCounter counter(progress, subspace + count / 2);
  const Eigen::MatrixXd locked = this->AllColumns(std::move(request.Locked));
  ShiftInvertOperator op(this->Factors, this->Problem.Mass, locked, counter);
  MassOperator mass(this->Problem.Mass);
  Spectra::SymGEigsShiftSolver<ShiftInvertOperator, MassOperator, Spectra::GEigsMode::ShiftInvert>
    solver(op, mass, count, subspace, this->Shift);
  try
  {
    solver.init();
    solver.compute(Spectra::SortRule::LargestMagn, MaximumRestarts,
      std::max(request.Tolerance / ResidualAmplification,
        4.0 * std::numeric_limits<double>::epsilon()));
  }
  catch (const std::runtime_error& error)
  {
    throw SolverFailure(std::string("the eigensolver gave up (") + error.what() + ")",
      "remove the mesh's thinnest triangles, or ask for fewer harmonics");
  }

  Band band;
  const Eigen::VectorXd values = solver.eigenvalues();
  std::vector<Index> finite;
  for (Index k = 0; k < values.size(); ++k)
  {
    if (std::isfinite(values[k]))
    {
      finite.push_back(k);
      band.Values.push_back(values[k]);
    }
  }
  const Eigen::MatrixXd vectors = solver.eigenvectors();
  band.Vectors = ToMultiVector(vectors(Eigen::all, finite), this->SameOrder);
  return band;
}

} // namespace

EigenPairs SpectraSolver::Solve(const EigenProblem& problem, const EigensolverOptions& options,
  const Progress& progress) const
{
  SpectraShiftInvert solver(problem);
  return SolveBySlicing(problem, options, solver, progress);
}

} // namespace spectralwatermark

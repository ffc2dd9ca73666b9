// SPDX-License-Identifier: BSD-3-Clause
#include "SpectraEigensolver.h"

#include "LaplaceOperator.h"

#include <Eigen/SparseCholesky>
#include <Spectra/SymGEigsShiftSolver.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace spectralwatermark
{

namespace
{

using Factorization = Eigen::SimplicialLDLT<SparseMatrix>;

// Found again beyond what a band must hold, so that a gap to cut at is among them: as many as
// the largest multiplicity that symmetric models commonly show, and some.
constexpr Index CutWindow = 12;

// Two neighbouring eigenvalues are far enough apart to cut between them, relative to their size:
// well over the rounding of a factorisation at the cut.
constexpr double MinimalGap = 1e-7;

constexpr int MaximumRepairs = 12;
constexpr int MaximumRestarts = 300;

// The Lanczos stopping criterion is on the shift-inverted problem, where high frequencies are
// damped; in the original one the residual is larger by about this factor.
constexpr double ResidualAmplification = 100.0;

struct Band
{
  std::vector<double> Values;
  std::vector<Eigen::VectorXd> Vectors;
};

// Progress of one Lanczos run by the solves it is expected to take.
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
    // Linear to 80 %, then ever slower: the number of restarts cannot be known.
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
  void set_shift(double) {} // factorised by the caller, who reads the inertia too

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

// The bands of one problem, from the smallest eigenvalue up.
class BandSolver
{
public:
  BandSolver(const EigenProblem& problem, const EigensolverOptions& options)
    : Problem(problem)
    , Wanted(std::min(options.Count, problem.Rank))
    , BandSize(options.BandSize > 0 ? options.BandSize : DefaultBandSize(this->Wanted))
    , LanczosTolerance(std::max(options.Tolerance / ResidualAmplification,
        4.0 * std::numeric_limits<double>::epsilon()))
  {
    this->Factors.analyzePattern(problem.Stiffness + problem.Mass);
    for (Index k = 0; k < problem.Kernel.cols(); ++k)
    {
      this->Values.push_back(0.0);
      this->Vectors.push_back(problem.Kernel.col(k));
    }
  }

  bool Finished() const { return this->Found() >= this->Wanted; }
  Index Found() const { return static_cast<Index>(this->Values.size()); }
  double FractionDone() const
  {
    return static_cast<double>(std::min(this->Found(), this->Wanted)) /
      static_cast<double>(this->Wanted);
  }
  Index Target() const { return std::min(this->Wanted - this->Found(), this->BandSize); }
  double FractionAfterBand() const
  {
    return std::min(1.0,
      static_cast<double>(this->Found() + this->Target()) / static_cast<double>(this->Wanted));
  }

  /// Appends the next band. False when its count could not be made right.
  bool SolveBand(const Progress& progress);

  EigenPairs Result() const;

  Index Bands = 0;

private:
  static Index DefaultBandSize(Index wanted) { return wanted <= 110 ? 110 : 60; }

  // Factorises S - shift M; the negative pivots count the eigenvalues under the shift.
  Index Factorize(double shift)
  {
    this->Factors.factorize(this->Problem.Stiffness - shift * this->Problem.Mass);
    if (this->Factors.info() != Eigen::Success)
    {
      throw SolverFailure("the factorisation of the shifted Laplacian broke down");
    }
    return (this->Factors.vectorD().array() < 0.0).count();
  }

  double ChooseShift();
  Band Lanczos(Index count, const Eigen::MatrixXd& locked, const Progress& progress);
  void AddInInterval(const Band& found, Band& band) const;
  bool Cut(Band& band, Index target);

  const EigenProblem& Problem;
  Index Wanted;
  Index BandSize;
  double LanczosTolerance;
  Factorization Factors;
  std::vector<double> Values; // what is known to be complete, up to LowerCut
  std::vector<Eigen::VectorXd> Vectors;
  double LowerCut = -std::numeric_limits<double>::infinity();
  double Shift = 0.0;
  Index BelowShift = 0; // eigenvalues under Shift, by inertia
};

Eigen::MatrixXd Columns(const std::vector<Eigen::VectorXd>& vectors, Index rows)
{
  Eigen::MatrixXd matrix(rows, static_cast<Index>(vectors.size()));
  for (std::size_t k = 0; k < vectors.size(); ++k)
  {
    matrix.col(static_cast<Index>(k)) = vectors[k];
  }
  return matrix;
}

// The first shift is under the spectrum, by a twelfth of what Weyl's law gives for the first
// eigenvalue of a sphere: S + M is then well conditioned and the factorisation a Cholesky. Later
// ones sit half a band above the last cut, as far as the local density of eigenvalues tells.
double BandSolver::ChooseShift()
{
  const Index known = this->Found();
  if (known <= this->Problem.Kernel.cols())
  {
    this->BelowShift = this->Factorize(-1.0);
    return -1.0;
  }
  const std::size_t last = this->Values.size() - 1;
  const std::size_t middle = (static_cast<std::size_t>(this->Problem.Kernel.cols()) + last) / 2;
  const double spacing = last > middle
    ? (this->Values[last] - this->Values[middle]) / static_cast<double>(last - middle)
    : this->Values[last] / static_cast<double>(last + 1);
  double reach = 0.5 * static_cast<double>(this->Target()) * spacing;
  double shift = this->LowerCut + reach;
  // A shift that is too far costs a Krylov space full of what is known or not wanted yet.
  for (int attempt = 0; attempt < 8; ++attempt)
  {
    this->BelowShift = this->Factorize(shift);
    const Index between = this->BelowShift - known;
    if (between <= (2 * this->Target()) / 3 + 2)
    {
      break;
    }
    reach *= 0.5 * static_cast<double>(this->Target()) / static_cast<double>(between);
    shift = this->LowerCut + reach;
  }
  return shift;
}

// The `count` eigenpairs nearest to the shift that are not locked.
Band BandSolver::Lanczos(Index count, const Eigen::MatrixXd& locked, const Progress& progress)
{
  const Index n = this->Problem.Stiffness.rows();
  count = std::min(count, n - 2);
  const Index subspace = std::min(n, std::max<Index>(2 * count + 1, 24));
  SolveCounter counter(progress, subspace + count / 2);
  ShiftInvertOperator op(this->Factors, this->Problem.Mass, locked, counter);
  MassOperator mass(this->Problem.Mass);
  Spectra::SymGEigsShiftSolver<ShiftInvertOperator, MassOperator, Spectra::GEigsMode::ShiftInvert>
    solver(op, mass, count, subspace, this->Shift);
  solver.init();
  solver.compute(Spectra::SortRule::LargestMagn, MaximumRestarts, this->LanczosTolerance);

  Band band;
  const Eigen::VectorXd values = solver.eigenvalues();
  const Eigen::MatrixXd vectors = solver.eigenvectors();
  for (Index k = 0; k < values.size(); ++k)
  {
    if (std::isfinite(values[k]))
    {
      band.Values.push_back(values[k]);
      band.Vectors.emplace_back(vectors.col(k));
    }
  }
  return band;
}

// Keeps what lies above the lower cut: what is below is known already.
void BandSolver::AddInInterval(const Band& found, Band& band) const
{
  std::vector<std::size_t> order(found.Values.size() + band.Values.size());
  Band all = band;
  all.Values.insert(all.Values.end(), found.Values.begin(), found.Values.end());
  all.Vectors.insert(all.Vectors.end(), found.Vectors.begin(), found.Vectors.end());
  std::iota(order.begin(), order.end(), std::size_t{ 0 });
  std::stable_sort(order.begin(), order.end(),
    [&all](std::size_t a, std::size_t b) { return all.Values[a] < all.Values[b]; });
  band = Band();
  for (const std::size_t k : order)
  {
    if (all.Values[k] > this->LowerCut)
    {
      band.Values.push_back(all.Values[k]);
      band.Vectors.push_back(std::move(all.Vectors[k]));
    }
  }
}

// Cuts the band in its widest gap at or after `target` pairs and counts. True when the band
// then holds every eigenvalue between the two cuts.
bool BandSolver::Cut(Band& band, Index target)
{
  const Index size = static_cast<Index>(band.Values.size());
  if (size < target)
  {
    return false;
  }
  if (this->Found() + size >= this->Problem.Rank)
  {
    // Everything there is: nothing above to cut from.
    return this->Found() + size == this->Problem.Rank;
  }
  Index cut = -1;
  double widest = 0.0;
  for (Index k = std::max<Index>(target, 1); k < size; ++k)
  {
    const double gap =
      band.Values[static_cast<std::size_t>(k)] - band.Values[static_cast<std::size_t>(k - 1)];
    if (gap > widest)
    {
      widest = gap;
      cut = k;
    }
  }
  if (cut < 0 || widest < MinimalGap * band.Values[static_cast<std::size_t>(cut)])
  {
    return false;
  }
  const double upperCut = 0.5 *
    (band.Values[static_cast<std::size_t>(cut)] + band.Values[static_cast<std::size_t>(cut - 1)]);
  const Index below = this->Factorize(upperCut);
  if (below != this->Found() + cut)
  {
    this->Factorize(this->Shift);
    return false;
  }
  band.Values.resize(static_cast<std::size_t>(cut));
  band.Vectors.resize(static_cast<std::size_t>(cut));
  this->LowerCut = upperCut;
  return true;
}

bool BandSolver::SolveBand(const Progress& progress)
{
  ++this->Bands;
  const Index n = this->Problem.Stiffness.rows();
  const Index target = this->Target();
  this->Shift = this->ChooseShift();
  progress.Report(0.05);

  const bool first = this->Found() <= this->Problem.Kernel.cols();
  const Index below = first ? 0 : this->BelowShift - this->Found();
  // Above the cut as far from the shift as below it, so twice what is below, or the target.
  Index count = std::max(target, 2 * below) + CutWindow;
  Band band;
  for (int repair = 0; repair < MaximumRepairs; ++repair)
  {
    std::vector<Eigen::VectorXd> known(band.Vectors);
    known.insert(known.end(), this->Vectors.begin(),
      this->Vectors.begin() + (first || repair > 0 ? this->Found() : 0));
    const double begin = repair == 0 ? 0.05 : 1.0 - 0.1 / repair;
    const double end = 1.0 - 0.1 / (repair + 1);
    this->AddInInterval(this->Lanczos(count, Columns(known, n), progress.Part(begin, end)), band);
    if (this->Cut(band, target))
    {
      this->Values.insert(this->Values.end(), band.Values.begin(), band.Values.end());
      this->Vectors.insert(this->Vectors.end(), band.Vectors.begin(), band.Vectors.end());
      return true;
    }
    // Few are missing as a rule; a large cluster (many equal components) needs longer strides.
    count = CutWindow << std::min(repair, 4);
  }
  return false;
}

EigenPairs BandSolver::Result() const
{
  const Index count = std::min(this->Wanted, this->Found());
  EigenPairs pairs;
  pairs.Bands = this->Bands;
  pairs.Values = Eigen::Map<const Eigen::VectorXd>(this->Values.data(), count);
  pairs.Vectors.resize(this->Problem.Stiffness.rows(), count);
  for (Index k = 0; k < count; ++k)
  {
    pairs.Vectors.col(k) = this->Vectors[static_cast<std::size_t>(k)];
  }
  Orthonormalize(this->Problem.Mass, pairs.Vectors);
  pairs.Residuals = RelativeResiduals(this->Problem.Stiffness, this->Problem.Mass, 1.0,
    pairs.Values, pairs.Vectors);
  return pairs;
}

} // namespace

EigenPairs SpectraEigensolver::Solve(const EigenProblem& problem, const EigensolverOptions& options,
  const Progress& progress) const
{
  BandSolver bands(problem, options);
  bool complete = true;
  while (complete && !bands.Finished())
  {
    complete =
      bands.SolveBand(progress.Part(0.95 * bands.FractionDone(), 0.95 * bands.FractionAfterBand()));
  }
  EigenPairs pairs = bands.Result();
  pairs.Complete = complete && pairs.Values.size() == options.Count;
  progress.Report(1.0);
  return pairs;
}

} // namespace spectralwatermark

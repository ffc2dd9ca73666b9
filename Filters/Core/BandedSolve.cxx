// SPDX-License-Identifier: BSD-3-Clause
#include "BandedSolve.h"

#include "LaplaceOperator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace spectralwatermark
{

namespace
{

// Found beyond what a band must hold, so that a gap to cut at is among them: as many as the
// largest multiplicity that symmetric models commonly show, and some.
constexpr Index CutWindow = 12;

// Two neighbouring eigenvalues are far enough apart to cut between them, relative to their size:
// well over the rounding of a factorisation at the cut.
constexpr double MinimalGap = 1e-7;

constexpr int MaximumRepairs = 12;

// How far the shift moves before another search, in local distances of eigenvalues.
constexpr double ShiftStep = 0.37;

// By Weyl's law, on a closed surface of area 1.
constexpr double WeylSpacing = 4.0 * 3.14159265358979323846;

// The bands of one problem, from the smallest eigenvalue up.
class BandSequence
{
public:
  BandSequence(const EigenProblem& problem, const EigensolverOptions& options,
    ShiftInvertSolver& solver)
    : Problem(problem)
    , Solver(solver)
    , Wanted(std::min(options.Count, problem.Rank))
    , BandSize(options.BandSize > 0 ? options.BandSize : solver.DefaultBandSize(this->Wanted))
    , Tolerance(options.Tolerance)
  {
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
  bool IsFirst() const { return this->Found() <= this->Problem.Kernel.cols(); }
  double LocalSpacing() const;
  void ChooseShift();
  void AddInInterval(const Band& found, Band& band) const;
  bool Cut(Band& band, Index target);

  const EigenProblem& Problem;
  ShiftInvertSolver& Solver;
  Index Wanted;
  Index BandSize;
  double Tolerance;
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

// Mean distance of neighbouring eigenvalues, as far as what is known tells.
double BandSequence::LocalSpacing() const
{
  if (this->IsFirst())
  {
    return WeylSpacing;
  }
  const std::size_t last = this->Values.size() - 1;
  const std::size_t middle = (static_cast<std::size_t>(this->Problem.Kernel.cols()) + last) / 2;
  return last > middle
    ? (this->Values[last] - this->Values[middle]) / static_cast<double>(last - middle)
    : this->Values[last] / static_cast<double>(last + 1);
}

// Half a band above the last cut. A shift that is too far costs a Krylov space full of what is
// known or not wanted yet; one that is too near makes it grow on one side only. The very first may
// have to lie under the spectrum, by a twelfth of what Weyl's law gives for the first eigenvalue
// of a sphere: S + M is then well conditioned and the factorisation a Cholesky.
void BandSequence::ChooseShift()
{
  if (this->IsFirst() && !this->Solver.FirstShiftInside())
  {
    this->Shift = -1.0;
    this->BelowShift = this->Solver.Factorize(this->Shift);
    return;
  }
  const double base = this->IsFirst() ? 0.0 : this->LowerCut;
  const double half = 0.5 * static_cast<double>(this->Target());
  double reach = half * this->LocalSpacing();
  for (int attempt = 0; attempt < 8; ++attempt)
  {
    this->Shift = base + reach;
    this->BelowShift = this->Solver.Factorize(this->Shift);
    const double between = static_cast<double>(this->BelowShift - this->Found());
    const bool inMiddle =
      between <= 4.0 / 3.0 * half + 2.0 && (between >= half / 3.0 - 2.0 || attempt >= 4);
    if (inMiddle && this->Solver.IsAccurate())
    {
      break;
    }
    reach *= inMiddle ? 1.0 + ShiftStep / half : std::min(4.0, half / std::max(1.0, between));
  }
}

// Keeps what lies above the lower cut: what is below is known already.
void BandSequence::AddInInterval(const Band& found, Band& band) const
{
  std::vector<std::size_t> order(found.Values.size() + band.Values.size());
  Band all = std::move(band);
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
bool BandSequence::Cut(Band& band, Index target)
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
  const Index below = this->Solver.Factorize(upperCut);
  if (below != this->Found() + cut)
  {
    return false;
  }
  band.Values.resize(static_cast<std::size_t>(cut));
  band.Vectors.resize(static_cast<std::size_t>(cut));
  this->LowerCut = upperCut;
  return true;
}

bool BandSequence::SolveBand(const Progress& progress)
{
  ++this->Bands;
  const Index n = this->Problem.Stiffness.rows();
  const Index target = this->Target();
  const bool first = this->IsFirst();
  this->ChooseShift();
  progress.Report(0.05);

  const Index below = std::max<Index>(0, this->BelowShift - this->Found());
  const Index above = std::max<Index>(1, target - below) + CutWindow;
  Band band;
  for (int repair = 0; repair < MaximumRepairs; ++repair)
  {
    if (repair > 0)
    {
      // What is missing may be so because the shift nearly hit an eigenvalue.
      this->Shift += ShiftStep * this->LocalSpacing();
      this->Solver.Factorize(this->Shift);
    }
    std::vector<Eigen::VectorXd> known(band.Vectors);
    known.insert(known.end(), this->Vectors.begin(),
      this->Vectors.begin() + (first || repair > 0 ? this->Found() : 0));
    const Eigen::MatrixXd locked = Columns(known, n);
    const double begin = repair == 0 ? 0.05 : 1.0 - 0.1 / repair;
    const double end = 1.0 - 0.1 / (repair + 1);
    // Few are missing as a rule; a large cluster (many equal components) needs longer strides.
    const Index missing = CutWindow << std::min(std::max(0, repair - 1), 4);
    const BandRequest request{ repair == 0 ? below : 0, repair == 0 ? above : missing, repair > 0,
      locked, this->Tolerance, repair };
    this->AddInInterval(this->Solver.FindNearest(request, progress.Part(begin, end)), band);
    if (this->Cut(band, target))
    {
      this->Values.insert(this->Values.end(), band.Values.begin(), band.Values.end());
      this->Vectors.insert(this->Vectors.end(), std::make_move_iterator(band.Vectors.begin()),
        std::make_move_iterator(band.Vectors.end()));
      return true;
    }
  }
  return false;
}

EigenPairs BandSequence::Result() const
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

EigenPairs SolveByBands(const EigenProblem& problem, const EigensolverOptions& options,
  ShiftInvertSolver& solver, const Progress& progress)
{
  BandSequence bands(problem, options, solver);
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

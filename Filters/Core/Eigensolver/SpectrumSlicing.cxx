// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Eigensolver/SpectrumSlicing.h"

#include "Core/Eigensolver/Residuals.h"
#include "Core/Support/Random.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>

namespace spectralwatermark
{

namespace
{

// Number of eigenpairs that are requested beyond those of a band, so that there is a gap to cut at
// among them. It is a little more than the largest multiplicity that symmetric models usually have.
constexpr Index CutWindow = 12;

// Smallest relative gap between two eigenvalues at which a band may be cut: well above the rounding
// of a factorisation there.
constexpr double MinimalGap = 1e-7;

// Number of searches for a band after which it is given up.
constexpr int MaximumSearches = 12;

// Share of the largest eigenvalue by which another may lie below 0 because of rounding.
constexpr double FarBelow = 1e-3;

// Distance that the shift moves before another search, in local spacings of eigenvalues.
constexpr double ShiftStep = 0.37;

// Mean spacing of eigenvalues on a closed surface of area 1, by Weyl's law.
constexpr double WeylSpacing = 4.0 * Pi;

// The bands of one problem, computed one after the other from the smallest eigenvalue up.
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
    , InitialGuess(options.InitialGuess)
    , Threads(options.Threads)
  {
    const std::vector<double> zeros(problem.Kernel.cols(), 0.0);
    this->Append({ zeros, ToMultiVector(problem.Kernel, solver.Order()), true }, Progress());
  }

  bool Finished() const { return this->Found() >= this->Wanted; }
  Index Found() const { return static_cast<Index>(this->Values.size()); }
  double FractionDone() const
  {
    return static_cast<double>(std::min(this->Found(), this->Wanted)) /
      static_cast<double>(this->Wanted);
  }

  // The number of pairs that the next band must have.
  Index Target() const { return std::min(this->Wanted - this->Found(), this->BandSize); }
  double FractionAfterBand() const
  {
    return std::min(1.0,
      static_cast<double>(this->Found() + this->Target()) / static_cast<double>(this->Wanted));
  }

  // Appends the next band. Returns false when pairs of it are still missing after all searches.
  bool SolveBand(const Progress& progress);

  // Moves all pairs out of the sequence.
  EigenPairs TakeResult();

private:
  bool IsFirst() const { return this->Found() <= this->Problem.Kernel.cols(); }
  double LocalSpacing() const;
  double FirstReach() const;
  void ChooseShift(const Progress& progress);
  BlockVector Start() const;
  MultiVector Locked(const Band& band) const;
  void AddInInterval(Band found, Band& band) const;
  bool Cut(Band& band, Index target, const Progress& progress);
  bool IsImpossible(const Band& band) const;
  void Append(Band band, const Progress& progress);
  void ProjectOutKnown(MultiVector& vectors, const Progress& progress) const;

  const EigenProblem& Problem;
  ShiftInvertSolver& Solver;
  Index Wanted;
  Index BandSize;
  double Tolerance;
  const WarmStart* InitialGuess;
  int Threads;
  Index Bands = 0;
  std::vector<double> Values; // all eigenvalues up to LowerCut
  MultiVector Vectors;        // each band begins with a block of its own
  std::vector<Index> Column;  // the column of each value in Vectors
  std::size_t LastBand = 0;   // the first block of the last band
  double LowerCut = -std::numeric_limits<double>::infinity();
  double Shift = 0.0;
  Index BelowShift = 0; // number of eigenvalues below Shift, by inertia
};

// Orthonormalises nearly orthonormal vectors: V <- V R^-1 with V^T M V = R^T R. Columns of zeros
// stay unchanged.
void OrthonormalizeBand(const SparseMatrix& mass, MultiVector& vectors, int threads)
{
  Eigen::MatrixXd gram = GramMatrix(mass, vectors, threads);
  const Eigen::VectorXd norms = gram.diagonal();
  gram.diagonal() = (norms.array() > 0.0).select(norms, 1.0);
  const Eigen::MatrixXd inverse =
    CholeskyOfGram(gram).matrixU().solve(Eigen::MatrixXd::Identity(gram.rows(), gram.cols()));
  vectors = LinearCombination(vectors, inverse, threads);
}

// The mean spacing of the known eigenvalues near the last cut; Weyl's where none is known.
double BandSequence::LocalSpacing() const
{
  if (this->IsFirst())
  {
    return WeylSpacing;
  }
  const std::size_t last = this->Values.size() - 1;
  const std::size_t middle = (this->Problem.Kernel.cols() + last) / 2;
  return last > middle
    ? (this->Values[last] - this->Values[middle]) / static_cast<double>(last - middle)
    : this->Values[last] / static_cast<double>(last + 1);
}

// An estimate of how far above the last cut the middle of the next band lies.
double BandSequence::FirstReach() const
{
  const Index middle = this->Found() + this->Target() / 2;
  if (this->InitialGuess != nullptr && middle + 1 < this->InitialGuess->Values.size())
  {
    const double base = this->IsFirst() ? 0.0 : this->LowerCut;
    const auto& values = this->InitialGuess->Values;
    return std::max(WeylSpacing, 0.5 * (values[middle] + values[middle + 1]) - base);
  }
  return 0.5 * static_cast<double>(this->Target()) * this->LocalSpacing();
}

// An initial guess at the band's span: random combinations of the vectors with the same numbers in
// the solution of the similar problem.
BlockVector BandSequence::Start() const
{
  if (this->InitialGuess == nullptr)
  {
    return {};
  }
  const Index first = this->Found();
  const Index count =
    std::min(this->InitialGuess->Vectors->cols() - first, this->Target() + CutWindow);
  if (count < BlockWidth)
  {
    return {};
  }
  Eigen::MatrixXd weights(count, BlockWidth);
  for (Index k = 0; k < weights.size(); ++k)
  {
    weights.data()[k] = NormalRandom(1, static_cast<std::uint64_t>(k));
  }
  return ToMultiVector(this->InitialGuess->Vectors->middleCols(first, count) * weights,
    this->Solver.Order())[0];
}

// Places the shift in the middle of the band, half a band above the last cut. A shift that is too
// far up costs a Krylov space full of pairs that are not wanted yet, or known; one that is too near
// makes the space grow on one side only. The very first shift may have to lie below the spectrum,
// by a twelfth of what Weyl's law gives for the first eigenvalue of a sphere: S + M is then well
// conditioned, and its factorisation is a Cholesky.
void BandSequence::ChooseShift(const Progress& progress)
{
  if (this->IsFirst() && !this->Solver.FirstShiftInside())
  {
    this->Shift = -1.0;
    this->BelowShift = this->Solver.Factorize(this->Shift, progress);
    return;
  }
  const double base = this->IsFirst() ? 0.0 : this->LowerCut;
  const double half = 0.5 * static_cast<double>(this->Target());
  double reach = this->FirstReach();
  for (int attempt = 0; attempt < 8; ++attempt)
  {
    this->Shift = base + reach;
    this->BelowShift = this->Solver.Factorize(this->Shift, progress);
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

// The vectors that a search excludes. Known bands are usually far from the shift, and pairs of
// theirs that are found again are dropped. A second search, however, must not spend its effort on
// the last band.
MultiVector BandSequence::Locked(const Band& band) const
{
  MultiVector locked;
  if (this->IsFirst() || !band.Vectors.empty())
  {
    locked.assign(this->Vectors.begin() + static_cast<std::ptrdiff_t>(this->LastBand),
      this->Vectors.end());
  }
  locked.insert(locked.end(), band.Vectors.begin(), band.Vectors.end());
  return locked;
}

// Merges the pairs that lie above the lower cut into the band; those below it are already known.
void BandSequence::AddInInterval(Band found, Band& band) const
{
  band.Orthonormal = band.Values.empty() && found.Orthonormal;
  std::vector<Index> columns;
  std::vector<double> values;
  MultiVector blocks;
  for (Band* part : { &band, &found })
  {
    for (std::size_t k = 0; k < part->Values.size(); ++k)
    {
      columns.push_back(BlockWidth * static_cast<Index>(blocks.size()) + static_cast<Index>(k));
      values.push_back(part->Values[k]);
    }
    std::move(part->Vectors.begin(), part->Vectors.end(), std::back_inserter(blocks));
  }
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{ 0 });
  std::stable_sort(order.begin(), order.end(),
    [&values](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  band.Values.clear();
  std::vector<Index> kept;
  for (const std::size_t k : order)
  {
    if (values[k] > this->LowerCut)
    {
      band.Values.push_back(values[k]);
      kept.push_back(columns[k]);
    }
  }
  band.Vectors = SelectColumns(blocks, kept, this->Threads);
  band.NextValue = std::isnan(found.NextValue) ? band.NextValue : found.NextValue;
}

// Cuts the band in its widest gap at or after `target` pairs and counts the eigenvalues below the
// cut. Returns true when the band then holds every eigenvalue between its two cuts.
bool BandSequence::Cut(Band& band, Index target, const Progress& progress)
{
  const Index size = static_cast<Index>(band.Values.size());
  if (size < target)
  {
    return false;
  }
  if (this->Found() + size >= this->Problem.Rank)
  {
    // The band contains the rest of the spectrum, so there is nothing above to cut off.
    return this->Found() + size == this->Problem.Rank;
  }
  // A next value that a later search has found makes no gap.
  std::vector<double> values = band.Values;
  values.push_back(band.NextValue);
  Index cut = -1;
  double widest = 0.0;
  for (Index k = std::max<Index>(target, 1); k <= size; ++k)
  {
    const double gap = values[k] - values[k - 1];
    if (gap > widest)
    {
      widest = gap;
      cut = k;
    }
  }
  if (cut < 0 || widest < MinimalGap * values[cut])
  {
    return false;
  }
  const double upperCut = 0.5 * (values[cut] + values[cut - 1]);
  const Index below = this->Solver.Factorize(upperCut, progress);
  if (below != this->Found() + cut)
  {
    return false;
  }
  band.Values.resize(cut);
  this->LowerCut = upperCut;
  return true;
}

// Makes the vectors of a new band orthogonal to all known ones to the last digit. They are
// orthogonal up to their residuals, so one pass of block Gram-Schmidt suffices.
void BandSequence::ProjectOutKnown(MultiVector& vectors, const Progress& progress) const
{
  MultiVector product;
  for (std::size_t first = 0; first < vectors.size(); first += BlocksAtOnce)
  {
    const std::size_t count = std::min(BlocksAtOnce, vectors.size() - first);
    const Eigen::MatrixXd known = InnerProducts(this->Vectors, this->Solver.Mass(),
      MultiVectorView(vectors.data() + first, count), product, this->Threads);
    SubtractCombination(this->Vectors, known, vectors.data() + first, this->Threads);
    progress.Report(static_cast<double>(first + count) / static_cast<double>(vectors.size()));
  }
}

// Appends the band's values and the same number of its vectors, the first ones.
void BandSequence::Append(Band band, const Progress& progress)
{
  const std::size_t blocks = (band.Values.size() + BlockWidth - 1) / BlockWidth;
  band.Vectors.resize(blocks);
  if (blocks > 0)
  {
    BlockVector& last = band.Vectors.back();
    last.rightCols(BlockWidth * static_cast<Index>(blocks) - static_cast<Index>(band.Values.size()))
      .setZero();
  }
  this->ProjectOutKnown(band.Vectors, progress);
  if (!band.Orthonormal)
  {
    OrthonormalizeBand(this->Solver.Mass(), band.Vectors, this->Threads);
  }
  this->LastBand = this->Vectors.size();
  for (std::size_t k = 0; k < band.Values.size(); ++k)
  {
    this->Values.push_back(band.Values[k]);
    this->Column.push_back(BlockWidth * static_cast<Index>(this->LastBand) + static_cast<Index>(k));
  }
  std::move(band.Vectors.begin(), band.Vectors.end(), std::back_inserter(this->Vectors));
}

// Whether the band cannot be part of the spectrum: it has more values than exist, or one far below
// 0. This happens where the mesh's numbers are all rounding. Found pairs are kept, so another
// search would not help.
bool BandSequence::IsImpossible(const Band& band) const
{
  if (band.Values.empty())
  {
    return false;
  }
  const double largest = std::max(-band.Values.front(), band.Values.back());
  return this->Found() + static_cast<Index>(band.Values.size()) > this->Problem.Rank ||
    band.Values.front() < -FarBelow * largest;
}

bool BandSequence::SolveBand(const Progress& progress)
{
  ++this->Bands;
  const Index target = this->Target();
  this->ChooseShift(progress.Part(0.0, 0.0));
  progress.Report(0.05);

  const Index below = std::max<Index>(0, this->BelowShift - this->Found());
  const Index above = std::max<Index>(1, target - below);
  Band band;
  for (int repair = 0; repair < MaximumSearches; ++repair)
  {
    // Each search takes a part of the remaining progress range.
    const double begin = repair == 0 ? 0.05 : 0.95 - 0.1 / repair;
    const double end = 0.95 - 0.1 / (repair + 1);
    if (repair > 0)
    {
      // Pairs may be missing because the shift nearly hit an eigenvalue.
      this->Shift += ShiftStep * this->LocalSpacing();
      this->Solver.Factorize(this->Shift, progress.Part(begin, begin));
    }
    // Usually few pairs are missing; a large cluster (many equal components) needs larger requests.
    const Index missing = CutWindow << std::min(std::max(0, repair - 1), 4);
    BandRequest request;
    request.Below = repair == 0 ? below : 0;
    request.Above = repair == 0 ? above : missing;
    request.Window = repair == 0 ? CutWindow : 0;
    request.AnySide = repair > 0;
    request.Locked = this->Locked(band);
    request.Start = repair == 0 ? this->Start() : BlockVector();
    request.Tolerance = this->Tolerance;
    request.Attempt = repair;
    this->AddInInterval(this->Solver.FindNearest(std::move(request), progress.Part(begin, end)),
      band);
    if (this->Cut(band, target, progress.Part(end, end)))
    {
      this->Append(std::move(band), progress.Part(end, 1.0));
      return true;
    }
    if (this->IsImpossible(band))
    {
      return false;
    }
  }
  return false;
}

EigenPairs BandSequence::TakeResult()
{
  const Index count = std::min(this->Wanted, this->Found());
  EigenPairs pairs;
  pairs.Bands = this->Bands;
  pairs.Values = Eigen::Map<const Eigen::VectorXd>(this->Values.data(), count);
  Eigen::VectorXd values =
    Eigen::VectorXd::Zero(BlockWidth * static_cast<Index>(this->Vectors.size()));
  for (std::size_t k = 0; k < this->Values.size(); ++k)
  {
    values[this->Column[k]] = this->Values[k];
  }
  const Eigen::VectorXd residuals = MultiVectorResiduals(this->Solver.Stiffness(),
    this->Solver.Mass(), values, this->Vectors, this->Threads);
  const std::vector<Index> columns(this->Column.begin(), this->Column.begin() + count);
  pairs.Residuals.resize(count);
  for (Index k = 0; k < count; ++k)
  {
    pairs.Residuals[k] = residuals[columns[k]];
  }
  pairs.Vectors =
    TakeColumns(std::move(this->Vectors), columns, this->Solver.Order(), this->Threads);
  return pairs;
}

} // namespace

EigenPairs SolveBySlicing(const EigenProblem& problem, const EigensolverOptions& options,
  ShiftInvertSolver& solver, const Progress& progress)
{
  BandSequence bands(problem, options, solver);
  bool complete = true;
  while (complete && !bands.Finished())
  {
    complete =
      bands.SolveBand(progress.Part(0.95 * bands.FractionDone(), 0.95 * bands.FractionAfterBand()));
  }
  EigenPairs pairs = bands.TakeResult();
  pairs.Complete = complete && pairs.Values.size() == options.Count;
  progress.Report(1.0);
  return pairs;
}

} // namespace spectralwatermark

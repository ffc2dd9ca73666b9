// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Eigensolver/BlockLanczos.h"

#include "Core/Eigensolver/BlockKrylovSpace.h"
#include "Core/Eigensolver/Residuals.h"
#include "Core/Eigensolver/SpectrumSlicing.h"
#include "Core/LinearAlgebra/MultiVector.h"
#include "Core/LinearAlgebra/ShiftedFactorization.h"
#include "Core/Support/AbortableCall.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace spectralwatermark
{

namespace
{

// What the residual of a Ritz pair may be, in parts of the tolerance asked for.
constexpr double ShareOfTolerance = 0.3;

// Eigenvalues closer than this, relative to their size, are taken for one that repeats.
constexpr double NearlyEqual = 1e-7;

// Of a solve, see ShiftedFactorization::SolveError(). Residuals of low frequencies are some hundred
// times larger.
constexpr double LargestSolveError = 1e-11;

// What a band may end before, in mean distances of its eigenvalues.
constexpr double ComfortableGap = 0.3;

// Under this tolerance rounding begins to show in the residuals.
constexpr double TightTolerance = 1e-10;

// Eigenpairs of the projected operator, theta = 1 / (lambda - shift), ascending.
struct RitzPairs
{
  Eigen::VectorXd Theta;
  Eigen::MatrixXd Coefficients;
  Eigen::MatrixXd Beyond; // what each couples into the next block; empty when nothing is left

  // What vector k holds of others, at most, as a share; 0 when the space is invariant.
  double Impurity(Index k) const
  {
    return this->Beyond.size() == 0 ? 0.0 : this->Beyond.col(k).norm() / std::abs(this->Theta[k]);
  }
};

RitzPairs SolveProjected(const BlockKrylovSpace& space)
{
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(space.Projected());
  RitzPairs ritz;
  ritz.Theta = solver.eigenvalues();
  ritz.Coefficients = solver.eigenvectors();
  if (space.LastCoupling().size() > 0)
  {
    ritz.Beyond = space.LastCoupling() * ritz.Coefficients.bottomRows(BlockWidth);
  }
  return ritz;
}

// The pairs that were asked for, ascending by eigenvalue, as far as they are there.
struct Selection
{
  std::vector<Index> Pairs;
  double NextValue = std::numeric_limits<double>::quiet_NaN();
  bool Enough = false; ///< as many as were asked for
};

// Eigenvalue and number of each Ritz pair, ascending.
std::vector<std::pair<double, Index>> SortedValues(const Eigen::VectorXd& theta, double shift)
{
  std::vector<std::pair<double, Index>> values;
  for (Index k = 0; k < theta.size(); ++k)
  {
    values.emplace_back(shift + 1.0 / theta[k], k);
  }
  std::sort(values.begin(), values.end());
  return values;
}

// How many of the ascending values to take, at least `least`, so that the next one is far: the first
// comfortable gap, else the widest. 0 when there are too few.
std::size_t EndBeforeGap(const std::vector<std::pair<double, Index>>& values, std::size_t least,
  std::size_t window)
{
  if (values.size() <= least + window)
  {
    return 0;
  }
  const double spacing = (values[least].first - values.front().first) / static_cast<double>(least);
  std::size_t end = least;
  double widest = 0.0;
  for (std::size_t k = least; k < least + window; ++k)
  {
    const double gap = values[k].first - values[k - 1].first;
    if (gap >= ComfortableGap * spacing)
    {
      return k;
    }
    if (gap > widest)
    {
      widest = gap;
      end = k;
    }
  }
  return end;
}

Selection SelectNearest(std::vector<std::pair<double, Index>> values, double shift, Index count)
{
  std::stable_sort(values.begin(), values.end(),
    [shift](const auto& a, const auto& b)
    { return std::abs(a.first - shift) < std::abs(b.first - shift); });
  Selection selection;
  selection.Enough = static_cast<Index>(values.size()) >= count;
  values.resize(std::min<std::size_t>(values.size(), count));
  std::sort(values.begin(), values.end());
  for (const auto& [value, pair] : values)
  {
    selection.Pairs.push_back(pair);
  }
  return selection;
}

Selection SelectWanted(const Eigen::VectorXd& theta, double shift, const BandRequest& request)
{
  std::vector<std::pair<double, Index>> values = SortedValues(theta, shift);
  if (request.AnySide)
  {
    return SelectNearest(std::move(values), shift, request.Below + request.Above);
  }
  const auto firstAbove = std::partition_point(values.begin(), values.end(),
    [shift](const auto& value) { return value.first < shift; });
  const Index below = std::min<Index>(request.Below, firstAbove - values.begin());
  values.erase(values.begin(), firstAbove - below);
  const std::size_t end = EndBeforeGap(values, below + request.Above, request.Window);
  Selection selection;
  selection.Enough = below == request.Below && end > 0;
  if (end > 0)
  {
    selection.NextValue = values[end].first;
    values.resize(end);
  }
  for (const auto& [value, pair] : values)
  {
    selection.Pairs.push_back(pair);
  }
  return selection;
}

// The wanted pairs whose residuals are over the tolerance. What a vector holds of others, up to the
// highest frequency wanted, weighs by their eigenvalue over its own in its relative residual.
// `worst` becomes the largest excess, 1 at the tolerance.
std::vector<Index> OpenPairs(const RitzPairs& ritz, const std::vector<Index>& wanted, double shift,
  double tolerance, double& worst)
{
  double highest = 0.0;
  for (const Index k : wanted)
  {
    highest = std::max(highest, shift + 1.0 / ritz.Theta[k]);
  }
  std::vector<Index> open;
  worst = 0.0;
  for (const Index k : wanted)
  {
    const double value = std::max(0.0, shift + 1.0 / ritz.Theta[k]);
    const double excess =
      ritz.Impurity(k) * (highest + 1.0) / (ShareOfTolerance * tolerance * (value + 1.0));
    worst = std::max(worst, excess);
    if (excess > 1.0)
    {
      open.push_back(k);
    }
  }
  return open;
}

// Residuals fall by about the same factor with every block once they begin to: foretells when the
// last one will be small enough, since looking is expensive.
class Convergence
{
public:
  /// Blocks from `size` on until the excess should be 1.
  Index StepsToGo(Index size, double excess)
  {
    double factor = UsualFactor;
    if (this->LastSize > 0 && excess < this->LastExcess)
    {
      const auto steps = static_cast<double>(size - this->LastSize) / BlockWidth;
      factor = std::max(std::log(this->LastExcess / excess) / steps, 0.5 * UsualFactor);
    }
    this->LastSize = size;
    this->LastExcess = excess;
    // Nothing to go by is no excess; a pair at infinity is none that could be waited for.
    const double bounded = std::clamp(excess, 1.0, LargestExcess);
    return std::max<Index>(1, static_cast<Index>(std::ceil(std::log(bounded) / factor)));
  }

private:
  static constexpr double UsualFactor = 1.5; // of the natural logarithm
  static constexpr double LargestExcess = 1e16;

  Index LastSize = 0;
  double LastExcess = 0.0;
};

// How much of eigenvector i approximate eigenvector j holds, e_ij, to first order: from
// products_ij = e_ij + e_ji and energies_ij = lambda_i e_ij + lambda_j e_ji. Nearly equal
// eigenvalues cannot be told apart by the latter: there the products are shared out equally.
Eigen::MatrixXd FirstOrderMixing(const Eigen::MatrixXd& energies, const Eigen::MatrixXd& products,
  const Eigen::VectorXd& values)
{
  const Index count = values.size();
  Eigen::MatrixXd shares = Eigen::MatrixXd::Zero(count, count);
  for (Index j = 0; j < count; ++j)
  {
    for (Index i = 0; i < count; ++i)
    {
      const double scale = std::sqrt(products(i, i) * products(j, j));
      const double product = products(i, j) / scale;
      const double gap = values[i] - values[j];
      const double share = std::abs(gap) > NearlyEqual * (values[i] + values[j])
        ? (energies(i, j) / scale - values[j] * product) / gap
        : 0.5 * product;
      shares(i, j) = i == j ? 0.0 : share;
    }
  }
  return shares;
}

class BlockLanczos : public ShiftInvertSolver
{
public:
  BlockLanczos(const EigenProblem& problem, const EigensolverOptions& options,
    const Progress& progress)
    : Factorization(Analyze(problem, options, progress))
    , Tight(options.Tolerance < TightTolerance)
    , Threads(options.Threads)
  {
  }

  Index DefaultBandSize(Index wanted) const override
  {
    // Bands of about equal size.
    constexpr Index most = 150;
    const Index bands = (wanted + most - 1) / most;
    return (wanted + bands - 1) / bands;
  }
  // Thetas near a shift are large, and their rounding is what the others are known to: for low
  // frequencies to the last digit the shift must be on their side.
  bool FirstShiftInside() const override { return !this->Tight; }

  Index Factorize(double shift, const Progress& progress) override
  {
    this->Shift = shift;
    return RunAbortably(progress,
      [factorization = this->Factorization, shift, threads = this->Threads]()
      { return factorization->Factorize(shift, threads); });
  }

  bool IsAccurate() const override
  {
    return this->Factorization->SolveError(this->Threads) < LargestSolveError;
  }

  Band FindNearest(BandRequest request, const Progress& progress) override;

  const SparseMatrix& Stiffness() const override { return this->Factorization->Stiffness(); }
  const SparseMatrix& Mass() const override { return this->Factorization->Mass(); }
  const Eigen::VectorXi& Order() const override { return this->Factorization->Order(); }

private:
  static std::shared_ptr<ShiftedFactorization> Analyze(const EigenProblem& problem,
    const EigensolverOptions& options, const Progress& progress)
  {
    const Eigen::VectorXi known =
      options.InitialGuess != nullptr ? options.InitialGuess->Order : Eigen::VectorXi();
    return RunAbortably(progress,
      [stiffness = problem.Stiffness, mass = problem.Mass, known]()
      { return std::make_shared<ShiftedFactorization>(stiffness, mass, known); });
  }

  Band Refined(const BlockKrylovSpace& space, const RitzPairs& ritz, const std::vector<Index>& kept,
    const Progress& progress) const;
  void LeaveOutInaccurate(Band& band, double tolerance) const;
  double ResidualFloor(const Band& band, Index column) const;

  std::shared_ptr<ShiftedFactorization> Factorization; // shared with a call that was given up
  bool Tight;
  int Threads;
  double Shift = 0.0;
};

Band BlockLanczos::FindNearest(BandRequest request, const Progress& progress)
{
  const Index count = request.Below + request.Above;
  const Index locked = BlockWidth * static_cast<Index>(request.Locked.size());
  const bool isFirst = !request.Locked.empty();
  const bool isGuess = request.Start.size() > 0;
  BlockKrylovSpace space(*this->Factorization, std::move(request.Locked), std::move(request.Start),
    static_cast<std::uint64_t>(request.Attempt), this->Threads);
  // What it takes as a rule, and never more than what a hopeless band may cost.
  const double expected = 2.1 * static_cast<double>(count) + 130.0;
  const Index limit = std::min(this->Factorization->Size() - locked - BlockWidth, 5 * count + 200);
  // Converged pairs on the other side of a shift take room as well.
  const double usual =
    (isFirst ? 1.5 : 2.1) * static_cast<double>(count) + (isGuess ? 60.0 : 128.0);
  Index nextCheck = static_cast<Index>(usual);
  RitzPairs ritz;
  Selection selection;
  std::vector<Index> open;
  Convergence convergence;
  for (bool done = false; !done;)
  {
    bool extended = space.Extend();
    progress.Report(0.9 * std::min(1.0, static_cast<double>(space.Size()) / expected));
    const bool last = !extended || space.Size() >= limit;
    if (!last && space.Size() < nextCheck)
    {
      continue;
    }
    extended = space.Reorthogonalize() && extended;
    ritz = SolveProjected(space);
    selection = SelectWanted(ritz.Theta, this->Shift, request);
    double worst = 0.0;
    open = OpenPairs(ritz, selection.Pairs, this->Shift, request.Tolerance, worst);
    done = last || !extended || (open.empty() && selection.Enough);
    nextCheck = space.Size() + convergence.StepsToGo(space.Size(), worst) * BlockWidth;
  }
  std::vector<Index>& wanted = selection.Pairs;
  wanted.erase(std::remove_if(wanted.begin(), wanted.end(),
                 [&open](Index k) { return std::find(open.begin(), open.end(), k) != open.end(); }),
    wanted.end());
  Band band = this->Refined(space, ritz, wanted, progress.Part(0.9, 1.0));
  band.NextValue = selection.NextValue;
  if (request.Attempt == 0)
  {
    this->LeaveOutInaccurate(band, request.Tolerance);
  }
  progress.Report(1.0);
  return band;
}

// One inverse iteration, (S - sigma M)^-1 M h / theta. It takes high frequencies away, but blows up
// what a vector holds of those nearer to the shift; and far from the shift neighbours are hard to
// tell apart by theta. What vectors hold of each other is therefore subtracted, to first order.
// Combining the vectors anew instead would leave rounding of all frequencies in them.
Band BlockLanczos::Refined(const BlockKrylovSpace& space, const RitzPairs& ritz,
  const std::vector<Index>& kept, const Progress& progress) const
{
  if (kept.empty())
  {
    return { {}, {}, true };
  }
  const auto count = static_cast<Index>(kept.size());
  Eigen::MatrixXd coefficients(space.Size(), count);
  for (Index i = 0; i < count; ++i)
  {
    const Index k = kept[i];
    coefficients.col(i) = ritz.Coefficients.col(k) / ritz.Theta[k];
  }
  MultiVector vectors = space.Combine(coefficients);
  progress.Report(0.3);
  this->Factorization->SolveWithMass(vectors, this->Tight, this->Threads);
  progress.Report(0.5);

  const Eigen::MatrixXd energies = GramMatrix(this->Stiffness(), vectors, this->Threads);
  progress.Report(0.6);
  const Eigen::MatrixXd products = GramMatrix(this->Mass(), vectors, this->Threads);
  progress.Report(0.8);
  const Eigen::VectorXd values =
    energies.diagonal().head(count).cwiseQuotient(products.diagonal().head(count));
  const Eigen::MatrixXd pure = Eigen::MatrixXd::Identity(count, count) -
    FirstOrderMixing(energies.topLeftCorner(count, count), products.topLeftCorner(count, count),
      values);
  // Orthonormal to the last digit at the same time: pure R^-1 with R^T R its Gram matrix.
  const Eigen::MatrixXd mixture =
    CholeskyOfGram(pure.transpose() * products.topLeftCorner(count, count) * pure)
      .matrixU()
      .solve<Eigen::OnTheRight>(pure);
  return { { values.data(), values.data() + count },
    LinearCombination(vectors, mixture, this->Threads), true };
}

// Leaves out pairs whose residuals are over the tolerance, and more than rounding makes them.
void BlockLanczos::LeaveOutInaccurate(Band& band, double tolerance) const
{
  Eigen::VectorXd values =
    Eigen::VectorXd::Zero(BlockWidth * static_cast<Index>(band.Vectors.size()));
  std::copy(band.Values.begin(), band.Values.end(), values.begin());
  const Eigen::VectorXd residuals =
    MultiVectorResiduals(this->Stiffness(), this->Mass(), values, band.Vectors, this->Threads);
  std::vector<Index> kept;
  for (std::size_t k = 0; k < band.Values.size(); ++k)
  {
    const auto column = static_cast<Index>(k);
    if (residuals[column] <= tolerance ||
      residuals[column] <= tolerance + this->ResidualFloor(band, column))
    {
      kept.push_back(column);
    }
  }
  if (kept.size() == band.Values.size())
  {
    return;
  }
  band.Values.clear();
  for (const Index column : kept)
  {
    band.Values.push_back(values[column]);
  }
  band.Vectors = SelectColumns(band.Vectors, kept, this->Threads);
}

double BlockLanczos::ResidualFloor(const Band& band, Index column) const
{
  const Eigen::VectorXd vector = band.Vectors[column / BlockWidth].col(column % BlockWidth);
  const Eigen::VectorXd value = Eigen::VectorXd::Constant(1, band.Values[column]);
  return ResidualFloors(this->Stiffness(), this->Mass(), 1.0, value, vector)[0];
}

} // namespace

EigenPairs BlockLanczosSolver::Solve(const EigenProblem& problem, const EigensolverOptions& options,
  const Progress& progress) const
{
  // Starting a thread costs more than it saves on few rows.
  const Index useful = problem.Stiffness.rows() / (4 * RowsPerChunk);
  EigensolverOptions own = options;
  own.Threads = static_cast<int>(std::clamp<Index>(useful, 1, std::max(1, options.Threads)));
  BlockLanczos solver(problem, own, progress.Part(0.0, 0.0));
  EigenPairs pairs = SolveBySlicing(problem, own, solver, progress);
  pairs.Order = solver.Order();
  return pairs;
}

} // namespace spectralwatermark

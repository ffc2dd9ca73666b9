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

// Largest residual of a converged Ritz pair, as a share of the requested tolerance.
constexpr double ShareOfTolerance = 0.3;

// Relative distance of two eigenvalues below which they are treated as one repeated eigenvalue.
constexpr double NearlyEqual = 1e-7;

// Largest ShiftedFactorization::SolveError() of an accurate factorisation. The residuals of low
// frequencies are some hundred times larger than this error.
constexpr double LargestSolveError = 1e-11;

// Gap, in mean distances of a band's eigenvalues, that is wide enough for the band to end at it.
constexpr double ComfortableGap = 0.3;

// Requested tolerance below which rounding begins to show in the residuals.
constexpr double TightTolerance = 1e-10;

// Eigenpairs of the projected operator, theta = 1 / (lambda - shift), ascending.
struct RitzPairs
{
  Eigen::VectorXd Theta;
  Eigen::MatrixXd Coefficients;

  // The coupling of each Ritz vector to the next block; empty when the space is invariant.
  Eigen::MatrixXd Beyond;

  // An upper bound on the share of other eigenvectors in vector k; 0 when the space is invariant.
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

// The requested pairs, as far as the space contains them.
struct Selection
{
  std::vector<Index> Pairs; // the numbers of the pairs, ascending by eigenvalue
  double NextValue = std::numeric_limits<double>::quiet_NaN(); // see Band
  bool Enough = false; // whether there are as many pairs as requested
};

// The eigenvalue and the number of each Ritz pair, ascending by eigenvalue.
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

// The number of ascending values to take, `least` or more, so that the next one is far away. The
// cut is at the first comfortable gap, or at the widest gap if there is none. 0 when there are too
// few values.
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

// The wanted pairs whose residuals exceed the tolerance. A vector's share of another eigenvector,
// up to the highest frequency wanted, enters its relative residual multiplied by the ratio of the
// other eigenvalue to its own. `worst` is set to the largest excess, which is 1 at the tolerance.
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

// Predicts when a band will have converged, because each check costs an eigenproblem. Once
// residuals begin to fall, they fall by about the same factor with every block.
class Convergence
{
public:
  /// The number of blocks to add to a space of this size until the excess should be 1.
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
    // The excess is 0 without a pair to judge by, and infinite for a pair at infinity.
    const double bounded = std::clamp(excess, 1.0, LargestExcess);
    return std::max<Index>(1, static_cast<Index>(std::ceil(std::log(bounded) / factor)));
  }

private:
  // Usual decrease per block of the excess's natural logarithm.
  static constexpr double UsualFactor = 1.5;

  // Excess above which a prediction makes no difference.
  static constexpr double LargestExcess = 1e16;

  Index LastSize = 0;
  double LastExcess = 0.0;
};

// The share e_ij of eigenvector i in the approximate eigenvector j, to first order. It follows from
// products_ij = e_ij + e_ji and energies_ij = lambda_i e_ij + lambda_j e_ji. The energies do not
// separate nearly equal eigenvalues, so there each of the two gets half of the product.
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

  // Near the shift the values theta are large, and their rounding limits the accuracy of the
  // others. For low frequencies that are accurate to the last digit, the shift must be on their
  // side.
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

  // Ritz vectors after one inverse iteration.
  Band Refined(const BlockKrylovSpace& space, const RitzPairs& ritz, const std::vector<Index>& kept,
    const Progress& progress) const;

  // Removes the pairs whose residuals exceed the tolerance by more than rounding explains.
  void LeaveOutInaccurate(Band& band, double tolerance) const;

  // See ResidualFloors().
  double ResidualFloor(const Band& band, Index column) const;

  // Shared with an abandoned call, which may outlive the solver.
  std::shared_ptr<ShiftedFactorization> Factorization;
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
  // The usual size of the space at convergence.
  const double expected = 2.1 * static_cast<double>(count) + 130.0;
  // The size at which the search ends, so that the cost of a band that does not converge is
  // bounded.
  const Index limit = std::min(this->Factorization->Size() - locked - BlockWidth, 5 * count + 200);
  // The size at the first check. Converged pairs on the other side of the shift, which the first
  // band does not have, take up space as well.
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

// One inverse iteration, (S - sigma M)^-1 M h / theta. It removes high frequencies, but amplifies a
// vector's share of eigenvectors nearer to the shift. Far from the shift, theta also hardly
// separates neighbours. The vectors' shares of each other are therefore subtracted, to first order.
// Recombining the vectors instead would leave rounding of all frequencies in them.
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
  // pure R^-1, with R^T R the Gram matrix of `pure`, is orthonormal to the last digit.
  const Eigen::MatrixXd mixture =
    CholeskyOfGram(pure.transpose() * products.topLeftCorner(count, count) * pure)
      .matrixU()
      .solve<Eigen::OnTheRight>(pure);
  return { { values.data(), values.data() + count },
    LinearCombination(vectors, mixture, this->Threads), true };
}

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

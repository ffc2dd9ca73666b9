// SPDX-License-Identifier: BSD-3-Clause
#include "BlockLanczosEigensolver.h"

#include "BandedSolve.h"
#include "Errors.h"
#include "LaplaceOperator.h"
#include "Noise.h"
#include "ShiftedFactorization.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>

namespace spectralwatermark
{

namespace
{

// What the residual of a Ritz pair may be, in parts of the tolerance asked for.
constexpr double PartOfTolerance = 0.3;

// Eigenvalues closer than this, relative to their size, are taken for one that repeats.
constexpr double NearlyEqual = 1e-7;

// Of a solve, see ShiftedFactorization::SolveError(). Residuals of low frequencies are some hundred
// times larger.
constexpr double LargestSolveError = 1e-11;

// Under this tolerance rounding begins to show in the residuals.
constexpr double TightTolerance = 1e-10;

// A new block whose smallest direction keeps less than this share of its length once all before is
// taken out holds nothing but rounding.
constexpr double Exhausted = 1e-10;

// The Krylov space of (S - sigma M)^-1 M from a random block, and the operator projected on it.
class KrylovSpace
{
public:
  KrylovSpace(const ShiftedFactorization& factorization, const Panels& locked, std::uint64_t seed,
    int threads)
    : Factorization(factorization)
    , Threads(threads)
    , Locked(locked.size())
    , Basis(locked)
  {
    if (this->Append(this->RandomPanel(seed)).size() == 0)
    {
      throw SolverFailure("the mesh has too few vertices with area for the solver to work on: ask "
                          "for fewer harmonics, or remove its triangles without area");
    }
  }

  /// Vectors that the operator has been applied to: the size of the projected problem.
  Index Size() const { return PanelWidth * static_cast<Index>(this->Diagonal.size()); }

  /// Applies the operator to the last block and appends what is new in it. False when nothing is:
  /// the space is then invariant.
  bool Extend();

  Eigen::MatrixXd Projected() const;

  /// What the operator makes of the last block beyond the space, as a factor of the next block.
  const Eigen::MatrixXd& LastCoupling() const { return this->Coupling.back(); }

  /// Linear combinations of the basis, the last block included, as panels.
  Panels Combine(const Eigen::MatrixXd& coefficients) const
  {
    const Panels krylov(this->Basis.begin() + static_cast<std::ptrdiff_t>(this->Locked),
      this->Basis.end());
    return CombinePanels(krylov, coefficients, this->Threads);
  }

private:
  Panel RandomPanel(std::uint64_t seed) const
  {
    Panel panel(this->Factorization.Size(), PanelWidth);
    for (Index i = 0; i < panel.size(); ++i)
    {
      panel.data()[i] = NormalRandom(seed, static_cast<std::uint64_t>(i));
    }
    return panel;
  }

  // Q^T M W
  Eigen::MatrixXd Project(const PanelRange& q, const Panel& w) const
  {
    Panel product;
    MultiplyPanel(this->Factorization.Mass(), w, product, this->Threads);
    return ProjectPanel(q, product, this->Threads);
  }

  // Takes out of W what lies in the panels; returns how much of each.
  Eigen::MatrixXd TakeOut(const PanelRange& q, Panel& w) const
  {
    Eigen::MatrixXd c = this->Project(q, w);
    SubtractPanels(q, c, w, this->Threads);
    return c;
  }

  // W <- Q with W = Q R and Q^T M Q = I, by Cholesky of the Gram matrix. Q is orthonormal to the
  // square of W's condition: for the last digit once more is needed. Returns R, empty when W is
  // singular.
  Eigen::MatrixXd Orthonormalize(Panel& w) const
  {
    const Eigen::MatrixXd gram = this->Project(PanelRange(&w, 1), w);
    const Eigen::LLT<Eigen::MatrixXd> cholesky(0.5 * (gram + gram.transpose()));
    Eigen::MatrixXd r = cholesky.matrixU();
    if (cholesky.info() != Eigen::Success ||
      !(r.diagonal().minCoeff() > Exhausted * r.diagonal().maxCoeff()))
    {
      return {};
    }
    SolveTriangularRight(r, w, this->Threads);
    return r;
  }

  PanelRange All() const { return PanelRange(this->Basis.data(), this->Basis.size()); }
  PanelRange Recent() const
  {
    const std::size_t count = std::min<std::size_t>(2, this->Basis.size() - this->Locked);
    return PanelRange(this->Basis.data() + this->Basis.size() - count, count);
  }

  // Orthonormalises a block against all before it and appends it; returns R, empty on breakdown.
  Eigen::MatrixXd Append(Panel w)
  {
    this->TakeOut(this->All(), w);
    const Eigen::MatrixXd first = this->Orthonormalize(w);
    if (first.size() == 0)
    {
      return {};
    }
    if (this->Basis.size() > this->Locked)
    {
      this->TakeOut(this->Recent(), w);
    }
    const Eigen::MatrixXd second = this->Orthonormalize(w);
    if (second.size() == 0)
    {
      return {};
    }
    this->Basis.push_back(std::move(w));
    return second * first;
  }

  const ShiftedFactorization& Factorization;
  int Threads;
  std::size_t Locked;
  Panels Basis; // the locked panels, then the Krylov blocks
  std::vector<Eigen::MatrixXd> Diagonal;
  std::vector<Eigen::MatrixXd> Coupling;
};

bool KrylovSpace::Extend()
{
  Panel w;
  MultiplyPanel(this->Factorization.Mass(), this->Basis.back(), w, this->Threads);
  this->Factorization.Solve(w);
  // Almost all of it lies in the last two blocks; only then is what remains accurate enough to be
  // taken out of the others in one pass.
  const Eigen::MatrixXd recent = this->TakeOut(this->Recent(), w);
  const Eigen::MatrixXd diagonal = recent.bottomRows(PanelWidth);
  this->Diagonal.push_back(0.5 * (diagonal + diagonal.transpose()));
  this->Coupling.push_back(this->Append(std::move(w)));
  return this->Coupling.back().size() > 0;
}

Eigen::MatrixXd KrylovSpace::Projected() const
{
  const Index size = this->Size();
  Eigen::MatrixXd t = Eigen::MatrixXd::Zero(size, size);
  for (Index j = 0; j < size; j += PanelWidth)
  {
    const auto block = static_cast<std::size_t>(j / PanelWidth);
    t.block(j, j, PanelWidth, PanelWidth) = this->Diagonal[block];
    if (j + PanelWidth < size)
    {
      t.block(j + PanelWidth, j, PanelWidth, PanelWidth) = this->Coupling[block];
      t.block(j, j + PanelWidth, PanelWidth, PanelWidth) = this->Coupling[block].transpose();
    }
  }
  return t;
}

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

RitzPairs SolveProjected(const KrylovSpace& space)
{
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(space.Projected());
  RitzPairs ritz;
  ritz.Theta = solver.eigenvalues();
  ritz.Coefficients = solver.eigenvectors();
  if (space.LastCoupling().size() > 0)
  {
    ritz.Beyond = space.LastCoupling() * ritz.Coefficients.bottomRows(PanelWidth);
  }
  return ritz;
}

// The pairs that were asked for: large positive thetas are just above the shift, large negative
// ones just below.
std::vector<Index> WantedPairs(const Eigen::VectorXd& theta, const BandRequest& request)
{
  std::vector<Index> below;
  std::vector<Index> above;
  for (Index k = 0; k < theta.size(); ++k)
  {
    (theta[k] < 0.0 ? below : above).push_back(k);
  }
  std::reverse(above.begin(), above.end());
  if (!request.AnySide)
  {
    below.resize(std::min(below.size(), static_cast<std::size_t>(request.Below)));
    above.resize(std::min(above.size(), static_cast<std::size_t>(request.Above)));
  }
  below.insert(below.end(), above.begin(), above.end());
  if (request.AnySide)
  {
    std::stable_sort(below.begin(), below.end(),
      [&theta](Index a, Index b) { return std::abs(theta[a]) > std::abs(theta[b]); });
    below.resize(std::min(below.size(), static_cast<std::size_t>(request.Below + request.Above)));
  }
  return below;
}

// The wanted pairs whose residuals are over the tolerance. What a vector holds of others, up to the
// highest frequency wanted, weighs by their eigenvalue over its own in its relative residual.
std::vector<Index> OpenPairs(const RitzPairs& ritz, const std::vector<Index>& wanted, double shift,
  double tolerance)
{
  double highest = 0.0;
  for (const Index k : wanted)
  {
    highest = std::max(highest, shift + 1.0 / ritz.Theta[k]);
  }
  std::vector<Index> open;
  for (const Index k : wanted)
  {
    const double value = std::max(0.0, shift + 1.0 / ritz.Theta[k]);
    if (ritz.Impurity(k) * (highest + 1.0) > PartOfTolerance * tolerance * (value + 1.0))
    {
      open.push_back(k);
    }
  }
  return open;
}

// How much of eigenvector i approximate eigenvector j holds, e_ij, to first order: from
// products_ij = e_ij + e_ji and energies_ij = lambda_i e_ij + lambda_j e_ji. Nearly equal
// eigenvalues cannot be told apart by the latter: there the products are shared out equally.
Eigen::MatrixXd ForeignShares(const Eigen::MatrixXd& energies, const Eigen::MatrixXd& products,
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
  BlockLanczos(const EigenProblem& problem, double tolerance, int threads)
    : Problem(problem)
    , Factorization(problem.Stiffness, problem.Mass)
    , Tight(tolerance < TightTolerance)
    , Threads(threads)
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

  Index Factorize(double shift) override
  {
    this->Shift = shift;
    return this->Factorization.Factorize(shift);
  }

  bool IsAccurate() const override { return this->Factorization.SolveError() < LargestSolveError; }

  Band FindNearest(const BandRequest& request, const Progress& progress) override;

private:
  Band Polished(const KrylovSpace& space, const RitzPairs& ritz,
    const std::vector<Index>& kept) const;
  Eigen::MatrixXd Gram(const Eigen::SparseMatrix<double>& a, const Panels& vectors) const;
  Eigen::VectorXd RayleighQuotients(const Panels& vectors) const;
  void LeaveOutInaccurate(Band& band, double tolerance) const;

  const EigenProblem& Problem;
  ShiftedFactorization Factorization;
  bool Tight;
  int Threads;
  double Shift = 0.0;
};

Band BlockLanczos::FindNearest(const BandRequest& request, const Progress& progress)
{
  const Index count = request.Below + request.Above;
  KrylovSpace space(this->Factorization, ToPanels(request.Locked, this->Factorization.Order()),
    static_cast<std::uint64_t>(request.Attempt), this->Threads);
  // What it takes as a rule, and never more than what a hopeless band may cost.
  const double expected = 2.0 * static_cast<double>(count) + 100.0;
  const Index limit =
    std::min(this->Factorization.Size() - request.Locked.cols() - PanelWidth, 5 * count + 200);
  Index nextCheck = count + std::max<Index>(count / 2, 4 * PanelWidth);
  RitzPairs ritz;
  std::vector<Index> wanted;
  std::vector<Index> open;
  for (bool done = false; !done;)
  {
    const bool extended = space.Extend();
    progress.Report(0.9 * std::min(1.0, static_cast<double>(space.Size()) / expected));
    const bool last = !extended || space.Size() >= limit;
    if (!last && space.Size() < nextCheck)
    {
      continue;
    }
    ritz = SolveProjected(space);
    wanted = WantedPairs(ritz.Theta, request);
    open = OpenPairs(ritz, wanted, this->Shift, request.Tolerance);
    done = last || (open.empty() && static_cast<Index>(wanted.size()) == count);
    nextCheck = space.Size() + std::max<Index>(PanelWidth, static_cast<Index>(open.size()) / 2);
  }
  wanted.erase(std::remove_if(wanted.begin(), wanted.end(),
                 [&open](Index k) { return std::find(open.begin(), open.end(), k) != open.end(); }),
    wanted.end());
  Band band = this->Polished(space, ritz, wanted);
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
Band BlockLanczos::Polished(const KrylovSpace& space, const RitzPairs& ritz,
  const std::vector<Index>& kept) const
{
  const auto count = static_cast<Index>(kept.size());
  Eigen::MatrixXd coefficients(space.Size(), count);
  for (Index i = 0; i < count; ++i)
  {
    const Index k = kept[static_cast<std::size_t>(i)];
    coefficients.col(i) = ritz.Coefficients.col(k) / ritz.Theta[k];
  }
  Panels vectors = space.Combine(coefficients);
  this->Factorization.SolveWithMass(vectors, this->Tight, this->Threads);

  const Eigen::VectorXd values = this->RayleighQuotients(vectors).head(count);
  Eigen::MatrixXd foreign = Eigen::MatrixXd::Zero(PanelWidth * static_cast<Index>(vectors.size()),
    PanelWidth * static_cast<Index>(vectors.size()));
  foreign.topLeftCorner(count, count) =
    ForeignShares(this->Gram(this->Factorization.Stiffness(), vectors),
      this->Gram(this->Factorization.Mass(), vectors), values);
  const Panels before = vectors;
  for (std::size_t k = 0; k < vectors.size(); ++k)
  {
    SubtractPanels(before, foreign.middleCols(PanelWidth * static_cast<Index>(k), PanelWidth),
      vectors[k], this->Threads);
  }
  Band band;
  for (Index i = 0; i < count; ++i)
  {
    band.Values.push_back(values[i]);
    band.Vectors.emplace_back(ColumnOf(vectors, i, this->Factorization.Order()));
  }
  return band;
}

// V^T A V
Eigen::MatrixXd BlockLanczos::Gram(const Eigen::SparseMatrix<double>& a,
  const Panels& vectors) const
{
  const Index size = PanelWidth * static_cast<Index>(vectors.size());
  Eigen::MatrixXd gram(size, size);
  Panel product;
  for (std::size_t k = 0; k < vectors.size(); ++k)
  {
    MultiplyPanel(a, vectors[k], product, this->Threads);
    gram.middleCols(PanelWidth * static_cast<Index>(k), PanelWidth) =
      ProjectPanel(vectors, product, this->Threads);
  }
  return gram;
}

// v^T S v / v^T M v
Eigen::VectorXd BlockLanczos::RayleighQuotients(const Panels& vectors) const
{
  Eigen::VectorXd quotients(PanelWidth * static_cast<Index>(vectors.size()));
  Panel product;
  for (std::size_t k = 0; k < vectors.size(); ++k)
  {
    MultiplyPanel(this->Factorization.Stiffness(), vectors[k], product, this->Threads);
    const Eigen::VectorXd energy = vectors[k].cwiseProduct(product).colwise().sum();
    MultiplyPanel(this->Factorization.Mass(), vectors[k], product, this->Threads);
    const Eigen::VectorXd norm = vectors[k].cwiseProduct(product).colwise().sum();
    quotients.segment(PanelWidth * static_cast<Index>(k), PanelWidth) = energy.cwiseQuotient(norm);
  }
  return quotients;
}

void BlockLanczos::LeaveOutInaccurate(Band& band, double tolerance) const
{
  Band kept;
  for (std::size_t k = 0; k < band.Values.size(); ++k)
  {
    const Eigen::VectorXd value = Eigen::VectorXd::Constant(1, band.Values[k]);
    const auto& [stiffness, mass, kernel, rank] = this->Problem;
    const double residual = RelativeResiduals(stiffness, mass, 1.0, value, band.Vectors[k])[0];
    if (residual <= tolerance ||
      residual <= tolerance + ResidualFloors(stiffness, mass, 1.0, value, band.Vectors[k])[0])
    {
      kept.Values.push_back(band.Values[k]);
      kept.Vectors.push_back(std::move(band.Vectors[k]));
    }
  }
  band = std::move(kept);
}

} // namespace

EigenPairs BlockLanczosEigensolver::Solve(const EigenProblem& problem,
  const EigensolverOptions& options, const Progress& progress) const
{
  // Starting a thread costs more than it saves on few rows.
  const Index useful = problem.Stiffness.rows() / (4 * RowsPerChunk);
  const auto threads = static_cast<int>(std::clamp<Index>(useful, 1, std::max(1, options.Threads)));
  BlockLanczos solver(problem, options.Tolerance, threads);
  return SolveByBands(problem, options, solver, progress);
}

} // namespace spectralwatermark

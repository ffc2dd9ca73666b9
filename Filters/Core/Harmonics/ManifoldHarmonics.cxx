// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Harmonics/ManifoldHarmonics.h"

#include "Core/Eigensolver/BlockLanczos.h"
#include "Core/Eigensolver/DenseSolver.h"
#include "Core/Eigensolver/Eigensolver.h"
#include "Core/Eigensolver/Residuals.h"
#include "Core/Eigensolver/SpectraSolver.h"
#include "Core/Support/MemoryBudget.h"
#include "Core/Support/Text.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

namespace spectralwatermark
{

namespace
{

// Number of vertices up to which a dense solver takes a fraction of a second. A Krylov space would
// be too small there.
constexpr Index SmallProblem = 400;

// Number of vertices up to which a dense solver is acceptable where nothing else works: it takes
// half a minute.
constexpr Index MostDense = 2500;

// Relative distance to the largest entry within which an entry counts as equal to it when the sign
// is chosen. The sign of a symmetric harmonic then does not depend on rounding.
constexpr double SignTie = 1e-6;

// Largest relative residual of a basis that is adopted. It is far above the loss from storage in
// double, and far below the effect of any real change of shape.
constexpr double AdoptionTolerance = 1e-6;

// Number of vertices up to which the dense solver may be chosen by name: its five matrices then
// take 4 GB.
constexpr Index LargestDense = 10000;

// Chooses the fastest solver that is safe. A Krylov space must not grow beyond the `rank` vertices
// with mass, and a block method's space reaches that limit first. Near the limit, one vector at a
// time is safer and as fast. Where the rank hardly exceeds the number of wanted harmonics, only the
// dense solver works.
SolverChoice ChooseSolver(Index vertices, Index rank, Index wanted)
{
  const bool isTight = wanted > vertices / 2 || (rank < 4 * wanted + 100 && vertices <= MostDense);
  if (vertices <= SmallProblem || isTight)
  {
    return SolverChoice::Dense;
  }
  return rank < 5 * wanted + 1000 ? SolverChoice::Spectra : SolverChoice::BlockLanczos;
}

std::unique_ptr<Eigensolver> CreateSolver(SolverChoice choice, Index vertices)
{
  switch (choice)
  {
    case SolverChoice::Spectra:
      return std::make_unique<SpectraSolver>();
    case SolverChoice::Dense:
      if (vertices > LargestDense)
      {
        throw InvalidInput("Solver",
          "the dense solver is limited to " + std::to_string(LargestDense) +
            " vertices, and this mesh has " + std::to_string(vertices),
          "let the solver be chosen automatically");
      }
      return std::make_unique<DenseSolver>();
    default:
      return std::make_unique<BlockLanczosSolver>();
  }
}

void CheckCount(const HarmonicsOptions& options, Index available)
{
  if (options.Count < 1)
  {
    throw InvalidInput("Count", "no harmonic was requested", "ask for at least one");
  }
  if (options.Count > available)
  {
    throw InvalidInput("Count",
      std::to_string(options.Count) + " harmonics were requested, but the mesh has only " +
        std::to_string(available) + " distinct vertices with area, and no more harmonics than that",
      "ask for fewer, or subdivide the mesh");
  }
}

// The peak memory of a solver, in bytes. Testing/Benchmark/memory measures the constants.
// Testing/Benchmark/solvers/scaling.csv has the peak for scans.
double MemoryOf(SolverChoice choice, Index vertices, Index count)
{
  // Bytes per vertex of the factors and their computation.
  constexpr double factorBytesPerVertex = 3900.0;
  // Bytes per vertex and harmonic of its vector and the Lanczos vectors of its band.
  constexpr double vectorBytesPerVertex = 17.0;
  // Bytes per entry of the dense solver's five matrices.
  constexpr double bytesPerDenseEntry = 5.0 * sizeof(double);
  const auto n = static_cast<double>(vertices);
  if (choice == SolverChoice::Dense)
  {
    return bytesPerDenseEntry * n * n;
  }
  return n * (factorBytesPerVertex + vectorBytesPerVertex * static_cast<double>(count));
}

constexpr const char* FewerHarmonics =
  "ask for fewer harmonics (or bits), or simplify the mesh first";

double BytesOfBasis(Index vertices, Index count)
{
  return sizeof(double) * static_cast<double>(vertices * count);
}

std::string Work(Index vertices, Index count)
{
  return std::to_string(count) + " harmonics of " + std::to_string(vertices) + " vertices";
}

void RequireMemoryFor(SolverChoice choice, Index vertices, Index count, Index otherBases)
{
  RequireMemory(MemoryOf(choice, vertices, count) +
      static_cast<double>(otherBases) * BytesOfBasis(vertices, count),
    Work(vertices, count),
    choice == SolverChoice::Dense ? "choose another solver, or simplify the mesh first"
                                  : FewerHarmonics);
}

void FixSigns(Eigen::MatrixXd& basis)
{
  for (Index k = 0; k < basis.cols(); ++k)
  {
    const double threshold = (1.0 - SignTie) * basis.col(k).cwiseAbs().maxCoeff();
    Index first = 0;
    while (first < basis.rows() - 1 && std::abs(basis(first, k)) < threshold)
    {
      ++first;
    }
    if (basis(first, k) < 0.0)
    {
      basis.col(k) *= -1.0;
    }
  }
}

std::string Scientific(double value)
{
  return TextOf(std::scientific, std::setprecision(1), value);
}

std::string SolverAdvice(const HarmonicsOptions& options)
{
  return options.Solver == SolverChoice::Automatic ? ""
                                                   : "let the solver be chosen automatically, ";
}

void CheckConvergence(const EigenProblem& problem, const EigenPairs& pairs,
  const HarmonicsOptions& options)
{
  if (!pairs.Complete)
  {
    throw SolverFailure("only " + std::to_string(pairs.Values.size()) + " of " +
        std::to_string(options.Count) + " harmonics could be computed completely",
      SolverAdvice(options) + "ask for fewer, or for another band size");
  }
  Index failed = 0;
  for (Index k = 0; k < pairs.Values.size(); ++k)
  {
    if (pairs.Residuals[k] > options.Tolerance)
    {
      const double floor = ResidualFloors(problem.Stiffness, problem.Mass, 1.0,
        pairs.Values.segment(k, 1), pairs.Vectors.col(k))[0];
      failed += pairs.Residuals[k] > options.Tolerance + floor ? 1 : 0;
    }
  }
  if (failed > 0)
  {
    throw SolverFailure(std::to_string(failed) + " of " + std::to_string(options.Count) +
        " harmonics have a residual over the tolerance (largest " +
        Scientific(pairs.Residuals.maxCoeff()) + ")",
      "raise the tolerance, or remove the mesh's thinnest triangles");
  }
}

// Sorts the pairs by eigenvalue and clamps eigenvalues at 0; the kernel stays in front. Rounding
// puts repeated eigenvalues in any order, and makes some negative where parts of a mesh are barely
// connected.
void Sort(EigenPairs& pairs, Index kernel)
{
  pairs.Values = pairs.Values.cwiseMax(0.0).eval();
  std::vector<Index> order(pairs.Values.size());
  std::iota(order.begin(), order.end(), Index{ 0 });
  std::stable_sort(order.begin() + std::min(kernel, pairs.Values.size()), order.end(),
    [&pairs](Index a, Index b) { return pairs.Values[a] < pairs.Values[b]; });
  if (!std::is_sorted(order.begin(), order.end()))
  {
    pairs.Values = pairs.Values(order).eval();
    pairs.Residuals = pairs.Residuals(order).eval();
    pairs.Vectors = pairs.Vectors(Eigen::all, order).eval();
  }
}

} // namespace

void RequireMemoryForHarmonics(Index vertices, Index count, Index otherBases)
{
  RequireMemoryFor(ChooseSolver(vertices, vertices, count), vertices, count, otherBases);
}

ManifoldHarmonics ComputeManifoldHarmonics(const TriangleMesh& mesh,
  const HarmonicsOptions& options, const Progress& progress)
{
  progress.Report(0.0);
  LaplaceOperator op = AssembleLaplaceOperator(mesh, options.Mass);
  CheckCount(options, op.Rank);

  // The solver sees a surface of area 1.
  const double area = op.Area;
  const SparseMatrix unitMass = op.Mass / area;
  const Eigen::MatrixXd unitKernel = op.Kernel * std::sqrt(area);
  const EigenProblem problem{ op.Stiffness, unitMass, unitKernel, op.Rank };
  EigensolverOptions solverOptions;
  solverOptions.Count = options.Count;
  solverOptions.BandSize = options.BandSize;
  solverOptions.Tolerance = options.Tolerance;
  solverOptions.Threads = options.Threads;
  WarmStart initialGuess;
  if (options.InitialGuess != nullptr &&
    options.InitialGuess->Basis.rows() == mesh.NumberOfVertices())
  {
    initialGuess.Values =
      options.InitialGuess->Eigenvalues * options.InitialGuess->VertexMass.sum();
    initialGuess.Vectors = &options.InitialGuess->Basis;
    initialGuess.Order = options.InitialGuess->Elimination;
    solverOptions.InitialGuess = &initialGuess;
  }
  const SolverChoice choice = options.Solver == SolverChoice::Automatic
    ? ChooseSolver(mesh.NumberOfVertices(), op.Rank, options.Count)
    : options.Solver;
  const std::unique_ptr<Eigensolver> solver = CreateSolver(choice, mesh.NumberOfVertices());
  if (options.CheckMemory)
  {
    RequireMemoryFor(choice, mesh.NumberOfVertices(), options.Count, 0);
  }
  EigenPairs pairs = solver->Solve(problem, solverOptions, progress.Part(0.02, 0.98));
  CheckConvergence(problem, pairs, options);
  Sort(pairs, op.Kernel.cols());

  ManifoldHarmonics harmonics;
  harmonics.Eigenvalues = pairs.Values / area;
  harmonics.Basis = std::move(pairs.Vectors);
  harmonics.Basis /= std::sqrt(area);
  FixSigns(harmonics.Basis);
  harmonics.Residuals = std::move(pairs.Residuals);
  harmonics.VertexMass = std::move(op.VertexMass);
  harmonics.Mass.swap(op.Mass);
  harmonics.KernelDimension = op.Kernel.cols();
  harmonics.Elimination = std::move(pairs.Order);
  harmonics.Complete = pairs.Complete;
  progress.Report(1.0);
  return harmonics;
}

void RequireMemoryToAdopt(Index vertices, Index count)
{
  // The peak memory, in bases: the copy and the products of its checks. Testing/Benchmark/memory
  // measures it.
  constexpr double basesAtPeak = 3.4;
  RequireMemory(basesAtPeak * BytesOfBasis(vertices, count), Work(vertices, count), FewerHarmonics);
}

std::optional<ManifoldHarmonics> AdoptManifoldHarmonics(const TriangleMesh& mesh, MassMatrix mass,
  Eigen::VectorXd eigenvalues, Eigen::MatrixXd basis, const Eigen::VectorXd& vertexMass)
{
  if (basis.cols() != eigenvalues.size() || basis.rows() != mesh.NumberOfVertices() ||
    vertexMass.size() != mesh.NumberOfVertices() || !basis.allFinite() || !eigenvalues.allFinite())
  {
    return std::nullopt;
  }
  LaplaceOperator op = AssembleLaplaceOperator(mesh, mass);
  if (!((op.VertexMass - vertexMass).norm() <= AdoptionTolerance * op.VertexMass.norm()))
  {
    return std::nullopt;
  }
  Eigen::VectorXd residuals = RelativeResiduals(op.Stiffness, op.Mass, op.Area, eigenvalues, basis);
  const Eigen::VectorXd norms = basis.cwiseProduct(op.Mass * basis).colwise().sum();
  if (!(residuals.maxCoeff() <= AdoptionTolerance) ||
    !((norms.array() - 1.0).abs().maxCoeff() <= AdoptionTolerance))
  {
    return std::nullopt;
  }
  ManifoldHarmonics harmonics;
  harmonics.Eigenvalues = std::move(eigenvalues);
  harmonics.Basis = std::move(basis);
  harmonics.Residuals = std::move(residuals);
  harmonics.VertexMass = std::move(op.VertexMass);
  harmonics.Mass.swap(op.Mass);
  harmonics.KernelDimension = op.Kernel.cols();
  return harmonics;
}

} // namespace spectralwatermark

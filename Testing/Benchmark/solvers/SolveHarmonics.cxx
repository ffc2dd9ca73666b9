// SPDX-License-Identifier: BSD-3-Clause
// Times one eigensolver on one mesh and prints a line of JSON; compare_solvers.py drives it.
//
//     SolveHarmonics MESH.ply HARMONICS [--solver NAME] [--threads N] [--subdivide N]
//                    [--band N] [--matrices FOLDER] [--values FILE] [--warm]
//
// --solver     block-lanczos (default) or spectra
// --subdivide  each triangle into four, N times
// --band       harmonics per band; by default the solver chooses
// --matrices   writes stiffness.mtx and mass.mtx (Matrix Market), for other programs to solve
// --values     writes the eigenvalues, one a line
// --warm       solves a slightly deformed mesh as well, from this one's basis and without it
#include "Benchmark/BenchmarkMesh.h"
#include "Core/Eigensolver/BlockLanczos.h"
#include "Core/Eigensolver/Eigensolver.h"
#include "Core/Eigensolver/Residuals.h"
#include "Core/Eigensolver/SpectraSolver.h"
#include "Core/Harmonics/LaplaceOperator.h"
#include "Core/Support/Progress.h"

#include <unsupported/Eigen/SparseExtra>

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <functional>
#include <iomanip>
#include <iostream>
#include <limits>
#include <memory>
#include <string>

namespace sw = spectralwatermark;

namespace
{

struct Arguments
{
  std::string Mesh;
  sw::Index Harmonics = 100;
  std::string Solver = "block-lanczos";
  int Threads = 2;
  int Subdivisions = 0;
  sw::Index Band = 0;
  std::string MatrixFolder;
  std::string ValuesFile;
  bool Warm = false;
};

Arguments Parse(int argc, char** argv)
{
  if (argc < 3)
  {
    throw std::invalid_argument("a mesh and a number of harmonics are needed");
  }
  Arguments arguments;
  arguments.Mesh = argv[1];
  arguments.Harmonics = std::stol(argv[2]);
  for (int i = 3; i < argc; ++i)
  {
    const std::string option = argv[i];
    if (option == "--warm")
    {
      arguments.Warm = true;
      continue;
    }
    if (i + 1 == argc)
    {
      throw std::invalid_argument(option + " needs a value");
    }
    const std::string value = argv[++i];
    if (option == "--solver" && (value == "block-lanczos" || value == "spectra"))
    {
      arguments.Solver = value;
    }
    else if (option == "--threads")
    {
      arguments.Threads = std::stoi(value);
    }
    else if (option == "--subdivide")
    {
      arguments.Subdivisions = std::stoi(value);
    }
    else if (option == "--band")
    {
      arguments.Band = std::stol(value);
    }
    else if (option == "--matrices")
    {
      arguments.MatrixFolder = value;
    }
    else if (option == "--values")
    {
      arguments.ValuesFile = value;
    }
    else
    {
      throw std::invalid_argument("unknown: " + option + " " + value);
    }
  }
  return arguments;
}

// What a solver sees: a surface of area 1.
struct Problem
{
  explicit Problem(const sw::TriangleMesh& mesh)
    : Operator(sw::AssembleLaplaceOperator(mesh, sw::MassMatrix::Lumped))
    , Mass(Operator.Mass / Operator.Area)
    , Kernel(Operator.Kernel * std::sqrt(Operator.Area))
  {
  }
  sw::EigenProblem View() const
  {
    return { this->Operator.Stiffness, this->Mass, this->Kernel, this->Operator.Rank };
  }

  sw::LaplaceOperator Operator;
  sw::SparseMatrix Mass;
  Eigen::MatrixXd Kernel;
};

double Now()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// What a user who watches the progress, and wants to abort, would notice.
class Watch
{
public:
  bool operator()(double fraction)
  {
    const double now = Now();
    this->LongestSilence = std::max(this->LongestSilence, now - this->LastTime);
    this->Rises = this->Rises && fraction >= this->LastFraction;
    this->LastTime = now;
    this->LastFraction = fraction;
    return true;
  }

  double LongestSilence = 0.0; // an abort is answered at the next report
  double LastFraction = 0.0;
  bool Rises = true;

private:
  double LastTime = Now();
};

sw::EigenPairs Solve(const Problem& problem, const Arguments& arguments,
  const sw::WarmStart* nearby, double& seconds, Watch& watch)
{
  std::unique_ptr<sw::Eigensolver> solver = std::make_unique<sw::BlockLanczosSolver>();
  if (arguments.Solver == "spectra")
  {
    solver = std::make_unique<sw::SpectraSolver>();
  }
  sw::EigensolverOptions options;
  options.Count = arguments.Harmonics;
  options.Threads = arguments.Threads;
  options.InitialGuess = nearby;
  options.BandSize = arguments.Band;
  const double started = Now();
  sw::EigenPairs pairs = solver->Solve(problem.View(), options, sw::Progress(std::ref(watch)));
  watch(watch.LastFraction); // the silence at the end counts as well
  seconds = Now() - started;
  return pairs;
}

// Of 300 columns at most, which tells as much and does not take longer than the solve.
double OrthonormalityError(const Problem& problem, const Eigen::MatrixXd& vectors)
{
  const sw::Index stride = (vectors.cols() + 299) / 300;
  Eigen::MatrixXd some(vectors.rows(), (vectors.cols() + stride - 1) / stride);
  for (sw::Index k = 0; k < some.cols(); ++k)
  {
    some.col(k) = vectors.col(k * stride);
  }
  const Eigen::MatrixXd gram = some.transpose() * (problem.Mass * some);
  return (gram - Eigen::MatrixXd::Identity(gram.rows(), gram.cols())).cwiseAbs().maxCoeff();
}

// What rounding may leave of any residual, whichever solver it is.
double LargestRounding(const Problem& problem, const sw::EigenPairs& pairs)
{
  double largest = 0.0;
  for (sw::Index k = 0; k < pairs.Values.size(); ++k)
  {
    largest = std::max(largest,
      sw::ResidualFloors(problem.Operator.Stiffness, problem.Mass, 1.0, pairs.Values.segment(k, 1),
        pairs.Vectors.col(k))[0]);
  }
  return largest;
}

double PeakMebibytes()
{
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

// As much as a watermark moves vertices: a smooth change along the middle harmonics.
sw::TriangleMesh Deformed(const sw::TriangleMesh& mesh, const sw::EigenPairs& pairs)
{
  sw::TriangleMesh deformed = mesh;
  const double size = (mesh.Points.colwise().maxCoeff() - mesh.Points.colwise().minCoeff()).norm();
  for (sw::Index k = 20; k < std::min<sw::Index>(70, pairs.Vectors.cols()); ++k)
  {
    for (sw::Index axis = 0; axis < 3; ++axis)
    {
      const double sign = (7 * k + 3 * axis) % 2 == 0 ? 1.0 : -1.0;
      deformed.Points.col(axis) += sign * 1e-4 * size * pairs.Vectors.col(k);
    }
  }
  return deformed;
}

void PrintWarm(const sw::TriangleMesh& mesh, const sw::EigenPairs& pairs,
  const Arguments& arguments)
{
  const Problem deformed(Deformed(mesh, pairs));
  const sw::WarmStart nearby{ pairs.Values, &pairs.Vectors, pairs.Order };
  double warm = 0.0;
  double cold = 0.0;
  Watch watch;
  const sw::EigenPairs fast = Solve(deformed, arguments, &nearby, warm, watch);
  const sw::EigenPairs slow = Solve(deformed, arguments, nullptr, cold, watch);
  std::cout << ", \"warm_seconds\": " << warm << ", \"cold_seconds\": " << cold
            << ", \"warm_residual\": " << fast.Residuals.maxCoeff() << ", \"warm_disagreement\": "
            << ((fast.Values - slow.Values).array() / (1.0 + slow.Values.array())).abs().maxCoeff();
}

void Run(const Arguments& arguments)
{
  const sw::TriangleMesh mesh = sw::benchmark::ReadMesh(arguments.Mesh, arguments.Subdivisions);
  const double started = Now();
  const Problem problem(mesh);
  const double assembly = Now() - started;
  if (!arguments.MatrixFolder.empty())
  {
    Eigen::saveMarket(problem.Operator.Stiffness, arguments.MatrixFolder + "/stiffness.mtx");
    Eigen::saveMarket(problem.Mass, arguments.MatrixFolder + "/mass.mtx");
  }
  double seconds = 0.0;
  Watch watch;
  const sw::EigenPairs pairs = Solve(problem, arguments, nullptr, seconds, watch);
  const double peak = PeakMebibytes();
  if (!arguments.ValuesFile.empty())
  {
    std::ofstream(arguments.ValuesFile)
      << std::setprecision(std::numeric_limits<double>::max_digits10) << pairs.Values << "\n";
  }
  std::cout << "{\"vertices\": " << mesh.NumberOfVertices()
            << ", \"triangles\": " << mesh.NumberOfTriangles()
            << ", \"harmonics\": " << pairs.Values.size() << ", \"assembly\": " << assembly
            << ", \"seconds\": " << seconds << ", \"bands\": " << pairs.Bands
            << ", \"complete\": " << (pairs.Complete ? "true" : "false")
            << ", \"residual\": " << pairs.Residuals.maxCoeff()
            << ", \"rounding\": " << LargestRounding(problem, pairs)
            << ", \"orthonormality\": " << OrthonormalityError(problem, pairs.Vectors)
            << ", \"peak_mib\": " << peak << ", \"longest_silence\": " << watch.LongestSilence
            << ", \"progress_rises\": " << (watch.Rises ? "true" : "false")
            << ", \"last_progress\": " << watch.LastFraction;
  if (arguments.Warm)
  {
    PrintWarm(mesh, pairs, arguments);
  }
  std::cout << "}" << std::endl;
}

} // namespace

int main(int argc, char** argv)
{
  try
  {
    Run(Parse(argc, argv));
    return 0;
  }
  catch (const std::exception& error)
  {
    std::cerr << "SolveHarmonics: " << error.what() << "\n";
    return 2;
  }
}

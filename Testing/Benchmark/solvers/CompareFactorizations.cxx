// SPDX-License-Identifier: BSD-3-Clause
// Times the factorisations that Debian ships on the shifted Laplacian of a mesh: analysis,
// numerical factorisation, and a solve for eight right-hand sides. Medians of a few runs.
//
//     CompareFactorizations MESH.ply [SUBDIVISIONS [RUNS]]
//
// The shift lies inside the spectrum, so the matrix is indefinite: a Cholesky factorisation
// (CHOLMOD's supernodal one) is timed with a shift below it, which a solver with spectrum slicing
// cannot do with.
#include "Benchmark/BenchmarkMesh.h"
#include "Core/Harmonics/LaplaceOperator.h"
#include "Core/LinearAlgebra/MultiVector.h"
#include "Core/LinearAlgebra/ShiftedFactorization.h"

#include <Eigen/SparseCholesky>

#ifdef HAVE_CHOLMOD
#include <Eigen/CholmodSupport>
#endif
#ifdef HAVE_SUPERLU
#include <Eigen/SuperLUSupport>
#endif
#ifdef HAVE_MUMPS
#include <dmumps_c.h>
#endif

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace sw = spectralwatermark;

namespace
{

using Block = Eigen::Matrix<double, Eigen::Dynamic, 8>;

double Now()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double Median(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

// Analyse, factorise, solve: each is called in turn, on a fresh object for each run.
struct Candidate
{
  std::function<void()> Analyze;
  std::function<void()> Factorize;
  std::function<Block(const Block&)> Solve;
};

void Time(const std::string& name, const sw::SparseMatrix& matrix, int runs,
  const std::function<Candidate()>& create)
{
  std::vector<double> analysis;
  std::vector<double> factorisation;
  std::vector<double> solve;
  const Block right = Block::Random(matrix.rows(), 8);
  double error = 0.0;
  for (int run = 0; run < runs; ++run)
  {
    const Candidate candidate = create();
    const double started = Now();
    candidate.Analyze();
    const double analyzed = Now();
    candidate.Factorize();
    const double factorized = Now();
    const Block x = candidate.Solve(right);
    const double solved = Now();
    analysis.push_back(analyzed - started);
    factorisation.push_back(factorized - analyzed);
    solve.push_back(solved - factorized);
    error = (matrix * x - right).norm() / right.norm();
  }
  std::printf("%-42s analysis %7.3f s  factorisation %7.3f s  solve %8.4f s  error %.0e\n",
    name.c_str(), Median(analysis), Median(factorisation), Median(solve), error);
  std::fflush(stdout);
}

template <typename Solver>
Candidate OfEigen(const sw::SparseMatrix& matrix)
{
  const auto solver = std::make_shared<Solver>();
  return { [=, &matrix]() { solver->analyzePattern(matrix); },
    [=, &matrix]() { solver->factorize(matrix); },
    [=](const Block& right) -> Block { return solver->solve(right); } };
}

Candidate Ours(const sw::SparseMatrix& stiffness, const sw::SparseMatrix& mass, double shift,
  int threads)
{
  const auto factorization = std::make_shared<std::unique_ptr<sw::ShiftedFactorization>>();
  return { [=, &stiffness, &mass]()
    { *factorization = std::make_unique<sw::ShiftedFactorization>(stiffness, mass); },
    [=]() { (*factorization)->Factorize(shift, threads); },
    [=](const Block& right) -> Block
    {
      sw::MultiVector x = sw::ToMultiVector(right, (*factorization)->Order());
      (*factorization)->Solve(x[0], threads);
      return sw::TakeColumns(std::move(x), { 0, 1, 2, 3, 4, 5, 6, 7 }, (*factorization)->Order(),
        1);
    } };
}

#ifdef HAVE_MUMPS
// LDL^T of the lower triangle, ordered by METIS.
struct Mumps
{
  explicit Mumps(const sw::SparseMatrix& matrix)
  {
    for (sw::Index j = 0; j < matrix.cols(); ++j)
    {
      for (sw::SparseMatrix::InnerIterator entry(matrix, j); entry; ++entry)
      {
        if (entry.row() >= j)
        {
          this->Rows.push_back(static_cast<int>(entry.row()) + 1);
          this->Columns.push_back(static_cast<int>(j) + 1);
          this->Values.push_back(entry.value());
        }
      }
    }
    this->Id.par = 1;
    this->Id.sym = 2;
    this->Id.comm_fortran = -987654;
    this->Run(-1);
    std::fill(this->Id.icntl, this->Id.icntl + 4, 0); // silent
    this->Id.icntl[6] = 5;                            // METIS
    this->Id.icntl[13] = 50;                          // % of extra room
    this->Id.n = static_cast<int>(matrix.rows());
    this->Id.nnz = static_cast<MUMPS_INT8>(this->Values.size());
    this->Id.irn = this->Rows.data();
    this->Id.jcn = this->Columns.data();
    this->Id.a = this->Values.data();
  }
  ~Mumps() { this->Run(-2); }
  void Run(int job)
  {
    this->Id.job = job;
    dmumps_c(&this->Id);
  }
  Block Solve(Block x)
  {
    this->Id.rhs = x.data();
    this->Id.nrhs = 8;
    this->Id.lrhs = this->Id.n;
    this->Run(3);
    return x;
  }

  DMUMPS_STRUC_C Id{};
  std::vector<int> Rows;
  std::vector<int> Columns;
  std::vector<double> Values;
};

Candidate OfMumps(const sw::SparseMatrix& matrix)
{
  const auto mumps = std::make_shared<Mumps>(matrix);
  return { [=]() { mumps->Run(1); }, [=]() { mumps->Run(2); },
    [=](const Block& right) { return mumps->Solve(right); } };
}
#endif

} // namespace

int main(int argc, char** argv)
{
  if (argc < 2)
  {
    std::fprintf(stderr, "usage: CompareFactorizations MESH.ply [SUBDIVISIONS [RUNS]]\n");
    return 2;
  }
  const sw::TriangleMesh mesh = sw::benchmark::ReadMesh(argv[1], argc > 2 ? std::atoi(argv[2]) : 0);
  const int runs = argc > 3 ? std::atoi(argv[3]) : 5;
  const sw::LaplaceOperator op = sw::AssembleLaplaceOperator(mesh, sw::MassMatrix::Lumped);
  const sw::SparseMatrix mass = op.Mass / op.Area;
  const double shift = 600.0; // by Weyl's law, after some fifty eigenvalues
  const sw::SparseMatrix indefinite = op.Stiffness - shift * mass;
  std::printf("%ld vertices, medians of %d\n", static_cast<long>(mesh.NumberOfVertices()), runs);

  using Simplicial = Eigen::SimplicialLDLT<sw::SparseMatrix>;
  Time("this library: LDL^T, METIS, 1 thread", indefinite, runs,
    [&]() { return Ours(op.Stiffness, mass, shift, 1); });
  Time("this library: LDL^T, METIS, 2 threads", indefinite, runs,
    [&]() { return Ours(op.Stiffness, mass, shift, 2); });
  Time("Eigen SimplicialLDLT, AMD", indefinite, runs,
    [&]() { return OfEigen<Simplicial>(indefinite); });
#ifdef HAVE_MUMPS
  Time("MUMPS: LDL^T, METIS", indefinite, runs, [&]() { return OfMumps(indefinite); });
#endif
#ifdef HAVE_SUPERLU
  Time("SuperLU: LU, COLAMD", indefinite, runs,
    [&]() { return OfEigen<Eigen::SuperLU<sw::SparseMatrix>>(indefinite); });
#endif
#ifdef HAVE_CHOLMOD
  const sw::SparseMatrix definite = op.Stiffness + mass;
  Time("CHOLMOD: simplicial LDL^T", indefinite, runs,
    [&]() { return OfEigen<Eigen::CholmodSimplicialLDLT<sw::SparseMatrix>>(indefinite); });
  Time("CHOLMOD: supernodal LL^T, positive definite", definite, runs,
    [&]() { return OfEigen<Eigen::CholmodSupernodalLLT<sw::SparseMatrix>>(definite); });
#endif
  return 0;
}

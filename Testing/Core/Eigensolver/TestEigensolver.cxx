// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Eigensolver/BlockLanczos.h"
#include "Core/Eigensolver/DenseSolver.h"
#include "Core/Eigensolver/Eigensolver.h"
#include "Core/Eigensolver/SpectraSolver.h"
#include "Core/Eigensolver/SpectrumSlicing.h"
#include "Core/Harmonics/LaplaceOperator.h"
#include "Core/LinearAlgebra/MultiVector.h"
#include "Core/Support/Errors.h"
#include "Core/Support/Progress.h"
#include "Support/Shapes.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

using namespace spectralwatermark;

namespace
{

// The problem of a mesh, scaled to unit area as the interface asks.
struct OwnedProblem
{
  explicit OwnedProblem(const TriangleMesh& mesh, MassMatrix kind = MassMatrix::Lumped)
  {
    LaplaceOperator op = AssembleLaplaceOperator(mesh, kind);
    this->Stiffness = op.Stiffness;
    this->Mass = op.Mass / op.Area;
    this->Kernel = op.Kernel * std::sqrt(op.Area);
    this->Rank = op.Rank;
  }
  OwnedProblem() = default;

  EigenProblem View() const { return { this->Stiffness, this->Mass, this->Kernel, this->Rank }; }

  SparseMatrix Stiffness;
  SparseMatrix Mass;
  Eigen::MatrixXd Kernel;
  Index Rank = 0;
};

// The unit square with opposite sides glued: a flat torus of area 1. No such surface lies in
// space, but its matrices come from the square's by adding what is glued.
OwnedProblem FlatTorus(Index cells)
{
  const TriangleMesh square = shapes::Rectangle(cells, cells, 1.0, 1.0);
  const LaplaceOperator op = AssembleLaplaceOperator(square, MassMatrix::Lumped);
  SparseMatrix glue(square.NumberOfVertices(), cells * cells);
  for (Index j = 0; j <= cells; ++j)
  {
    for (Index i = 0; i <= cells; ++i)
    {
      glue.insert(j * (cells + 1) + i, (j % cells) * cells + i % cells) = 1.0;
    }
  }
  OwnedProblem torus;
  torus.Stiffness = glue.transpose() * op.Stiffness * glue;
  torus.Mass = glue.transpose() * op.Mass * glue;
  torus.Kernel = Eigen::MatrixXd::Ones(cells * cells, 1);
  torus.Rank = cells * cells;
  return torus;
}

// 4 pi^2 (i^2 + j^2) over all integers, ascending.
std::vector<double> FlatTorusSpectrum(Index count)
{
  std::vector<double> values;
  for (int i = -30; i <= 30; ++i)
  {
    for (int j = -30; j <= 30; ++j)
    {
      values.push_back(4.0 * Pi * Pi * (i * i + j * j));
    }
  }
  std::sort(values.begin(), values.end());
  values.resize(static_cast<std::size_t>(count));
  return values;
}

template <typename Solver>
EigenPairs SolveBanded(const OwnedProblem& problem, Index count, Index bandSize, int threads = 1)
{
  EigensolverOptions options;
  options.Count = count;
  options.BandSize = bandSize;
  options.Threads = threads;
  return Solver().Solve(problem.View(), options, Progress());
}

EigenPairs SolveDense(const OwnedProblem& problem, Index count)
{
  EigensolverOptions options;
  options.Count = count;
  return DenseSolver().Solve(problem.View(), options, Progress());
}

double OrthonormalityError(const OwnedProblem& problem, const EigenPairs& pairs)
{
  const Eigen::MatrixXd gram = pairs.Vectors.transpose() * (problem.Mass * pairs.Vectors);
  return (gram - Eigen::MatrixXd::Identity(gram.rows(), gram.cols())).cwiseAbs().maxCoeff();
}

std::string FailureOf(const Eigensolver& solver, const OwnedProblem& problem)
{
  EigensolverOptions options;
  options.Count = 20;
  try
  {
    solver.Solve(problem.View(), options, Progress());
  }
  catch (const SolverFailure& failure)
  {
    return failure.what();
  }
  return "none";
}

void ExpectSameSpectrum(const Eigen::VectorXd& a, const Eigen::VectorXd& b)
{
  ASSERT_EQ(a.size(), b.size());
  for (Index k = 0; k < a.size(); ++k)
  {
    EXPECT_NEAR(a[k], b[k], 1e-9 * (1.0 + b[k])) << "eigenvalue " << k + 1;
  }
}

// Every solver that works band by band must pass the same tests.
template <typename Solver>
class BandedEigensolvers : public testing::Test
{
};
using BandedSolvers = testing::Types<BlockLanczosSolver, SpectraSolver>;
TYPED_TEST_SUITE(BandedEigensolvers, BandedSolvers);

} // namespace

TYPED_TEST(BandedEigensolvers, AgreeWithDenseOverHalfTheSpectrum)
{
  for (const MassMatrix kind : { MassMatrix::Lumped, MassMatrix::Consistent })
  {
    const OwnedProblem problem(shapes::Bumpy(3), kind);
    const Index count = problem.Rank / 2;
    const EigenPairs banded = SolveBanded<TypeParam>(problem, count, 40);
    const EigenPairs dense = SolveDense(problem, count);
    EXPECT_TRUE(banded.Complete);
    EXPECT_GT(banded.Bands, 4);
    ExpectSameSpectrum(banded.Values, dense.Values);
    EXPECT_LT(OrthonormalityError(problem, banded), 1e-10);
    EXPECT_LT(OrthonormalityError(problem, dense), 1e-10);
    EXPECT_LT(banded.Residuals.maxCoeff(), 1e-8);
    EXPECT_LT(dense.Residuals.maxCoeff(), 1e-8);
  }
}

TEST(Eigensolvers, DenseFindsTheWholeSpectrum)
{
  const OwnedProblem problem(shapes::Bumpy(2));
  const EigenPairs pairs = SolveDense(problem, problem.Rank);
  ASSERT_TRUE(pairs.Complete);
  // A second construction: the symmetric standard problem D^-1/2 S D^-1/2.
  const Eigen::VectorXd scale = Eigen::VectorXd(problem.Mass.diagonal()).cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd standard =
    scale.asDiagonal() * Eigen::MatrixXd(problem.Stiffness) * scale.asDiagonal();
  const Eigen::VectorXd expected = standard.selfadjointView<Eigen::Lower>().eigenvalues();
  EXPECT_LT((pairs.Values - expected).cwiseAbs().maxCoeff(), 1e-10 * expected.maxCoeff());
}

TYPED_TEST(BandedEigensolvers, BandSizeDoesNotChangeTheSpectrum)
{
  const OwnedProblem problem(shapes::Bumpy(4));
  const EigenPairs one = SolveBanded<TypeParam>(problem, 150, 150);
  for (const Index bandSize : { 7, 23, 64 })
  {
    const EigenPairs several = SolveBanded<TypeParam>(problem, 150, bandSize);
    EXPECT_TRUE(several.Complete);
    EXPECT_GT(several.Bands, one.Bands);
    ExpectSameSpectrum(several.Values, one.Values);
    EXPECT_LT(OrthonormalityError(problem, several), 1e-10);
    EXPECT_LT(several.Residuals.maxCoeff(), 1e-8);
  }
}

// The eigenvalues of the flat torus come 4, 8 or 12 at a time: bands must neither lose nor
// repeat one wherever they are cut.
TYPED_TEST(BandedEigensolvers, FlatTorusMultiplicitiesSurviveEveryBandSize)
{
  const OwnedProblem torus = FlatTorus(48);
  const Index count = 121;
  const std::vector<double> expected = FlatTorusSpectrum(count);
  for (const Index bandSize : { 5, 10, 30, 121 })
  {
    const EigenPairs pairs = SolveBanded<TypeParam>(torus, count, bandSize);
    ASSERT_TRUE(pairs.Complete) << "band size " << bandSize;
    EXPECT_LT(OrthonormalityError(torus, pairs), 1e-10);
    for (Index k = 1; k < count; ++k)
    {
      // Second-order error of linear elements, (k h)^2 / 12 of each direction at most.
      EXPECT_NEAR(pairs.Values[k] / expected[static_cast<std::size_t>(k)], 1.0, 0.06)
        << "eigenvalue " << k + 1 << ", band size " << bandSize;
    }
  }
}

// Two identical components: every eigenvalue at least twice, to the last bit.
TYPED_TEST(BandedEigensolvers, IdenticalComponentsDoubleEveryEigenvalue)
{
  const TriangleMesh one = shapes::Bumpy(3);
  const OwnedProblem single(one);
  const OwnedProblem twice(shapes::Union({ one, one }, 4.0));
  const EigenPairs expected = SolveDense(single, 60);
  for (const Index bandSize : { 16, 120 })
  {
    const EigenPairs pairs = SolveBanded<TypeParam>(twice, 120, bandSize);
    ASSERT_TRUE(pairs.Complete);
    for (Index k = 0; k < 120; ++k)
    {
      // Unit area of both together is half of it for each.
      EXPECT_NEAR(pairs.Values[k], 2.0 * expected.Values[k / 2], 1e-8 * (1.0 + pairs.Values[k]))
        << "eigenvalue " << k + 1 << ", band size " << bandSize;
    }
  }
}

// Forty components: a kernel of forty vectors, and clusters of forty copies above it.
TYPED_TEST(BandedEigensolvers, ManyComponents)
{
  const std::vector<TriangleMesh> parts(40, shapes::Icosphere(1));
  const OwnedProblem problem(shapes::Union(parts, 3.0));
  const EigenPairs pairs = SolveBanded<TypeParam>(problem, 200, 0);
  ASSERT_TRUE(pairs.Complete);
  EXPECT_EQ((pairs.Values.array() == 0.0).count(), 40);
  // Next, l = 1 on each of the forty: 120 times the same.
  EXPECT_NEAR(pairs.Values[40], pairs.Values[159], 1e-8 * pairs.Values[40]);
  EXPECT_GT(pairs.Values[160], 2.0 * pairs.Values[159]);
}

// A square whose cells grow by a quarter from one to the next in both directions: areas between
// 1 and 1e8. The spectrum of a square with free edges is pi^2 (i^2 + j^2).
TYPED_TEST(BandedEigensolvers, AreasThatDifferByEightOrders)
{
  const Index cells = 42;
  TriangleMesh mesh = shapes::Rectangle(cells, cells, 1.0, 1.0);
  mesh.Points =
    mesh.Points.unaryExpr([](double x) { return (std::pow(1e4, x) - 1.0) / (1e4 - 1.0); }).eval();
  mesh.Points.col(2).setZero();
  const OwnedProblem problem(mesh);
  const Eigen::VectorXd mass = problem.Mass.diagonal();
  ASSERT_GT(mass.maxCoeff(), 1e7 * mass.minCoeff());
  const EigenPairs pairs = SolveBanded<TypeParam>(problem, 60, 20);
  ASSERT_TRUE(pairs.Complete);
  EXPECT_LT(pairs.Residuals.maxCoeff(), 1e-8);
  EXPECT_LT(OrthonormalityError(problem, pairs), 1e-10);
  EXPECT_NEAR(pairs.Values[1] / (Pi * Pi), 1.0, 0.05);
  EXPECT_NEAR(pairs.Values[2] / (Pi * Pi), 1.0, 0.05);
  EXPECT_NEAR(pairs.Values[3] / (2.0 * Pi * Pi), 1.0, 0.1);
}

// A ribbon a thousand times longer than wide, in triangles as thin: its low frequencies are a
// string's, pi^2 k^2 / length^2.
TYPED_TEST(BandedEigensolvers, Slivers)
{
  const TriangleMesh mesh = shapes::Rectangle(60, 30, 1000.0, 1.0);
  const OwnedProblem problem(mesh);
  const double lengthSquared = 1000.0; // of a ribbon of area 1
  const EigenPairs pairs = SolveBanded<TypeParam>(problem, 12, 0);
  ASSERT_TRUE(pairs.Complete);
  EXPECT_LT(OrthonormalityError(problem, pairs), 1e-10);
  for (Index k = 1; k < 12; ++k)
  {
    const double expected = Pi * Pi * static_cast<double>(k * k) / lengthSquared;
    EXPECT_NEAR(pairs.Values[k] / expected, 1.0, 0.04) << k;
  }
}

TYPED_TEST(BandedEigensolvers, SameBytesForTheSameInputAndAnyThreads)
{
  const OwnedProblem problem(shapes::Bumpy(5));
  const EigenPairs first = SolveBanded<TypeParam>(problem, 80, 30);
  const EigenPairs second = SolveBanded<TypeParam>(problem, 80, 30, 3);
  EXPECT_TRUE((first.Values.array() == second.Values.array()).all());
  EXPECT_TRUE((first.Vectors.array() == second.Vectors.array()).all());
}

// The block solver takes a second thread where each has four chunks of rows; on fewer it is alone,
// whatever was asked for.
TEST(Eigensolvers, SameBytesOnTwoThreadsWhereBothAreTaken)
{
  const OwnedProblem problem(shapes::Rectangle(140, 140, 1.0, 0.7));
  ASSERT_GE(problem.Stiffness.rows(), 2 * 4 * RowsPerChunk);
  const EigenPairs alone = SolveBanded<BlockLanczosSolver>(problem, 20, 0, 1);
  const EigenPairs both = SolveBanded<BlockLanczosSolver>(problem, 20, 0, 2);
  EXPECT_TRUE((alone.Values.array() == both.Values.array()).all());
  EXPECT_TRUE((alone.Vectors.array() == both.Vectors.array()).all());
}

TYPED_TEST(BandedEigensolvers, ProgressRisesAndAbortStops)
{
  const OwnedProblem problem(shapes::Bumpy(4));
  EigensolverOptions options;
  options.Count = 90;
  options.BandSize = 20;
  std::vector<double> seen;
  const Progress watching(
    [&seen](double fraction)
    {
      seen.push_back(fraction);
      return true;
    });
  TypeParam().Solve(problem.View(), options, watching);
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
  EXPECT_GT(seen.size(), 50u); // a block of eight vectors at a time
  EXPECT_LT(seen.front(), 0.1);
  EXPECT_EQ(seen.back(), 1.0);

  const Progress stopping([](double fraction) { return fraction < 0.3; });
  EXPECT_THROW(TypeParam().Solve(problem.View(), options, stopping), Aborted);
}

// A basis of the same triangles with other points makes it faster; what comes out is what would have
// come out without.
TEST(Eigensolvers, AHeadStartDoesNotChangeTheSpectrum)
{
  const TriangleMesh before = shapes::Bumpy(4);
  TriangleMesh after = before;
  after.Points.col(0) += 0.01 * before.Points.col(1).array().sin().matrix();
  const OwnedProblem problem(after);
  const EigenPairs nearby = SolveBanded<BlockLanczosSolver>(OwnedProblem(before), 150, 60);
  const EigenPairs cold = SolveBanded<BlockLanczosSolver>(problem, 150, 60);

  const WarmStart start{ nearby.Values, &nearby.Vectors, nearby.Order };
  const WarmStart unordered{ nearby.Values, &nearby.Vectors, Eigen::VectorXi() };
  const WarmStart exact{ cold.Values, &cold.Vectors, cold.Order };
  const Eigen::MatrixXd few = nearby.Vectors.leftCols(5);
  const WarmStart tooFew{ nearby.Values.head(5), &few, nearby.Order };
  for (const WarmStart& headStart : { start, unordered, exact, tooFew })
  {
    EigensolverOptions options;
    options.Count = 150;
    options.BandSize = 60;
    options.InitialGuess = &headStart;
    const EigenPairs warm = BlockLanczosSolver().Solve(problem.View(), options, Progress());
    ASSERT_TRUE(warm.Complete);
    ExpectSameSpectrum(warm.Values, cold.Values);
    EXPECT_LT(warm.Residuals.maxCoeff(), 1e-8);
    EXPECT_LT(OrthonormalityError(problem, warm), 1e-12);
  }
}

// Rows as they come are no order to eliminate in: nobody must take them for one.
TEST(Eigensolvers, OnlyASolverThatChoseAnOrderGivesOne)
{
  const OwnedProblem problem(shapes::Bumpy(4));
  EXPECT_EQ(SolveBanded<SpectraSolver>(problem, 20, 0).Order.size(), 0);
  EXPECT_EQ(SolveBanded<BlockLanczosSolver>(problem, 20, 0).Order.size(), problem.Mass.rows());
}

// No mesh that passes the checks leads there; should rounding do so once, the solver says it.
TEST(Eigensolvers, NumbersThatAreDamagedAreRefused)
{
  const char* brokeDown = "the factorisation of the shifted Laplacian broke down";
  OwnedProblem notANumber(shapes::Bumpy(3));
  notANumber.Stiffness.coeffRef(7, 7) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(FailureOf(BlockLanczosSolver(), notANumber), brokeDown);
  EXPECT_EQ(FailureOf(SpectraSolver(), notANumber),
    "the eigensolver gave up (TridiagEigen: eigen decomposition failed): remove the "
    "mesh's thinnest triangles, or ask for fewer harmonics");
  EXPECT_EQ(FailureOf(DenseSolver(), notANumber), "the dense eigensolver did not converge");

  OwnedProblem withoutARow(shapes::Bumpy(3));
  for (SparseMatrix* matrix : { &withoutARow.Stiffness, &withoutARow.Mass })
  {
    matrix->prune([](Index row, Index column, double) { return row != 7 && column != 7; });
  }
  EXPECT_EQ(FailureOf(BlockLanczosSolver(), withoutARow), brokeDown);
  EXPECT_EQ(FailureOf(SpectraSolver(), withoutARow), brokeDown);
}

// Counts what it is asked, and finds the same values every time, none of them an eigenvalue.
class FindsNonsense : public ShiftInvertSolver
{
public:
  FindsNonsense(const OwnedProblem& problem, std::vector<double> values)
    : Problem(problem)
    , Values(std::move(values))
    , SameOrder(Eigen::VectorXi::LinSpaced(problem.Mass.rows(), 0,
        static_cast<int>(problem.Mass.rows()) - 1))
  {
  }

  Index DefaultBandSize(Index /*wanted*/) const override { return 20; }
  bool FirstShiftInside() const override { return false; }
  Index Factorize(double /*shift*/, const Progress& /*progress*/) override { return 0; }
  Band FindNearest(BandRequest /*request*/, const Progress& /*progress*/) override
  {
    ++this->Searches;
    Band band;
    band.Values = this->Values;
    band.Vectors.assign((this->Values.size() + BlockWidth - 1) / BlockWidth,
      BlockVector::Zero(this->Problem.Mass.rows(), BlockWidth));
    return band;
  }
  const SparseMatrix& Stiffness() const override { return this->Problem.Stiffness; }
  const SparseMatrix& Mass() const override { return this->Problem.Mass; }
  const Eigen::VectorXi& Order() const override { return this->SameOrder; }

  int Searches = 0;

private:
  const OwnedProblem& Problem;
  std::vector<double> Values;
  Eigen::VectorXi SameOrder;
};

int SearchesThatFind(std::vector<double> values)
{
  const OwnedProblem problem(shapes::Icosphere(1)); // of 42 vertices
  FindsNonsense solver(problem, std::move(values));
  EigensolverOptions options;
  options.Count = 20;
  EXPECT_FALSE(SolveBySlicing(problem.View(), options, solver, Progress()).Complete);
  return solver.Searches;
}

// What is found stays, so that more searches would not mend it.
TEST(Eigensolvers, ASearchThatFindsNoSpectrumIsGivenUp)
{
  EXPECT_EQ(SearchesThatFind({ -1.0, 2.0, 3.0 }), 1) << "one far below 0";
  EXPECT_EQ(SearchesThatFind(std::vector<double>(30, 5.0)), 2) << "60 of 42";
  EXPECT_EQ(SearchesThatFind({ -1e-9, 2.0, 3.0 }), 12) << "a rounding under 0";
}

TEST(Eigensolvers, VectorsThatDependOnEachOtherAreRefused)
{
  const OwnedProblem problem(shapes::Bumpy(3));
  Eigen::MatrixXd vectors = Eigen::MatrixXd::Random(problem.Mass.rows(), 3);
  vectors.col(2).setZero();
  try
  {
    Orthonormalize(problem.Mass, vectors);
    FAIL() << "no error";
  }
  catch (const SolverFailure& failure)
  {
    EXPECT_STREQ(failure.what(), "the computed harmonics are linearly dependent");
  }
}

// Inverse iteration drowns all other vectors in the one whose eigenvalue the shift nearly hits.
// Scaling the stiffness moves an eigenvalue onto the first shift, which does not depend on it.
TEST(Eigensolvers, AShiftThatNearlyHitsAnEigenvalueDoesNoHarm)
{
  const OwnedProblem problem(shapes::Bumpy(4));
  const EigenPairs reference = SolveBanded<SpectraSolver>(problem, 70, 0);
  const double shift = 0.5 * 70.0 * 4.0 * Pi; // half of the band, by Weyl's law
  Index nearest = 0;
  (reference.Values.array() - shift).abs().minCoeff(&nearest);
  for (const double distance : { 1e-3, 1e-6, 1e-9 })
  {
    OwnedProblem scaled = problem;
    const double factor = (shift + distance) / reference.Values[nearest];
    scaled.Stiffness *= factor;
    const EigenPairs pairs = SolveBanded<BlockLanczosSolver>(scaled, 70, 0);
    ASSERT_TRUE(pairs.Complete) << distance;
    EXPECT_LT(pairs.Residuals.maxCoeff(), 1e-8) << distance;
    ExpectSameSpectrum(pairs.Values / factor, reference.Values);
  }
}

// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Eigensolver/BlockLanczos.h"
#include "Core/Eigensolver/DenseSolver.h"
#include "Core/Eigensolver/Eigensolver.h"
#include "Core/Eigensolver/SpectraSolver.h"
#include "Core/Support/Errors.h"
#include "Core/Support/Progress.h"
#include "Support/EigenProblems.h"
#include "Support/Shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

using namespace spectralwatermark;
using namespace eigenproblems;

namespace
{

// Every solver that works band by band must pass the same tests.
template <typename Solver>
class EigensolverBySlicing : public testing::Test
{
};
using SlicingSolvers = testing::Types<BlockLanczosSolver, SpectraSolver>;
TYPED_TEST_SUITE(EigensolverBySlicing, SlicingSolvers);

} // namespace

TYPED_TEST(EigensolverBySlicing, AgreesWithDenseOverHalfTheSpectrum)
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

TYPED_TEST(EigensolverBySlicing, BandSizeDoesNotChangeTheSpectrum)
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
TYPED_TEST(EigensolverBySlicing, FlatTorusMultiplicitiesSurviveEveryBandSize)
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
TYPED_TEST(EigensolverBySlicing, IdenticalComponentsDoubleEveryEigenvalue)
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
TYPED_TEST(EigensolverBySlicing, SolvesManyComponents)
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
TYPED_TEST(EigensolverBySlicing, SolvesAreasThatDifferByEightOrders)
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
TYPED_TEST(EigensolverBySlicing, SolvesSlivers)
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

TYPED_TEST(EigensolverBySlicing, GivesTheSameBytesForAnyThreads)
{
  const OwnedProblem problem(shapes::Bumpy(5));
  const EigenPairs first = SolveBanded<TypeParam>(problem, 80, 30);
  const EigenPairs second = SolveBanded<TypeParam>(problem, 80, 30, 3);
  EXPECT_TRUE((first.Values.array() == second.Values.array()).all());
  EXPECT_TRUE((first.Vectors.array() == second.Vectors.array()).all());
}

TYPED_TEST(EigensolverBySlicing, ProgressRisesAndAbortStops)
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

// Rows as they come are no order to eliminate in: nobody must take them for one.
TEST(Eigensolver, GivesAnOrderOnlyWhereTheSolverChoseOne)
{
  const OwnedProblem problem(shapes::Bumpy(4));
  EXPECT_EQ(SolveBanded<SpectraSolver>(problem, 20, 0).Order.size(), 0);
  EXPECT_EQ(SolveBanded<BlockLanczosSolver>(problem, 20, 0).Order.size(), problem.Mass.rows());
}

// No mesh that passes the checks leads there; should rounding do so once, the solver says it.
TEST(Eigensolver, RefusesDamagedNumbers)
{
  const char* brokeDown = "the factorisation of the shifted Laplacian broke down";
  const auto withNotANumber = [](int level)
  {
    OwnedProblem problem(shapes::Bumpy(level));
    problem.Stiffness.coeffRef(7, 7) = std::numeric_limits<double>::quiet_NaN();
    return problem;
  };
  const OwnedProblem notANumber = withNotANumber(3);
  EXPECT_EQ(FailureOf(BlockLanczosSolver(), notANumber), brokeDown);
  EXPECT_EQ(FailureOf(SpectraSolver(), notANumber),
    "the eigensolver gave up (TridiagEigen: eigen decomposition failed); remove the "
    "mesh's thinnest triangles, or ask for fewer harmonics");
  // A smaller one: the dense solver iterates for long before it gives up.
  EXPECT_EQ(FailureOf(DenseSolver(), withNotANumber(2)), "the dense eigensolver did not converge");

  OwnedProblem withoutARow(shapes::Bumpy(3));
  for (SparseMatrix* matrix : { &withoutARow.Stiffness, &withoutARow.Mass })
  {
    matrix->prune([](Index row, Index column, double) { return row != 7 && column != 7; });
  }
  EXPECT_EQ(FailureOf(BlockLanczosSolver(), withoutARow), brokeDown);
  EXPECT_EQ(FailureOf(SpectraSolver(), withoutARow), brokeDown);
}

TEST(Eigensolver, RefusesLinearlyDependentVectors)
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

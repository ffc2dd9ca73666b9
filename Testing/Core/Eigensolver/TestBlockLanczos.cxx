// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Eigensolver/BlockLanczos.h"
#include "Core/Eigensolver/SpectraSolver.h"
#include "Core/LinearAlgebra/MultiVector.h"
#include "Support/EigenProblems.h"
#include "Support/Shapes.h"

#include <gtest/gtest.h>

using namespace spectralwatermark;
using namespace eigenproblems;

// The block solver takes a second thread where each has four chunks of rows; on fewer it is alone,
// whatever was asked for.
TEST(BlockLanczos, GivesTheSameBytesOnTwoThreadsWhereBothAreTaken)
{
  const OwnedProblem problem(shapes::Rectangle(140, 140, 1.0, 0.7));
  ASSERT_GE(problem.Stiffness.rows(), 2 * 4 * RowsPerChunk);
  const EigenPairs alone = SolveBanded<BlockLanczosSolver>(problem, 20, 0, 1);
  const EigenPairs both = SolveBanded<BlockLanczosSolver>(problem, 20, 0, 2);
  EXPECT_TRUE((alone.Values.array() == both.Values.array()).all());
  EXPECT_TRUE((alone.Vectors.array() == both.Vectors.array()).all());
}

// A basis of the same triangles with other points makes it faster; what comes out is what would have
// come out without.
TEST(BlockLanczos, AWarmStartDoesNotChangeTheSpectrum)
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

// Inverse iteration drowns all other vectors in the one whose eigenvalue the shift nearly hits.
// Scaling the stiffness moves an eigenvalue onto the first shift, which does not depend on it.
TEST(BlockLanczos, AShiftThatNearlyHitsAnEigenvalueDoesNoHarm)
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

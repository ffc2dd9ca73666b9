// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Mesh/Measures.h"
#include "Core/RobustScheme/CarrierSet.h"
#include "Core/RobustScheme/EmbeddingPlan.h"
#include "Core/RobustScheme/SolidSpectrum.h"
#include "Core/RobustScheme/SurfaceMotion.h"
#include "Core/Support/Errors.h"
#include "Core/Support/Progress.h"
#include "Support/RobustTesting.h"

#include <gtest/gtest.h>

using namespace spectralwatermark;
using robusttesting::Host;

namespace
{

struct Motion
{
  TriangleMesh Mesh = Host(3);
  SecretKey Key{ "secret" };
  CarrierProblem Problem{ SolidView(this->Mesh), this->Key, 4, 2 };
  EmbeddingPlan Plan = LargestAffordable(this->Problem,
    CodeOf(DataOf("1011", this->Key, this->Problem.Carriers.CheckBits)), 2e-3);
  SurfaceMotion Surface{ this->Mesh, this->Problem, 2 };
};

} // namespace

TEST(SurfaceMotion, BringsTheCarriersToTheirTargets)
{
  const Motion motion;
  const SurfaceMotion::Result result = motion.Surface.Run(motion.Plan, Progress());
  const TriangleMesh marked = robusttesting::With(motion.Mesh, result.Points);
  const Eigen::VectorXd values =
    SolidSpectrum(SolidView(marked).Mesh, motion.Problem.Carriers.Waves, 1);
  const double step = StepOfNumber(motion.Plan.Step);
  const double miss = (values - motion.Plan.Targets).cwiseAbs().maxCoeff() / step;
  EXPECT_LT(miss, 0.01);
  EXPECT_NEAR(motion.Surface.Margin(marked, motion.Plan), 1.0 - 4.0 * miss, 1e-9);
  EXPECT_LT(motion.Surface.Margin(motion.Mesh, motion.Plan), 0.5);
  EXPECT_NEAR(result.Rounds.back().LargestError, miss, 1e-9);
}

TEST(SurfaceMotion, RoundsBeginWithTheMeshAsItWasAndConverge)
{
  const Motion motion;
  const SurfaceMotion::Result result = motion.Surface.Run(motion.Plan, Progress());
  ASSERT_GE(result.Rounds.size(), 2u);
  EXPECT_EQ(result.Rounds.front().Distortion, 0.0);
  for (std::size_t k = 1; k < result.Rounds.size(); ++k)
  {
    EXPECT_LT(result.Rounds[k].LargestError, result.Rounds[k - 1].LargestError) << k;
  }
}

// The root mean square over the surface, parts of the diagonal.
TEST(SurfaceMotion, DistortionIsKnownForATranslation)
{
  const Motion motion;
  TriangleMesh::PointMatrix moved = motion.Mesh.Points;
  moved.rowwise() += Eigen::RowVector3d(0.03, 0.0, -0.04);
  EXPECT_NEAR(motion.Surface.Distortion(moved), 0.05 / BoundingBoxDiagonal(motion.Mesh.Points),
    1e-14);
  EXPECT_EQ(motion.Surface.Distortion(motion.Mesh.Points), 0.0);
}

TEST(SurfaceMotion, IsAborted)
{
  const Motion motion;
  const Progress stopping([](double) { return false; });
  EXPECT_THROW(motion.Surface.Run(motion.Plan, stopping), Aborted);
}

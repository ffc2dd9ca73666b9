// SPDX-License-Identifier: BSD-3-Clause
#include "Core/RobustScheme/CarrierSet.h"
#include "Core/RobustScheme/EmbeddingPlan.h"
#include "Core/RobustScheme/SolidSpectrum.h"
#include "Support/RobustTesting.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

using namespace spectralwatermark;
using robusttesting::Host;

namespace
{

struct Planned
{
  SecretKey Key{ "secret" };
  SolidView View{ Host(3) };
  CarrierProblem Problem{ this->View, this->Key, 4, 2 };
  std::string Code = CodeOf(DataOf("1011", this->Key, this->Problem.Carriers.CheckBits));
};

// How far a carrier's value is from the lattice of its bit, in steps.
double OffLattice(const Planned& planned, const Eigen::VectorXd& values, double step, Index carrier)
{
  const CarrierSet& carriers = planned.Problem.Carriers;
  const bool isOne = planned.Code[carrier] != carriers.Whitening[carrier];
  const double place = values[carrier] / step - carriers.Dither[carrier] - (isOne ? 0.5 : 0.0);
  return std::abs(place - std::round(place));
}

} // namespace

TEST(EmbeddingPlan, ProblemsHoldTheCarriersOfTheView)
{
  const Planned planned;
  const CarrierSet carriers = CarriersOf(planned.Key, 4);
  EXPECT_EQ(planned.Problem.Carriers.Waves, carriers.Waves);
  EXPECT_EQ(planned.Problem.Values, SolidSpectrum(planned.View.Mesh, carriers.Waves, 1));
  EXPECT_EQ(planned.Problem.Cost, planned.Problem.Response.Cost(carriers.Count()));
}

TEST(EmbeddingPlan, TargetsAreLatticePointsOfTheirBits)
{
  const Planned planned;
  for (const int number : { 0, 12, 40 })
  {
    const EmbeddingPlan plan = PlanWithStep(number, planned.Problem, planned.Code);
    EXPECT_EQ(plan.Step, number);
    for (Index j = 0; j < planned.Problem.Carriers.Count(); ++j)
    {
      EXPECT_LT(OffLattice(planned, plan.Targets, StepOfNumber(number), j), 1e-6) << j;
    }
  }
}

TEST(EmbeddingPlan, CostsNoMoreThanTheNearestLatticePoints)
{
  const Planned planned;
  const Eigen::VectorXd& values = planned.Problem.Values;
  const double step = StepOfNumber(20);
  const EmbeddingPlan plan = PlanWithStep(20, planned.Problem, planned.Code);
  const Eigen::VectorXd changes = plan.Targets - values;
  EXPECT_NEAR(plan.Distortion, std::sqrt(changes.dot(planned.Problem.Cost * changes)), 1e-12);

  // A target differs from the nearest point of its lattice by whole steps.
  const Eigen::VectorXd nearest = changes - step * (changes / step).array().round().matrix();
  EXPECT_LE(plan.Distortion, std::sqrt(nearest.dot(planned.Problem.Cost * nearest)) + 1e-12);
}

TEST(EmbeddingPlan, TakesTheLargestStepWithinTheBudget)
{
  const Planned planned;
  for (const double budget : { 1e-4, 1e-3, 5e-3 })
  {
    const EmbeddingPlan plan = LargestAffordable(planned.Problem, planned.Code, budget);
    ASSERT_GE(plan.Step, 0) << budget;
    ASSERT_LT(plan.Step, NumberOfSteps - 1) << budget;
    EXPECT_LE(plan.Distortion, budget);
    for (int larger = plan.Step + 1; larger < NumberOfSteps; ++larger)
    {
      EXPECT_GT(PlanWithStep(larger, planned.Problem, planned.Code).Distortion, budget) << larger;
    }
  }
  EXPECT_EQ(LargestAffordable(planned.Problem, planned.Code, 0.0).Step, -1);
}

TEST(EmbeddingPlan, MemoryGrowsWithVerticesAndCarriers)
{
  const double one = MemoryOfEmbedding(1000, 48);
  EXPECT_GE(one, 2.0 * 8.0 * 1000.0 * 48.0); // two matrices of patterns at least
  EXPECT_EQ(MemoryOfEmbedding(2000, 48), 2.0 * one);
  EXPECT_EQ(MemoryOfEmbedding(1000, 48 + 61), 2.0 * one); // with 13 moments of the frame
  EXPECT_GT(MemoryOfEmbedding(Index{ 1 } << 40, 1000), 1e15);
}

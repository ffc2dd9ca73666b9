// SPDX-License-Identifier: BSD-3-Clause
#include "Core/RobustScheme/EmbeddingPlan.h"

#include "Core/RobustScheme/SolidSpectrum.h"

#include <algorithm>
#include <cmath>

namespace spectralwatermark
{

namespace
{

using Eigen::MatrixXd;
using Eigen::VectorXd;

// The offset of each carrier's lattice: a carrier that holds its bit has the value
// offset + step * integer.
VectorXd Offsets(const std::string& code, const CarrierSet& carriers, double step)
{
  VectorXd offsets(carriers.Count());
  for (Index j = 0; j < carriers.Count(); ++j)
  {
    const bool bit = code[j] != carriers.Whitening[j];
    offsets[j] = step * ((bit ? 0.5 : 0.0) + carriers.Dither[j]);
  }
  return offsets;
}

// Lowers the cost of the carrier changes. Lattice points other than the nearest ones may cost less
// together, so one carrier at a time moves by one step, as long as that helps.
void CheapenChanges(const MatrixXd& cost, double step, VectorXd& changes)
{
  // A bound on the work; the search usually ends earlier.
  constexpr int mostMoves = 2000;
  VectorXd gradient = cost * changes;
  for (int move = 0; move < mostMoves; ++move)
  {
    Index carrier = -1;
    double direction = 0.0;
    double gain = -1e-9 * changes.dot(gradient);
    for (Index j = 0; j < changes.size(); ++j)
    {
      const double sign = gradient[j] > 0.0 ? -1.0 : 1.0;
      const double change = 2.0 * sign * step * gradient[j] + step * step * cost(j, j);
      if (change < gain)
      {
        gain = change;
        carrier = j;
        direction = sign;
      }
    }
    if (carrier < 0)
    {
      return;
    }
    changes[carrier] += direction * step;
    gradient += direction * step * cost.col(carrier);
  }
}

} // namespace

CarrierProblem::CarrierProblem(const SolidView& view, const SecretKey& key, Index messageBits,
  int threads)
  : Carriers(CarriersOf(key, messageBits))
  , Values(SolidSpectrum(view.Mesh, this->Carriers.Waves, threads))
  , Response(view, this->Carriers, threads)
  , Cost(this->Response.Cost(this->Carriers.Count()))
{
}

double MemoryOfEmbedding(Index vertices, Index carriers)
{
  // The peak memory in units of one response: two responses and half of one as workspace.
  // Testing/Benchmark/memory measures it.
  constexpr double patternsAtPeak = 2.5;
  return patternsAtPeak * sizeof(double) * static_cast<double>(vertices) *
    static_cast<double>(carriers + FrameMoments);
}

EmbeddingPlan PlanWithStep(int number, const CarrierProblem& problem, const std::string& code)
{
  const double step = StepOfNumber(number);
  const VectorXd& values = problem.Values;
  const VectorXd offsets = Offsets(code, problem.Carriers, step);
  VectorXd changes = offsets + step * ((values - offsets) / step).array().round().matrix() - values;
  CheapenChanges(problem.Cost, step, changes);
  return { number, values + changes,
    std::sqrt(std::max(0.0, changes.dot(problem.Cost * changes))) };
}

EmbeddingPlan LargestAffordable(const CarrierProblem& problem, const std::string& code,
  double budget)
{
  EmbeddingPlan plan;
  for (int number = NumberOfSteps - 1; number >= 0; --number)
  {
    plan = PlanWithStep(number, problem, code);
    if (plan.Distortion <= budget)
    {
      return plan;
    }
  }
  plan.Step = -1;
  return plan;
}

} // namespace spectralwatermark

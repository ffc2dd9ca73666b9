// SPDX-License-Identifier: BSD-3-Clause
/// Which lattice points the carriers move to, with which step, and what that costs.
#ifndef SpectralWatermark_Core_RobustScheme_EmbeddingPlan_h
#define SpectralWatermark_Core_RobustScheme_EmbeddingPlan_h

#include "Core/Payload/SecretKey.h"
#include "Core/RobustScheme/CarrierSet.h"
#include "Core/RobustScheme/SolidResponse.h"

#include <string>

namespace spectralwatermark
{

/// A mesh's carriers: their values and how they respond to displacements.
struct CarrierProblem
{
  /// Throws InvalidInput where the carriers' waves cannot be told apart on the surface.
  CarrierProblem(const SolidView& view, const SecretKey& key, Index messageBits, int threads);

  CarrierSet Carriers;
  Eigen::VectorXd Values;
  SolidResponse Response;
  Eigen::MatrixXd Cost; ///< mean square displacement of carrier changes r, as r^T Cost r
};

/// The bytes that an embedding takes at its peak: two responses, and the work space of the second.
double MemoryOfEmbedding(Index vertices, Index carriers);

struct EmbeddingPlan
{
  int Step = -1;           ///< number of the step (StepOfNumber()); -1: none is affordable
  Eigen::VectorXd Targets; ///< the carriers' values to reach
  double Distortion = 0.0; ///< root mean square of the displacement, in the frame's scale
};

/// The cheapest lattice points found for a code word with this step.
EmbeddingPlan PlanWithStep(int number, const CarrierProblem& problem, const std::string& code);

/// The plan with the largest step whose distortion is within the budget.
EmbeddingPlan LargestAffordable(const CarrierProblem& problem, const std::string& code,
  double budget);

} // namespace spectralwatermark

#endif

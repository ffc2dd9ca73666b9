// SPDX-License-Identifier: BSD-3-Clause
/// Plans an embedding: the quantisation step, the lattice point that each carrier moves to, and the
/// distortion that this costs.
#ifndef SpectralWatermark_Core_RobustScheme_EmbeddingPlan_h
#define SpectralWatermark_Core_RobustScheme_EmbeddingPlan_h

#include "Core/Payload/SecretKey.h"
#include "Core/RobustScheme/CarrierSet.h"
#include "Core/RobustScheme/SolidResponse.h"

#include <string>

namespace spectralwatermark
{

/// The carriers of a mesh: their values, and how they respond to displacements of the surface.
struct CarrierProblem
{
  /// Throws InvalidInput if the waves of the carriers cannot be told apart on the surface.
  CarrierProblem(const SolidView& view, const SecretKey& key, Index messageBits, int threads);

  CarrierSet Carriers;

  /// The value of each carrier, in (scale of the frame)^3.
  Eigen::VectorXd Values;

  SolidResponse Response;

  /// The cost matrix: changes r of the carriers take a mean square displacement of r^T Cost r, in
  /// (scale of the frame)^2.
  Eigen::MatrixXd Cost;
};

/// The peak memory of an embedding, in bytes: two responses, and the workspace of the second.
double MemoryOfEmbedding(Index vertices, Index carriers);

/// The carrier values that an embedding aims at.
struct EmbeddingPlan
{
  int Step = -1;           ///< number of the step (see StepOfNumber()); -1: none is affordable
  Eigen::VectorXd Targets; ///< the value that each carrier is to reach
  double Distortion = 0.0; ///< root mean square of the displacement, in the frame's scale
};

/// A plan with the step of this number: the cheapest lattice points found that hold `code`, the
/// code bits of the carriers.
EmbeddingPlan PlanWithStep(int number, const CarrierProblem& problem, const std::string& code);

/// The plan with the largest step whose distortion is at most `budget`, in the frame's scale. If
/// even the smallest step costs more, the plan is that of the smallest step, with Step set to -1.
EmbeddingPlan LargestAffordable(const CarrierProblem& problem, const std::string& code,
  double budget);

} // namespace spectralwatermark

#endif

// SPDX-License-Identifier: BSD-3-Clause
/// Moves the surface of a mesh until its carriers have the values of an embedding plan.
#ifndef SpectralWatermark_Core_RobustScheme_SurfaceMotion_h
#define SpectralWatermark_Core_RobustScheme_SurfaceMotion_h

#include "Core/RobustScheme/EmbeddingPlan.h"
#include "Core/RobustScheme/SolidResponse.h"
#include "Core/Support/Progress.h"

#include <vector>

namespace spectralwatermark
{

/// One round of an embedding.
struct RobustEmbeddingRound
{
  /// The root mean square displacement so far, as a fraction of the bounding-box diagonal.
  double Distortion = 0.0;

  /// The largest error of a carrier, in steps, before the points are stored.
  double LargestError = 0.0;
};

/// Moves the points of a mesh along their normals until the carriers reach the targets of a plan.
/// The mesh and the problem must outlive it.
class SurfaceMotion
{
public:
  SurfaceMotion(const TriangleMesh& oriented, const CarrierProblem& problem, int threads);

  /// The moved points, and how they were reached.
  struct Result
  {
    TriangleMesh::PointMatrix Points;         ///< the moved points, not yet stored
    std::vector<RobustEmbeddingRound> Rounds; ///< the first is the mesh before the embedding
  };

  /// Moves the surface in rounds until the carriers reach their targets or the error grows.
  Result Run(const EmbeddingPlan& plan, const Progress& progress) const;

  /// The root mean square displacement of these points, as a fraction of the bounding-box diagonal.
  double Distortion(const TriangleMesh::PointMatrix& points) const;

  /// The smallest margin of all carriers of a marked mesh: 1 in the middle of its cell, 0 at the
  /// border.
  double Margin(const TriangleMesh& marked, const EmbeddingPlan& plan) const;

private:
  Eigen::VectorXd Spectrum(const SolidView& view) const;

  const TriangleMesh& Original;
  const CarrierProblem& Problem;
  int Threads;
  double Diagonal;
};

} // namespace spectralwatermark

#endif

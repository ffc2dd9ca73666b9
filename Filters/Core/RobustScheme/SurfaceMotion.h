// SPDX-License-Identifier: BSD-3-Clause
#ifndef SpectralWatermark_Core_RobustScheme_SurfaceMotion_h
#define SpectralWatermark_Core_RobustScheme_SurfaceMotion_h

#include "Core/RobustScheme/EmbeddingPlan.h"
#include "Core/RobustScheme/SolidResponse.h"
#include "Core/Support/Progress.h"

#include <vector>

namespace spectralwatermark
{

struct RobustEmbeddingRound
{
  double Distortion = 0.0;   ///< root mean square of the displacement so far, parts of the diagonal
  double LargestError = 0.0; ///< of a carrier, in steps, before the points are stored
};

/// Moves the points of a mesh along their normals until the carriers are at a plan's targets. The mesh and
/// the problem must outlive it.
class SurfaceMotion
{
public:
  SurfaceMotion(const TriangleMesh& oriented, const CarrierProblem& problem, int threads);

  struct Result
  {
    TriangleMesh::PointMatrix Points;         ///< not yet stored
    std::vector<RobustEmbeddingRound> Rounds; ///< the first is the mesh as it was
  };
  Result Run(const EmbeddingPlan& plan, const Progress& progress) const;

  /// Root mean square of the displacement of these points, parts of the diagonal.
  double Distortion(const TriangleMesh::PointMatrix& points) const;

  /// The least margin of all carriers: 1 in the middle of its cell, 0 at the border.
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

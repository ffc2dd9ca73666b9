// SPDX-License-Identifier: BSD-3-Clause
/// How the carriers of a solid (CarrierSet.h) respond to displacements of its surface.
#ifndef SpectralWatermark_Core_RobustScheme_SolidResponse_h
#define SpectralWatermark_Core_RobustScheme_SolidResponse_h

#include "Core/RobustScheme/CarrierSet.h"
#include "Core/RobustScheme/SolidFrame.h"

namespace spectralwatermark
{

/// A solid in its own frame, where the carriers are read.
struct SolidView
{
  explicit SolidView(const TriangleMesh& oriented);
  SolidView(const TriangleMesh& oriented, const SolidFrame& frame);

  SolidFrame Frame;
  TriangleMesh Mesh; ///< in coordinates of the frame
};

/// The number of moments that determine the frame: the volume, three first, six second and three
/// third moments. Each belongs to a function on the surface. A displacement along the normals that
/// is orthogonal to all of these functions leaves the frame unchanged, to first order.
constexpr Index FrameMoments = 13;

/// Displacements of a surface along its normals that change the carriers by given amounts and leave
/// the frame unchanged, both to first order. They are the smallest in mean square over the surface.
class SolidResponse
{
public:
  /// Throws InvalidInput if the waves of the carriers cannot be told apart on the surface.
  SolidResponse(const SolidView& view, const CarrierSet& carriers, int threads);

  /// The displacement of each vertex along its normal that changes carrier i by changes[i], in the
  /// frame's scale.
  Eigen::VectorXd Displacements(const Eigen::VectorXd& changes) const;

  /// The cost matrix of the first `carriers` carriers: changes r take a mean square displacement of
  /// r^T Cost r, in (scale of the frame)^2.
  Eigen::MatrixXd Cost(Index carriers) const;

private:
  Eigen::VectorXd Areas;    // of the vertices
  Eigen::MatrixXd Patterns; // a column per carrier and per moment, a row per vertex
  Eigen::MatrixXd Inverse;  // the inverse of the patterns' Gram matrix
};

} // namespace spectralwatermark

#endif

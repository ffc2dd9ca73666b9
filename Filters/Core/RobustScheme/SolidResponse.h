// SPDX-License-Identifier: BSD-3-Clause
/// The response of a solid's carriers (CarrierSet.h) to displacements of its surface.
#ifndef SpectralWatermark_Core_RobustScheme_SolidResponse_h
#define SpectralWatermark_Core_RobustScheme_SolidResponse_h

#include "Core/RobustScheme/CarrierSet.h"
#include "Core/RobustScheme/SolidFrame.h"

namespace spectralwatermark
{

/// The solid as the carriers see it: the mesh in its frame.
struct SolidView
{
  explicit SolidView(const TriangleMesh& oriented);
  SolidView(const TriangleMesh& oriented, const SolidFrame& frame);

  SolidFrame Frame;
  TriangleMesh Mesh; ///< in the frame
};

/// The volume, its centre, and the second and third moments that the frame is made from: functions over
/// the surface. A displacement along the normals that is orthogonal to them leaves the frame as it is.
constexpr Index FrameMoments = 13;

/// Displacements along the normals that change the carriers, to first order, by what is asked for and
/// the frame not at all: the smallest ones in mean square over the surface.
class SolidResponse
{
public:
  /// Throws InvalidInput where the carriers' waves cannot be told apart on the surface.
  SolidResponse(const SolidView& view, const CarrierSet& carriers, int threads);

  /// A length for each vertex, in the frame.
  Eigen::VectorXd Displacements(const Eigen::VectorXd& changes) const;

  /// Of the carriers' changes r: the square of the displacements' root mean square is r^T Cost r.
  Eigen::MatrixXd Cost(Index carriers) const;

private:
  Eigen::VectorXd Areas;
  Eigen::MatrixXd Patterns; // a column for each carrier and moment
  Eigen::MatrixXd Inverse;  // of their Gram matrix
};

} // namespace spectralwatermark

#endif

// SPDX-License-Identifier: BSD-3-Clause
/// How a solid's carriers (SolidCarriers.h) answer to displacements of its surface.
#ifndef SpectralWatermark_Core_SolidResponse_h
#define SpectralWatermark_Core_SolidResponse_h

#include "Solid.h"
#include "SolidCarriers.h"
#include "TriangleMesh.h"

namespace spectralwatermark
{

/// The solid as the carriers see it.
struct SolidView
{
  explicit SolidView(const TriangleMesh& oriented);

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
  SolidResponse(const SolidView& view, const Carriers& carriers, int threads);

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

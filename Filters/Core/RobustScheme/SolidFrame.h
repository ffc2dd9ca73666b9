// SPDX-License-Identifier: BSD-3-Clause
/// The frame of a solid, which depends on integrals over its interior and not on its triangles.
#ifndef SpectralWatermark_Core_RobustScheme_SolidFrame_h
#define SpectralWatermark_Core_RobustScheme_SolidFrame_h

#include "Core/Mesh/TriangleMesh.h"

#include <optional>

namespace spectralwatermark
{

/// A frame that moves, rotates and scales with a solid.
///
/// It is computed from the moments of the volume, which noise hardly changes: what noise adds in
/// one place it takes away in another. The origin is the centroid. The axes are the principal
/// directions, the longest first. The unit of length is the root mean square distance from the
/// centroid. The two axes whose third moments are clearest take the signs of these moments; the
/// third axis completes a right-handed frame.
struct SolidFrame
{
  /// The origin, in the model's coordinates.
  Eigen::RowVector3d Origin;

  /// The unit vectors of the axes, a row each.
  Eigen::Matrix3d Axes;

  /// The unit of length, in the model's units.
  double Scale = 1.0;

  /// The smallest skewness, at least 0, that the signs of the axes depend on. Near 0 they are
  /// unclear.
  double Clearness = 0.0;

  /// Points in the frame: (x - Origin) Axes^T / Scale.
  TriangleMesh::PointMatrix ToFrame(const TriangleMesh::PointMatrix& points) const;

  /// The inverse of ToFrame() for differences of points.
  TriangleMesh::PointMatrix DifferencesFromFrame(const TriangleMesh::PointMatrix& changes) const;
};

/// The frame of the solid that an oriented surface encloses. Throws InvalidInput if the surface
/// encloses no volume, or if its moments are not those of a solid.
SolidFrame FrameOf(const TriangleMesh& oriented);

/// The same, or nothing where FrameOf() throws.
std::optional<SolidFrame> FrameIfAny(const TriangleMesh& oriented);

/// The number of turns that RotatedByPi() takes.
constexpr int NumberOfTurns = 4;

/// The frame rotated by half a turn about axis 1, 2 or 3; turn 0 leaves it unchanged. These are the
/// frames that remain possible where the third moments are too small to determine signs.
SolidFrame RotatedByPi(const SolidFrame& frame, int turn);

} // namespace spectralwatermark

#endif

// SPDX-License-Identifier: BSD-3-Clause
/// The frame of a solid: integrals over its inside, whatever its triangles.
#ifndef SpectralWatermark_Core_RobustScheme_SolidFrame_h
#define SpectralWatermark_Core_RobustScheme_SolidFrame_h

#include "Core/Mesh/TriangleMesh.h"

#include <optional>

namespace spectralwatermark
{

/// Where a solid is: a frame that turns, moves and grows with it.
///
/// From the volume's moments, which noise hardly changes (what it adds outside it takes away
/// elsewhere): origin in the centroid, axes along the principal directions, the longest first, in
/// units of the root of the mean squared distance from the centroid. Signs of the axes are those of
/// the third moments along them, of the two that are clearest; the third axis completes a right-
/// handed frame.
struct SolidFrame
{
  Eigen::RowVector3d Origin;
  Eigen::Matrix3d Axes; ///< by rows
  double Scale = 1.0;
  double Clearness = 0.0; ///< of the signs: the skewness, from 0 on, that they hang on

  /// (x - Origin) Axes^T / Scale.
  TriangleMesh::PointMatrix ToFrame(const TriangleMesh::PointMatrix& points) const;
  /// The inverse for differences of points.
  TriangleMesh::PointMatrix DifferencesFromFrame(const TriangleMesh::PointMatrix& changes) const;
};

/// Throws InvalidInput for a surface that encloses no volume, or whose moments are those of no solid.
SolidFrame FrameOf(const TriangleMesh& oriented);

/// The same, or nothing for such a surface.
std::optional<SolidFrame> FrameIfAny(const TriangleMesh& oriented);

/// The frame turned by half a turn about one of its axes: 0 about none, 1 to 3. What remains open
/// where third moments are too small to tell signs.
SolidFrame RotatedByPi(const SolidFrame& frame, int turn);
constexpr int NumberOfTurns = 4;

} // namespace spectralwatermark

#endif

// SPDX-License-Identifier: BSD-3-Clause
/// A mesh as the solid that it encloses: integrals over its inside, whatever its triangles.
#ifndef SpectralWatermark_Core_Solid_h
#define SpectralWatermark_Core_Solid_h

#include "TriangleMesh.h"

#include <optional>

namespace spectralwatermark
{

/// The mesh with every component's triangles turned alike, and to enclose a volume that is not
/// negative, as far as edges with two triangles tell. Formats and tools lose orientations; integrals
/// over the inside need them.
TriangleMesh Oriented(const TriangleMesh& mesh);

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
SolidFrame Turned(const SolidFrame& frame, int turn);
constexpr int NumberOfTurns = 4;

/// The Fourier transform of the solid, the integral of exp(i k . x) over its inside, for each row k
/// of `waves`: the real parts, then the imaginary ones. By the divergence theorem a sum over
/// triangles, exact but for 1e-6 of each. An open surface is taken as it is: the sum is then that of
/// its triangles alone.
Eigen::VectorXd SolidSpectrum(const TriangleMesh& oriented, const Eigen::MatrixXd& waves,
  int threads);

/// A third of the area of the triangles around each vertex.
Eigen::VectorXd VertexAreas(const TriangleMesh& mesh);

} // namespace spectralwatermark

#endif

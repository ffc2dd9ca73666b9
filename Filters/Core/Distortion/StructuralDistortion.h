// SPDX-License-Identifier: BSD-3-Clause
/// How visibly a mesh was changed: structural distortion measures, from 0 (alike) towards 1.
///
/// MSDM: Lavoue, Drelie Gelasca, Dupont, Baskurt and Ebrahimi, "Perceptually driven 3D distance
/// metrics with application to watermarking", SPIE 6312, 2006. MSDM2: Lavoue, "A multiscale metric for
/// 3D mesh visual quality assessment", Computer Graphics Forum 30(5), 2011. Both compare statistics of
/// curvature in windows about corresponding points. Lengths are parts of D, the longest side of the
/// reference's bounding box, and curvatures are times D.
#ifndef SpectralWatermark_Core_Distortion_StructuralDistortion_h
#define SpectralWatermark_Core_Distortion_StructuralDistortion_h

#include "Core/Distortion/BallNeighbourhood.h"
#include "Core/Mesh/Measures.h"

#include <array>

namespace spectralwatermark
{

/// (|k_max| + |k_min|) / 2 at every vertex, in 1 / length: the two larger of the absolute eigenvalues
/// of the normal cycle's curvature tensor (Cohen-Steiner and Morvan, 2003), the sum over the edges in
/// the ball of dihedral angle times length times e e^T, over the area of a disc of that radius. Edges
/// that do not have two triangles are left out. Under the edges' length the measure grows.
Eigen::VectorXd NormalCycleCurvature(const BallNeighbourhood& balls, double radius, int threads);

/// Which windows, and how the differences in them make one number.
struct StructuralWindow
{
  double Radius;
  bool Gaussian; ///< weights by distance, with half the radius as deviation; else all alike
  int Exponent;  ///< ((L^a + C^a + S^a / 2) / 2.5)^(1/a)
};

/// The local measure at every vertex: `here` is the curvature (times D) of the windows' mesh, `there`
/// that of the other one at the corresponding point.
///
///     L = |m - m'| / (max(m, m') + 1)    C = |s - s'| / (max(s, s') + 1)    S = |s s' - c| / (s s' + 1)
///
/// with the means m, deviations s and covariance c of the vertices inside the window and of the points
/// where edges leave it. The 1 is not in the equations, it is in the author's own program (MEPP): flat
/// parts would divide rounding by rounding.
Eigen::VectorXd LocalStructuralDistortion(const BallNeighbourhood& balls,
  const Eigen::VectorXd& here, const Eigen::VectorXd& there, const StructuralWindow& window,
  int threads);

/// Pooling over the surface: the cubic mean of the vertices' values.
double CubicMean(const Eigen::VectorXd& values);

/// The longest side of the points' bounding box.
double LongestSide(const TriangleMesh::PointMatrix& points);

/// MSDM at every vertex, for meshes with the same triangles: curvatures from balls of 0.005 D,
/// windows of 0.015 D, exponent 3.
Eigen::VectorXd LocalMsdm(const BallNeighbourhood& reference, const BallNeighbourhood& distorted,
  double side, int threads);

/// Radii of the balls that MSDM2 takes curvatures from, in D; windows are five times as wide.
constexpr std::array<double, 3> Msdm2Radii = { 0.002, 0.003, 0.004 };

} // namespace spectralwatermark

#endif

// SPDX-License-Identifier: BSD-3-Clause
/// Structural distortion measures, which estimate how visible the change of a mesh is, from 0
/// (identical) towards 1.
///
/// MSDM: Lavoue, Drelie Gelasca, Dupont, Baskurt and Ebrahimi, "Perceptually driven 3D distance
/// metrics with application to watermarking", SPIE 6312, 2006. MSDM2: Lavoue, "A multiscale metric
/// for 3D mesh visual quality assessment", Computer Graphics Forum 30(5), 2011. Both compare
/// statistics of curvature in windows around corresponding points. Lengths are fractions of D, the
/// longest side of the reference's bounding box, and curvatures are multiplied by D.
#ifndef SpectralWatermark_Core_Distortion_StructuralDistortion_h
#define SpectralWatermark_Core_Distortion_StructuralDistortion_h

#include "Core/Distortion/BallNeighbourhood.h"

#include <array>

namespace spectralwatermark
{

/// The mean absolute curvature (|k_max| + |k_min|) / 2 at every vertex, in 1 / length.
///
/// k_max and k_min are the two eigenvalues of the normal cycle's curvature tensor (Cohen-Steiner
/// and Morvan, 2003) that are larger in absolute value. The tensor is the sum over the edges in the
/// ball of dihedral angle times length times e e^T, where e is the direction of the edge, divided
/// by the area of a disc of this radius. Edges that do not have two triangles are left out. For a
/// radius below the length of the edges the measure grows.
Eigen::VectorXd NormalCycleCurvature(const BallNeighbourhood& balls, double radius, int threads);

/// The windows of a structural measure, and how the differences in a window become one number.
struct StructuralWindow
{
  /// The radius, in the model's units.
  double Radius;

  /// Whether points are weighted by a Gaussian of their distance from the centre, with half the
  /// radius as standard deviation. Otherwise all have the same weight.
  bool Gaussian;

  /// The exponent a in ((L^a + C^a + S^a / 2) / 2.5)^(1/a).
  int Exponent;
};

/// The local measure at every vertex of the mesh of `balls`: `here` is the curvature of that mesh,
/// `there` that of the other mesh at the corresponding point, both multiplied by D.
///
///     L = |m - m'| / (max(m, m') + 1)
///     C = |s - s'| / (max(s, s') + 1)
///     S = |s s' - c| / (s s' + 1)
///
/// Here m are the means, s the deviations and c the covariance over the vertices inside the window
/// and the points where edges leave it. The 1 is not in the paper's equations but in its author's
/// program (MEPP): without it, flat regions would divide rounding errors by rounding errors.
Eigen::VectorXd LocalStructuralDistortion(const BallNeighbourhood& balls,
  const Eigen::VectorXd& here, const Eigen::VectorXd& there, const StructuralWindow& window,
  int threads);

/// The cubic mean of the values of all vertices, which pools a local measure over the surface.
double CubicMean(const Eigen::VectorXd& values);

/// The local MSDM at every vertex, for meshes with the same triangles: curvatures from balls of
/// radius 0.005 D, windows of radius 0.015 D, exponent 3. `side` is D, in the model's units.
Eigen::VectorXd LocalMsdm(const BallNeighbourhood& reference, const BallNeighbourhood& distorted,
  double side, int threads);

/// The radii of the balls from which MSDM2 takes curvatures, in D. Its windows are five times as
/// wide.
constexpr std::array<double, 3> Msdm2Radii = { 0.002, 0.003, 0.004 };

} // namespace spectralwatermark

#endif

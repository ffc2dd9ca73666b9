// SPDX-License-Identifier: BSD-3-Clause
/// The transform that a manifold harmonics basis defines (paper, 2.1.3).
#ifndef SpectralWatermark_Core_Harmonics_Transform_h
#define SpectralWatermark_Core_Harmonics_Transform_h

#include "Core/Harmonics/ManifoldHarmonics.h"

namespace spectralwatermark
{

/// An m x 3 matrix of descriptors (x~, y~, z~).
using Spectrum = Eigen::Matrix<double, Eigen::Dynamic, 3>;

/// Forward transform, eq. 6: row k is <x, H^k>, <y, H^k>, <z, H^k>. In length^2.
Spectrum ForwardTransform(const ManifoldHarmonics& harmonics,
  const TriangleMesh::PointMatrix& points);

/// Inverse transform, eq. 7: the points that these descriptors add up to. In length.
TriangleMesh::PointMatrix InverseTransform(const ManifoldHarmonics& harmonics,
  const Spectrum& spectrum);

/// Eq. 9: the length of each row.
Eigen::VectorXd Magnitudes(const Spectrum& spectrum);

/// Multiplies descriptor k by gains[k] and transforms back, with what lies outside the basis
/// (the residual) added unchanged or dropped.
TriangleMesh::PointMatrix FilterPoints(const ManifoldHarmonics& harmonics,
  const TriangleMesh::PointMatrix& points, const Eigen::VectorXd& gains, bool keepResidual);

} // namespace spectralwatermark

#endif

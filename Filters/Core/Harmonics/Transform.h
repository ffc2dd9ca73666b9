// SPDX-License-Identifier: BSD-3-Clause
/// The transform that a manifold harmonics basis defines (paper, 2.1.3).
#ifndef SpectralWatermark_Core_Harmonics_Transform_h
#define SpectralWatermark_Core_Harmonics_Transform_h

#include "Core/Harmonics/ManifoldHarmonics.h"

namespace spectralwatermark
{

/// The descriptors (x~, y~, z~) of m harmonics: an m x 3 matrix.
using Spectrum = Eigen::Matrix<double, Eigen::Dynamic, 3>;

/// Forward transform, eq. 6: row k is <x, H^k>, <y, H^k>, <z, H^k>, in length^2.
Spectrum ForwardTransform(const ManifoldHarmonics& harmonics,
  const TriangleMesh::PointMatrix& points);

/// Inverse transform, eq. 7: the points that the descriptors represent, in length.
TriangleMesh::PointMatrix InverseTransform(const ManifoldHarmonics& harmonics,
  const Spectrum& spectrum);

/// The magnitude of each descriptor, eq. 9: the length of its row.
Eigen::VectorXd Magnitudes(const Spectrum& spectrum);

/// Multiplies descriptor k by gains[k] and transforms back. The residual, which is the part of the
/// points outside the span of the basis, is added unchanged if `keepResidual` is set.
TriangleMesh::PointMatrix FilterPoints(const ManifoldHarmonics& harmonics,
  const TriangleMesh::PointMatrix& points, const Eigen::VectorXd& gains, bool keepResidual);

} // namespace spectralwatermark

#endif

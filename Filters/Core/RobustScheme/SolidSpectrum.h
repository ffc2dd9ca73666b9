// SPDX-License-Identifier: BSD-3-Clause
/// The Fourier transform of the solid that a mesh encloses.
#ifndef SpectralWatermark_Core_RobustScheme_SolidSpectrum_h
#define SpectralWatermark_Core_RobustScheme_SolidSpectrum_h

#include "Core/Mesh/TriangleMesh.h"

namespace spectralwatermark
{

/// The integral of exp(i k . x) over the interior of the solid for each row k of `waves`: first the
/// real parts, then the imaginary ones. `oriented` is consistently oriented, in the units in which
/// `waves` are reciprocal lengths. By the divergence theorem the integral is a sum over the
/// triangles; each term has a relative error below 1e-6. For an open surface the result is the sum
/// over its triangles.
Eigen::VectorXd SolidSpectrum(const TriangleMesh& oriented, const Eigen::MatrixXd& waves,
  int threads);

} // namespace spectralwatermark

#endif

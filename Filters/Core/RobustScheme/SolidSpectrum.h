// SPDX-License-Identifier: BSD-3-Clause
/// The Fourier transform of the solid that a mesh encloses.
#ifndef SpectralWatermark_Core_RobustScheme_SolidSpectrum_h
#define SpectralWatermark_Core_RobustScheme_SolidSpectrum_h

#include "Core/Mesh/TriangleMesh.h"

namespace spectralwatermark
{

/// The integral of exp(i k . x) over the inside of the solid, for each row k of `waves`: the real parts,
/// then the imaginary ones. By the divergence theorem a sum over triangles, with an error under 1e-6 of
/// each. For an open surface the sum over its triangles is taken as it is.
Eigen::VectorXd SolidSpectrum(const TriangleMesh& oriented, const Eigen::MatrixXd& waves,
  int threads);

} // namespace spectralwatermark

#endif

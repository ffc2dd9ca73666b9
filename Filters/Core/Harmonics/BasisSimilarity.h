// SPDX-License-Identifier: BSD-3-Clause
/// How much two bases have in common, component by component (paper, 2.2.1, eq. 8).
#ifndef SpectralWatermark_Core_Harmonics_BasisSimilarity_h
#define SpectralWatermark_Core_Harmonics_BasisSimilarity_h

#include "Core/Harmonics/ManifoldHarmonics.h"

namespace spectralwatermark
{

/// Eq. 8 with the reference's inner product, for as many components as both have:
/// |<G^k, H^k>| / (||G^k|| ||H^k||), from 0 to 1, G being `other` on the reference's vertices.
///
/// Where eigenvalues of the reference repeat, to `clusterTolerance` relative to their size, single
/// harmonics are not determined and H^k stands for their span: the norm of G^k's projection on it.
/// A G^k without any norm has similarity 0.
Eigen::VectorXd BasisSimilarity(const ManifoldHarmonics& reference, const Eigen::MatrixXd& other,
  double clusterTolerance);

} // namespace spectralwatermark

#endif

// SPDX-License-Identifier: BSD-3-Clause
/// The similarity of two bases, component by component (paper, 2.2.1, eq. 8).
#ifndef SpectralWatermark_Core_Harmonics_BasisSimilarity_h
#define SpectralWatermark_Core_Harmonics_BasisSimilarity_h

#include "Core/Harmonics/ManifoldHarmonics.h"

namespace spectralwatermark
{

/// The similarity |<G^k, H^k>| / (||G^k|| ||H^k||) of eq. 8, from 0 to 1, for as many components as
/// both bases have. The inner product is that of the reference basis H; G is `other`, given on the
/// reference's vertices.
///
/// Where eigenvalues of the reference repeat, to a relative distance of `clusterTolerance`, single
/// harmonics are not determined. H^k then stands for their span, and the similarity is the norm of
/// G^k's projection onto it, relative to that of G^k. A G^k of norm 0 has similarity 0.
Eigen::VectorXd BasisSimilarity(const ManifoldHarmonics& reference, const Eigen::MatrixXd& other,
  double clusterTolerance);

} // namespace spectralwatermark

#endif

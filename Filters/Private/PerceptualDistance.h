// SPDX-License-Identifier: BSD-3-Clause
#ifndef SpectralWatermark_Private_PerceptualDistance_h
#define SpectralWatermark_Private_PerceptualDistance_h

#include "Core/Support/Progress.h"

#include "Private/ClosestPoints.h"

namespace spectralwatermark
{

/// MSDM2 between surfaces, whatever their triangles (see Core/StructuralDistortion.h).
struct PerceptualDistance
{
  double Symmetric = 0.0; ///< the mean of both directions
  Eigen::VectorXd
    AtVertices; ///< of the distorted mesh: the local measure, mean of the three scales
};

PerceptualDistance Msdm2(const ClosestPoints& reference, const ClosestPoints& distorted,
  int threads, const Progress& progress);

} // namespace spectralwatermark

#endif

// SPDX-License-Identifier: BSD-3-Clause
/// How far two surfaces are apart, whatever their triangles.
#ifndef SpectralWatermark_Private_SurfaceDistance_h
#define SpectralWatermark_Private_SurfaceDistance_h

#include "Core/Mesh/TriangleMesh.h"
#include "Core/Support/Progress.h"

#include "Private/ClosestPoints.h"

namespace spectralwatermark
{

/// From one surface to another, in length.
struct SurfaceDistance
{
  double RootMeanSquare = 0.0; ///< over the area
  double Largest = 0.0;
  Eigen::VectorXd AtVertices; ///< of the first
};

/// Measured at the vertices and at points all over the triangles (as Cignoni, Rocchini and Scopigno,
/// "Metro", 1998), some 50,000 at least, each for the same area or less.
SurfaceDistance DistanceTo(const ClosestPoints& other, const TriangleMesh& mesh, int threads,
  const Progress& progress);

} // namespace spectralwatermark

#endif

// SPDX-License-Identifier: BSD-3-Clause
/// Compares two surfaces whatever their triangles: distances between them, and how visible the
/// difference is.
#ifndef SpectralWatermark_Private_SurfaceComparison_h
#define SpectralWatermark_Private_SurfaceComparison_h

#include "Core/Mesh/TriangleMesh.h"
#include "Core/Support/Progress.h"

#include "Private/ClosestPoints.h"

namespace spectralwatermark
{

/// The distance from one surface to another, in the model's units.
struct SurfaceDistance
{
  double RootMeanSquare = 0.0; ///< over the area of the first surface
  double Largest = 0.0;        ///< over all places where it is measured
  Eigen::VectorXd AtVertices;  ///< at each vertex of the first surface
};

/// Measures the distance from `mesh` to another surface, at the vertices and at 50,000 or more
/// points all over the triangles, each of which stands for at most 1/50,000 of the area (after
/// Cignoni, Rocchini and Scopigno, "Metro", 1998). Throws InvalidInput if no triangle of the other
/// surface has an area, Aborted.
SurfaceDistance DistanceTo(const ClosestPoints& other, const TriangleMesh& mesh, int threads,
  const Progress& progress);

/// The MSDM2 of two surfaces (see StructuralDistortion.h), from 0 (identical) towards 1.
struct PerceptualDistance
{
  /// The mean of the measures in both directions.
  double Symmetric = 0.0;

  /// The local measure at each vertex of the distorted mesh: the mean over the three scales.
  Eigen::VectorXd AtVertices;
};

/// Measures how visible the difference of two surfaces is. Throws InvalidInput if no triangle of
/// one surface has an area, Aborted.
PerceptualDistance Msdm2(const ClosestPoints& reference, const ClosestPoints& distorted,
  int threads, const Progress& progress);

} // namespace spectralwatermark

#endif

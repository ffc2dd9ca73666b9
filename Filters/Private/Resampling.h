// SPDX-License-Identifier: BSD-3-Clause
/// Changes the triangles of a surface, but hardly its shape, with VTK's own filters.
#ifndef SpectralWatermark_Private_Resampling_h
#define SpectralWatermark_Private_Resampling_h

#include "Core/Mesh/TriangleMesh.h"

class vtkAlgorithm;

namespace spectralwatermark
{

/// The subdivision rules that VTK provides.
enum class Subdivision
{
  Midpoint, ///< divides every triangle into four, in its plane
  Loop      ///< Loop's rule, which smooths; the surface must be manifold
};

/// Subdivides a mesh `times` times, by vtkLinearSubdivisionFilter or vtkLoopSubdivisionFilter.
/// Progress and abort go through `filter`. Throws InvalidInput if the surface cannot be subdivided,
/// Aborted.
TriangleMesh Subdivide(const TriangleMesh& mesh, Subdivision kind, int times, vtkAlgorithm* filter);

/// Resamples a surface with about `count` vertices at about equal distances. All triangles are
/// split until they are small; then the vertices in each cell of a grid are merged into one, where
/// the quadric error is smallest (vtkAdaptiveSubdivisionFilter, vtkQuadricClustering). Progress and
/// abort go through `filter`. Throws InvalidInput if no triangle is left, or if the grid would be
/// too fine or the triangles too many for the memory; Aborted.
TriangleMesh ResampleUniformly(const TriangleMesh& mesh, Index count, vtkAlgorithm* filter);

/// Resamples a surface as the zero level of its signed distance, on a grid with `resolution` steps
/// along the longest side of the bounding box (vtkStaticCellLocator, vtkFlyingEdges3D). Progress
/// and abort go through `filter`. Throws InvalidInput if the surface is not closed or thinner than
/// a step, or if the memory does not suffice; Aborted.
TriangleMesh ResampleByIsosurface(const TriangleMesh& mesh, int resolution, vtkAlgorithm* filter);

} // namespace spectralwatermark

#endif

// SPDX-License-Identifier: BSD-3-Clause
/// The same surface with other triangles, by VTK's own filters.
#ifndef SpectralWatermark_Private_Resampling_h
#define SpectralWatermark_Private_Resampling_h

#include "Core/Mesh/TriangleMesh.h"

class vtkAlgorithm;

namespace spectralwatermark
{

enum class Subdivision
{
  Midpoint, ///< every triangle into four, in its plane
  Loop      ///< Loop's, which smooths; the surface must be manifold
};

/// So many times, by vtkLinearSubdivisionFilter or vtkLoopSubdivisionFilter. Throws InvalidInput
/// where they cannot.
TriangleMesh Subdivide(const TriangleMesh& mesh, Subdivision kind, int times, vtkAlgorithm* filter);

/// Vertices about equally far from each other, about `count` of them: triangles split until all
/// are small, then vertices gathered in the cells of a grid, each where its quadric error is least
/// (vtkAdaptiveSubdivisionFilter, vtkQuadricClustering). Throws InvalidInput when nothing is left, and
/// where the grid would be too fine or the triangles too many: all of them take memory.
TriangleMesh ResampleUniformly(const TriangleMesh& mesh, Index count, vtkAlgorithm* filter);

/// The zero level of the signed distance to the surface, on a grid with `resolution` steps along
/// the longest side of the bounding box (vtkStaticCellLocator, vtkFlyingEdges3D). Throws
/// InvalidInput for a surface that is not closed.
TriangleMesh ResampleByIsosurface(const TriangleMesh& mesh, int resolution, vtkAlgorithm* filter);

} // namespace spectralwatermark

#endif

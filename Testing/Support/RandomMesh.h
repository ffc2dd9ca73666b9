// SPDX-License-Identifier: BSD-3-Clause
/// Meshes that no one would make, and some that one would.
#ifndef SpectralWatermark_Testing_RandomMesh_h
#define SpectralWatermark_Testing_RandomMesh_h

#include "Support/Bytes.h"

#include <vtkSmartPointer.h>

class vtkPolyData;

namespace fuzzing
{

/// A known shape or any polygons between any points, then damaged in any of these ways: other scales
/// (1e-30 to 1e30) and places, coordinates that are not finite, subnormal or huge, points at the same
/// place, polygons turned over, without area, doubled, left out, or of points that do not exist. Points
/// in float, double or whole numbers; polygons of any size, strips, lines and vertices; data of points,
/// cells and the mesh. At most a few hundred points.
vtkSmartPointer<vtkPolyData> RandomMesh(Bytes& bytes);

/// A copy with its points moved a little, or another mesh: what comes second into a filter of two.
vtkSmartPointer<vtkPolyData> Sibling(vtkPolyData* mesh, Bytes& bytes);

} // namespace fuzzing

#endif

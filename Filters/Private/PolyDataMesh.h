// SPDX-License-Identifier: BSD-3-Clause
/// Conversion between vtkPolyData and the meshes of Core.
#ifndef SpectralWatermark_Private_PolyDataMesh_h
#define SpectralWatermark_Private_PolyDataMesh_h

#include "Core/Mesh/TriangleMesh.h"

#include <vtkSmartPointer.h>
#include <vtkType.h>

#include <vector>

class vtkDoubleArray;
class vtkPolyData;

namespace spectralwatermark
{

/// What happens to points at exactly the same place.
enum class CoincidentPoints
{
  Merge, ///< they become one vertex
  Keep   ///< each becomes a vertex
};

/// The surface of a vtkPolyData as a mesh of Core, and how points and vertices correspond. Points
/// that no polygon uses have no vertex.
struct PolyDataMesh
{
  TriangleMesh Mesh;
  std::vector<Index> VertexOfPoint;     ///< the vertex of each point, -1 if it has none
  std::vector<vtkIdType> PointOfVertex; ///< the lowest point of each vertex
};

/// Converts polygons and strips to triangles. By default, points at exactly the same place become
/// one vertex, so that a model split along texture seams, or a triangle soup, is the surface that
/// it looks like; triangles that lose a corner this way are left out.
///
/// Throws InvalidInput if there are no points or no polygons, a cell uses a point that does not
/// exist, a coordinate is not finite or beyond 1e50, the mesh is smaller than 1e-50, no triangle
/// has three vertices, or the memory does not suffice.
PolyDataMesh ToMesh(vtkPolyData* input, CoincidentPoints coincident = CoincidentPoints::Merge);

/// The mesh as a vtkPolyData, with points in float or double. Throws InvalidInput like
/// CheckStorable().
vtkSmartPointer<vtkPolyData> ToPolyData(const TriangleMesh& mesh, bool storesFloat);

/// The same without the check, so that points may become infinite or not a number.
vtkSmartPointer<vtkPolyData> ToUncheckedPolyData(const TriangleMesh& mesh, bool storesFloat);

/// A point array whose tuples are the rows of `values` (a row per vertex); 0 at points without a
/// vertex.
vtkSmartPointer<vtkDoubleArray> ToPointArray(const char* name, const PolyDataMesh& mesh,
  const Eigen::MatrixXd& values);

/// Whether an OutputPointsPrecision property asks for points in float. The default precision is
/// that of the input, and float for integer coordinates.
bool StoresFloat(vtkPolyData* input, int outputPointsPrecision);

/// Sets the points of the output: those with a vertex to rows of `points`, the others to the
/// input's. Throws InvalidInput like CheckStorable().
void SetPoints(vtkPolyData* output, vtkPolyData* input, const PolyDataMesh& mesh,
  const TriangleMesh::PointMatrix& points, int outputPointsPrecision);

/// Throws InvalidInput if a coordinate is not finite, or if it is too large for a float and
/// `storesFloat` is set.
void CheckStorable(const TriangleMesh::PointMatrix& points, bool storesFloat);

/// The coordinates of the points with these ids, a row per id, in double.
TriangleMesh::PointMatrix PointsOf(vtkPolyData* mesh, const std::vector<vtkIdType>& ids);

/// The same for a filter's input: throws InvalidInput if a coordinate is not finite or beyond 1e50.
TriangleMesh::PointMatrix CheckedPoints(vtkPolyData* input, const std::vector<vtkIdType>& ids);

} // namespace spectralwatermark

#endif

// SPDX-License-Identifier: BSD-3-Clause
/// The seam between vtkPolyData and Core meshes.
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

/// What becomes of points at exactly the same place.
enum class CoincidentPoints
{
  Merge, ///< they are one vertex
  Keep   ///< each is a vertex
};

/// The surface of a vtkPolyData. By default, points at exactly the same place are one vertex, so
/// that a model split along texture seams, or a triangle soup, is the surface that it looks like;
/// triangles that thereby lose a corner are left out. Points that no polygon uses have no vertex.
struct PolyDataMesh
{
  TriangleMesh Mesh;
  std::vector<Index> VertexOfPoint;     ///< a vertex for each point, -1 where none
  std::vector<vtkIdType> PointOfVertex; ///< the lowest point of each vertex
};

/// Converts polygons and strips, triangulated where they are not triangles. Throws InvalidInput:
/// no points, no polygons, cells of points that do not exist, coordinates that are not finite or beyond
/// 1e50, a mesh smaller than 1e-50, no triangle with three vertices.
PolyDataMesh ToMesh(vtkPolyData* input, CoincidentPoints coincident = CoincidentPoints::Merge);

/// The mesh as a vtkPolyData, with points in float or double.
vtkSmartPointer<vtkPolyData> ToPolyData(const TriangleMesh& mesh, bool storesFloat);

/// A point array whose tuples are rows of `values` (a row per vertex); 0 at points without one.
vtkSmartPointer<vtkDoubleArray> ToPointArray(const char* name, const PolyDataMesh& mesh,
  const Eigen::MatrixXd& values);

/// Whether points are to be stored as float: the OutputPointsPrecision property, where the
/// default follows the input (and float for integer coordinates).
bool StoresFloat(vtkPolyData* input, int outputPointsPrecision);

/// Gives the output new points: those with a vertex from `points`, the others from the input.
void SetPoints(vtkPolyData* output, vtkPolyData* input, const PolyDataMesh& mesh,
  const TriangleMesh::PointMatrix& points, int outputPointsPrecision);

/// Throws InvalidInput when a coordinate is not finite, or beyond what float holds where it is to be one.
void CheckStorable(const TriangleMesh::PointMatrix& points, bool storesFloat);

/// Coordinates of some points of a mesh, a row per id, in double.
TriangleMesh::PointMatrix PointsOf(vtkPolyData* mesh, const std::vector<vtkIdType>& ids);

/// The same of an input. Throws InvalidInput when one is
/// not finite or beyond 1e50.
TriangleMesh::PointMatrix CheckedPoints(vtkPolyData* input, const std::vector<vtkIdType>& ids);

} // namespace spectralwatermark

#endif

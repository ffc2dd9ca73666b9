// SPDX-License-Identifier: BSD-3-Clause
/// Lengths, areas, volumes and normals of a triangle mesh.
#ifndef SpectralWatermark_Core_Mesh_Measures_h
#define SpectralWatermark_Core_Mesh_Measures_h

#include "Core/Mesh/TriangleMesh.h"

#include <array>

namespace spectralwatermark
{

/// The corners of a triangle.
using Corners = std::array<Eigen::RowVector3d, 3>;
Corners CornersOf(const TriangleMesh& mesh, Index triangle);

/// The volume of the tetrahedron of these corners and the origin: positive where the origin is behind the
/// triangle.
double SignedVolume(const Corners& corners);

/// The normal of a triangle; its length is twice the area.
Eigen::RowVector3d AreaVector(const TriangleMesh& mesh, Index triangle);

/// Unit vertex normals, weighted by triangle area; 0 at a vertex without area. n x 3.
TriangleMesh::PointMatrix VertexNormals(const TriangleMesh& mesh);

/// A third of the area of the triangles around each vertex.
Eigen::VectorXd VertexAreas(const TriangleMesh& mesh);

/// The mean length of the edges, each counted once; 0 without any: the paper's e-bar in 3.3.3.
double MeanEdgeLength(const TriangleMesh& mesh);

/// The mean distance of the vertices to their centre: the unit of length of the benchmark of Wang, Lavoue,
/// Denis and Baskurt (2010).
double MeanDistanceToCentre(const TriangleMesh& mesh);

/// The diagonal of the points' bounding box: the unit of distortion.
double BoundingBoxDiagonal(const TriangleMesh::PointMatrix& points);

/// The longest side of the points' bounding box.
double LongestSide(const TriangleMesh::PointMatrix& points);

} // namespace spectralwatermark

#endif

// SPDX-License-Identifier: BSD-3-Clause
/// Lengths, areas, volumes and normals of a triangle mesh.
#ifndef SpectralWatermark_Core_Mesh_Measures_h
#define SpectralWatermark_Core_Mesh_Measures_h

#include "Core/Mesh/TriangleMesh.h"

#include <array>

namespace spectralwatermark
{

/// The positions of a triangle's corners.
using Corners = std::array<Eigen::RowVector3d, 3>;

/// The corners of triangle `triangle` of a mesh.
Corners CornersOf(const TriangleMesh& mesh, Index triangle);

/// The signed volume of the tetrahedron of these corners and the origin; positive if the origin is
/// behind the triangle.
double SignedVolume(const Corners& corners);

/// The normal of a triangle; its length is twice the triangle's area.
Eigen::RowVector3d AreaVector(const TriangleMesh& mesh, Index triangle);

/// Unit vertex normals, weighted by triangle area, n x 3; 0 at a vertex without area.
TriangleMesh::PointMatrix VertexNormals(const TriangleMesh& mesh);

/// A third of the area of the triangles around each vertex.
Eigen::VectorXd VertexAreas(const TriangleMesh& mesh);

/// The mean edge length, the paper's e-bar in 3.3.3. Each edge counts once; 0 without edges.
double MeanEdgeLength(const TriangleMesh& mesh);

/// The mean distance of the vertices to their centroid, the unit of length in the benchmark of
/// Wang, Lavoue, Denis and Baskurt (2010).
double MeanDistanceToCentre(const TriangleMesh& mesh);

/// The length of the diagonal of the points' bounding box, the unit of distortion.
double BoundingBoxDiagonal(const TriangleMesh::PointMatrix& points);

/// The longest side of the points' bounding box.
double LongestSide(const TriangleMesh::PointMatrix& points);

} // namespace spectralwatermark

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef SpectralWatermark_Core_TriangleMesh_h
#define SpectralWatermark_Core_TriangleMesh_h

#include <Eigen/Core>

#include <map>
#include <utility>
#include <vector>

namespace spectralwatermark
{

using Index = Eigen::Index;

/// A triangle mesh: any topology, any number of components, boundaries and non-manifold edges
/// allowed. Vertices are expected to be distinct points (the seam to VTK merges coincident ones).
struct TriangleMesh
{
  using PointMatrix = Eigen::Matrix<double, Eigen::Dynamic, 3>;
  using TriangleMatrix = Eigen::Matrix<Index, Eigen::Dynamic, 3, Eigen::RowMajor>;

  PointMatrix Points;       ///< n x 3, in the model's units
  TriangleMatrix Triangles; ///< t x 3 indices of points

  Index NumberOfVertices() const { return this->Points.rows(); }
  Index NumberOfTriangles() const { return this->Triangles.rows(); }
};

/// Whether both have as many vertices, and the same triangles in the same order.
bool SameTriangles(const TriangleMesh& a, const TriangleMesh& b);

/// An undirected edge, smaller index first.
using Edge = std::pair<Index, Index>;

/// Each edge once, sorted.
std::vector<Edge> UniqueEdges(const TriangleMesh& mesh);

/// The triangles of each edge: one on a boundary, two inside a manifold.
std::map<Edge, std::vector<Index>> TrianglesOfEdges(const TriangleMesh& mesh);

/// Mean length over UniqueEdges(), 0 without any: the paper's e-bar in 3.3.3.
double MeanEdgeLength(const TriangleMesh& mesh);

/// Whether an edge of the triangle goes from one vertex to the other.
bool GoesAlong(const TriangleMesh& mesh, Index triangle, Index from, Index to);

/// Normal of a triangle, twice as long as its area is large.
Eigen::RowVector3d AreaVector(const TriangleMesh& mesh, Index triangle);

/// Unit vertex normals, weighted by triangle area; 0 at a vertex without area. n x 3.
TriangleMesh::PointMatrix VertexNormals(const TriangleMesh& mesh);

} // namespace spectralwatermark

#endif

// SPDX-License-Identifier: BSD-3-Clause
/// The triangle mesh that all of Core works on.
#ifndef SpectralWatermark_Core_Mesh_TriangleMesh_h
#define SpectralWatermark_Core_Mesh_TriangleMesh_h

#include "Core/Support/Types.h"

#include <array>
#include <vector>

namespace spectralwatermark
{

/// A triangle mesh of any topology, with any number of components; boundaries and non-manifold
/// edges are allowed. Vertices should be distinct points (the conversion from VTK merges coincident
/// ones).
struct TriangleMesh
{
  using PointMatrix = Eigen::Matrix<double, Eigen::Dynamic, 3>;
  using TriangleMatrix = Eigen::Matrix<Index, Eigen::Dynamic, 3, Eigen::RowMajor>;

  PointMatrix Points;       ///< n x 3, in the model's units
  TriangleMatrix Triangles; ///< t x 3 indices of points

  /// The number of points, n.
  Index NumberOfVertices() const { return this->Points.rows(); }

  /// The number of triangles, t.
  Index NumberOfTriangles() const { return this->Triangles.rows(); }
};

/// A list of triangles as the rows of a matrix.
TriangleMesh::TriangleMatrix ToTriangleMatrix(const std::vector<std::array<Index, 3>>& triangles);

/// Whether two meshes have the same number of vertices and the same triangles in the same order.
bool SameTriangles(const TriangleMesh& a, const TriangleMesh& b);

} // namespace spectralwatermark

#endif

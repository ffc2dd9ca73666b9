// SPDX-License-Identifier: BSD-3-Clause
#ifndef SpectralWatermark_Core_Mesh_TriangleMesh_h
#define SpectralWatermark_Core_Mesh_TriangleMesh_h

#include "Core/Support/Types.h"

#include <array>
#include <vector>

namespace spectralwatermark
{

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

/// A list of triangles as the rows of a matrix.
TriangleMesh::TriangleMatrix ToTriangleMatrix(const std::vector<std::array<Index, 3>>& triangles);

/// Whether both have as many vertices, and the same triangles in the same order.
bool SameTriangles(const TriangleMesh& a, const TriangleMesh& b);

} // namespace spectralwatermark

#endif

// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Mesh/TriangleMesh.h"

namespace spectralwatermark
{

TriangleMesh::TriangleMatrix ToTriangleMatrix(const std::vector<std::array<Index, 3>>& triangles)
{
  TriangleMesh::TriangleMatrix matrix(static_cast<Index>(triangles.size()), 3);
  for (Index t = 0; t < matrix.rows(); ++t)
  {
    const auto& [a, b, c] = triangles[t];
    matrix.row(t) << a, b, c;
  }
  return matrix;
}

bool SameTriangles(const TriangleMesh& a, const TriangleMesh& b)
{
  return a.NumberOfVertices() == b.NumberOfVertices() &&
    a.NumberOfTriangles() == b.NumberOfTriangles() && a.Triangles == b.Triangles;
}

} // namespace spectralwatermark

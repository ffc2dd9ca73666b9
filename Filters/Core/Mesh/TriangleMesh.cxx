// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Mesh/TriangleMesh.h"

namespace spectralwatermark
{

bool SameTriangles(const TriangleMesh& a, const TriangleMesh& b)
{
  return a.NumberOfVertices() == b.NumberOfVertices() &&
    a.NumberOfTriangles() == b.NumberOfTriangles() && a.Triangles == b.Triangles;
}

} // namespace spectralwatermark

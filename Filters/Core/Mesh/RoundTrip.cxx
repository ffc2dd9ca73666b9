// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Mesh/RoundTrip.h"

#include <numeric>

namespace spectralwatermark
{

TriangleMesh::PointMatrix RoundTripResult::ToStored(const TriangleMesh::PointMatrix& rows) const
{
  const auto count = static_cast<Index>(this->VertexOf.size());
  TriangleMesh::PointMatrix stored = TriangleMesh::PointMatrix::Zero(count, 3);
  for (Index v = 0; v < count; ++v)
  {
    const Index vertex = this->VertexOf[v];
    if (vertex >= 0)
    {
      stored.row(v) = rows.row(vertex);
    }
  }
  return stored;
}

RoundTrip ExactRoundTrip(const TriangleMesh& mesh)
{
  return [&mesh](const TriangleMesh::PointMatrix& points)
  {
    RoundTripResult stored{ { points, mesh.Triangles }, {}, points };
    stored.VertexOf.resize(points.rows());
    std::iota(stored.VertexOf.begin(), stored.VertexOf.end(), Index{ 0 });
    return stored;
  };
}

} // namespace spectralwatermark

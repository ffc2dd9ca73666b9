// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Mesh/EdgeTopology.h"

#include <algorithm>

namespace spectralwatermark
{

namespace
{

// Calls visit(edge, triangle) for the three edges of every triangle.
template <typename Visit>
void ForEachSide(const TriangleMesh& mesh, const Visit& visit)
{
  for (Index t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      const Index a = mesh.Triangles(t, corner);
      const Index b = mesh.Triangles(t, (corner + 1) % 3);
      visit(Edge(std::min(a, b), std::max(a, b)), t);
    }
  }
}

} // namespace

EdgeTopology::EdgeTopology(const TriangleMesh& mesh)
{
  std::vector<std::pair<Edge, Index>> sides;
  sides.reserve(3 * mesh.NumberOfTriangles());
  ForEachSide(mesh, [&sides](const Edge& edge, Index t) { sides.emplace_back(edge, t); });
  std::sort(sides.begin(), sides.end());
  this->Triangles.reserve(sides.size());
  for (const auto& [edge, triangle] : sides)
  {
    if (this->EdgeList.empty() || this->EdgeList.back() != edge)
    {
      this->EdgeList.push_back(edge);
      this->Starts.push_back(static_cast<Index>(this->Triangles.size()));
    }
    this->Triangles.push_back(triangle);
  }
  this->Starts.push_back(static_cast<Index>(this->Triangles.size()));
}

EdgeTopology::Sides EdgeTopology::TrianglesBetween(Index a, Index b) const
{
  const auto at = std::lower_bound(this->EdgeList.begin(), this->EdgeList.end(),
    Edge(std::min(a, b), std::max(a, b)));
  return this->TrianglesOf(at - this->EdgeList.begin());
}

std::vector<Edge> UniqueEdges(const TriangleMesh& mesh)
{
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.NumberOfTriangles());
  ForEachSide(mesh, [&edges](const Edge& edge, Index /*triangle*/) { edges.push_back(edge); });
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

bool HasDirectedEdge(const TriangleMesh& mesh, Index triangle, Index from, Index to)
{
  const auto corners = mesh.Triangles.row(triangle);
  return (corners[0] == from && corners[1] == to) || (corners[1] == from && corners[2] == to) ||
    (corners[2] == from && corners[0] == to);
}

} // namespace spectralwatermark

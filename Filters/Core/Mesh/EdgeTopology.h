// SPDX-License-Identifier: BSD-3-Clause
/// The edges of a triangle mesh, and the triangles at each edge.
#ifndef SpectralWatermark_Core_Mesh_EdgeTopology_h
#define SpectralWatermark_Core_Mesh_EdgeTopology_h

#include "Core/Mesh/TriangleMesh.h"

#include <utility>
#include <vector>

namespace spectralwatermark
{

/// An undirected edge: its two vertices, smaller index first.
using Edge = std::pair<Index, Index>;

/// The edges of a mesh in sorted order, each once, with its triangles. There is one triangle at an
/// edge on a boundary and there are two at an edge inside a manifold. The arrays are flat, so that
/// a million triangles cost one sort and no small allocations.
class EdgeTopology
{
public:
  explicit EdgeTopology(const TriangleMesh& mesh);

  /// All edges, sorted.
  const std::vector<Edge>& Edges() const { return this->EdgeList; }

  /// Calls visit(edge, sides) for every edge in order; `sides` holds its triangles, ascending.
  template <typename Visit>
  void ForEachEdge(const Visit& visit) const
  {
    for (Index e = 0; e < static_cast<Index>(this->EdgeList.size()); ++e)
    {
      visit(this->EdgeList[e], this->TrianglesOf(e));
    }
  }

  /// The triangles at an edge, ascending; valid as long as the topology.
  struct Sides
  {
    const Index* First;
    Index Count;

    Index size() const { return this->Count; }
    Index operator[](Index side) const { return this->First[side]; }
  };

  /// The triangles at the edge with this number.
  Sides TrianglesOf(Index edge) const
  {
    return { this->Triangles.data() + this->Starts[edge],
      this->Starts[edge + 1] - this->Starts[edge] };
  }

  /// The triangles at the edge between two vertices. The edge must exist.
  Sides TrianglesBetween(Index a, Index b) const;

private:
  std::vector<Edge> EdgeList;
  std::vector<Index> Starts;    // where each edge's triangles begin in Triangles, and the end
  std::vector<Index> Triangles; // the triangles at each edge, edge by edge
};

/// All edges, each once, sorted.
std::vector<Edge> UniqueEdges(const TriangleMesh& mesh);

/// Whether the triangle's boundary, in the order of its corners, has the directed edge from `from`
/// to `to`.
bool HasDirectedEdge(const TriangleMesh& mesh, Index triangle, Index from, Index to);

} // namespace spectralwatermark

#endif

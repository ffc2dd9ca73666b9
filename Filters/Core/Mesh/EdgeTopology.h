// SPDX-License-Identifier: BSD-3-Clause
/// The edges of a triangle mesh, and the triangles at each of them.
#ifndef SpectralWatermark_Core_Mesh_EdgeTopology_h
#define SpectralWatermark_Core_Mesh_EdgeTopology_h

#include "Core/Mesh/TriangleMesh.h"

#include <utility>
#include <vector>

namespace spectralwatermark
{

/// An undirected edge, smaller index first.
using Edge = std::pair<Index, Index>;

/// The edges of a mesh in sorted order, each once, with its triangles: one on a boundary, two inside a
/// manifold. Flat arrays, so that a million triangles cost three sorts and no small allocations.
class EdgeTopology
{
public:
  explicit EdgeTopology(const TriangleMesh& mesh);

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

  /// Some consecutive triangles; valid as long as the topology.
  struct Sides
  {
    const Index* First;
    Index Count;

    Index size() const { return this->Count; }
    Index operator[](Index side) const { return this->First[side]; }
  };

  /// The triangles of the edge with this number, ascending.
  Sides TrianglesOf(Index edge) const
  {
    return { this->Triangles.data() + this->Starts[edge],
      this->Starts[edge + 1] - this->Starts[edge] };
  }

  /// The triangles of the edge between two vertices, which must exist.
  Sides TrianglesBetween(Index a, Index b) const;

private:
  std::vector<Edge> EdgeList;
  std::vector<Index> Starts;    // of each edge in Triangles, and the end
  std::vector<Index> Triangles; // edge by edge
};

/// Every edge once, sorted.
std::vector<Edge> UniqueEdges(const TriangleMesh& mesh);

/// Whether the boundary of the triangle runs from the one vertex directly to the other.
bool HasDirectedEdge(const TriangleMesh& mesh, Index triangle, Index from, Index to);

} // namespace spectralwatermark

#endif

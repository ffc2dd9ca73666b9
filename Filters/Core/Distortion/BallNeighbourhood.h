// SPDX-License-Identifier: BSD-3-Clause
/// The neighbourhoods of the vertices of a mesh inside balls of a given radius.
#ifndef SpectralWatermark_Core_Distortion_BallNeighbourhood_h
#define SpectralWatermark_Core_Distortion_BallNeighbourhood_h

#include "Core/Mesh/EdgeTopology.h"

#include <vector>

namespace spectralwatermark
{

/// The part of the mesh's edges inside a ball around a vertex that is connected to that vertex
/// within the ball. The mesh must outlive the object.
class BallNeighbourhood
{
public:
  explicit BallNeighbourhood(const TriangleMesh& mesh);

  /// The part of an edge inside the ball.
  struct ClippedEdge
  {
    Index Edge;   ///< number of the edge in Edges()
    Index From;   ///< the end that is inside
    Index To;     ///< the other end
    double Share; ///< share of the edge that is inside, counted from `From`; 1 if both ends are
  };

  /// Memory that grows with the mesh, to be used for one neighbourhood after another.
  struct Workspace
  {
    std::vector<Index> Visitor;            ///< for each vertex, the last centre it was reached from
    std::vector<Index> Inside;             ///< the vertices in the ball, the centre first
    std::vector<ClippedEdge> ClippedEdges; ///< every edge with an end in the ball, once
  };
  Workspace MakeWorkspace() const;

  /// Fills workspace.Inside and workspace.ClippedEdges for the ball with this centre, a vertex, and
  /// this radius, in the model's units. A second call for the same centre needs a second workspace.
  void Around(Index centre, double radius, Workspace& workspace) const;

  const TriangleMesh& Mesh() const { return this->Surface; }
  const EdgeTopology& Topology() const { return this->Connectivity; }
  const std::vector<Edge>& Edges() const { return this->Connectivity.Edges(); }

private:
  const TriangleMesh& Surface;
  EdgeTopology Connectivity;
  std::vector<Index> Starts;          // where the edges of each vertex begin in EdgesOfVertices
  std::vector<Index> EdgesOfVertices; // the numbers of the edges, vertex by vertex
};

} // namespace spectralwatermark

#endif

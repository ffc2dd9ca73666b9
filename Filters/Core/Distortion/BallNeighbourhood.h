// SPDX-License-Identifier: BSD-3-Clause
#ifndef SpectralWatermark_Core_Distortion_BallNeighbourhood_h
#define SpectralWatermark_Core_Distortion_BallNeighbourhood_h

#include "Core/Mesh/EdgeTopology.h"

#include <vector>

namespace spectralwatermark
{

/// The part of the mesh's edges inside a ball around a vertex that is connected to that vertex within the
/// ball.
class BallNeighbourhood
{
public:
  explicit BallNeighbourhood(const TriangleMesh& mesh);

  /// A part of an edge: from vertex `From`, which is inside, this share of the way to `To`. 1 when
  /// both are inside.
  struct ClippedEdge
  {
    Index Edge;
    Index From;
    Index To;
    double Share;
  };

  /// A mesh's worth of memory that one walk after another uses.
  struct Workspace
  {
    std::vector<Index> Visitor; ///< of each vertex: the last centre it was reached from
    std::vector<Index> Inside;
    std::vector<ClippedEdge> ClippedEdges;
  };
  Workspace MakeWorkspace() const;

  /// Fills workspace.Inside with the vertices in the ball, the centre first, and workspace.ClippedEdges with
  /// every edge that has an end among them, once. Two walks around the same centre need two workspaces.
  void Around(Index centre, double radius, Workspace& workspace) const;

  const TriangleMesh& Mesh() const { return this->Surface; }
  const EdgeTopology& Topology() const { return this->Connectivity; }
  const std::vector<Edge>& Edges() const { return this->Connectivity.Edges(); }

private:
  const TriangleMesh& Surface;
  EdgeTopology Connectivity;
  std::vector<Index> Starts; // of each vertex's edges in EdgesOfVertices
  std::vector<Index> EdgesOfVertices;
};

} // namespace spectralwatermark

#endif

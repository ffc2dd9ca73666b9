// SPDX-License-Identifier: BSD-3-Clause
#ifndef SpectralWatermark_Core_EdgesInBalls_h
#define SpectralWatermark_Core_EdgesInBalls_h

#include "TriangleMesh.h"

#include <vector>

namespace spectralwatermark
{

/// What of a mesh's edges lies in a ball about a vertex, as far as it hangs together with the vertex.
class EdgesInBalls
{
public:
  explicit EdgesInBalls(const TriangleMesh& mesh);

  /// A part of an edge: from vertex `From`, which is inside, this share of the way to `To`. 1 when
  /// both are inside.
  struct Piece
  {
    Index Edge;
    Index From;
    Index To;
    double Share;
  };

  /// A mesh's worth of memory that one walk after another uses.
  struct Room
  {
    std::vector<Index> Visitor; ///< of each vertex: the last centre it was reached from
    std::vector<Index> Inside;
    std::vector<Piece> Pieces;
  };
  Room MakeRoom() const;

  /// Fills room.Inside with the vertices in the ball, the centre first, and room.Pieces with every
  /// edge that has an end among them, once. Walks about the same centre need a new room.
  void Around(Index centre, double radius, Room& room) const;

  const TriangleMesh& Mesh() const { return this->Surface; }
  const std::vector<Edge>& Edges() const { return this->EdgeList; }

private:
  const TriangleMesh& Surface;
  std::vector<Edge> EdgeList;
  std::vector<Index> Starts; // of each vertex's edges in EdgesOfVertices
  std::vector<Index> EdgesOfVertices;
};

} // namespace spectralwatermark

#endif

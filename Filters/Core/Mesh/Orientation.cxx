// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Mesh/Orientation.h"

#include "Core/Mesh/EdgeTopology.h"
#include "Core/Mesh/Measures.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace spectralwatermark
{

namespace
{

struct Neighbour
{
  Index Triangle;
  bool ConsistentlyOriented;
};

std::vector<std::vector<Neighbour>> NeighboursAcrossEdges(const TriangleMesh& mesh)
{
  std::vector<std::vector<Neighbour>> neighbours(mesh.NumberOfTriangles());
  EdgeTopology(mesh).ForEachEdge(
    [&](const Edge& edge, const EdgeTopology::Sides& sides)
    {
      if (sides.size() == 2)
      {
        const bool consistent = HasDirectedEdge(mesh, sides[0], edge.first, edge.second) !=
          HasDirectedEdge(mesh, sides[1], edge.first, edge.second);
        neighbours[sides[0]].push_back({ sides[1], consistent });
        neighbours[sides[1]].push_back({ sides[0], consistent });
      }
    });
  return neighbours;
}

void FlipTriangle(TriangleMesh& mesh, Index t)
{
  std::swap(mesh.Triangles(t, 1), mesh.Triangles(t, 2));
}

enum class State : signed char
{
  Unvisited,
  Kept,
  Flipped
};

State Opposite(State state)
{
  return state == State::Kept ? State::Flipped : State::Kept;
}

} // namespace

TriangleMesh Oriented(const TriangleMesh& mesh)
{
  TriangleMesh oriented = mesh;
  const std::vector<std::vector<Neighbour>> neighbours = NeighboursAcrossEdges(mesh);
  const Eigen::RowVector3d centre = mesh.Points.colwise().mean();
  std::vector<State> states(neighbours.size(), State::Unvisited);
  for (Index seed = 0; seed < mesh.NumberOfTriangles(); ++seed)
  {
    if (states[seed] != State::Unvisited)
    {
      continue;
    }
    states[seed] = State::Kept;
    std::vector<Index> component = { seed };
    double volume = 0.0;
    // The component grows inside the loop.
    for (std::size_t next = 0; next < component.size(); ++next)
    {
      const Index t = component[next];
      if (states[t] == State::Flipped)
      {
        FlipTriangle(oriented, t);
      }
      const Corners c = CornersOf(oriented, t);
      volume += SignedVolume({ c[0] - centre, c[1] - centre, c[2] - centre });
      for (const Neighbour& neighbour : neighbours[t])
      {
        if (states[neighbour.Triangle] == State::Unvisited)
        {
          states[neighbour.Triangle] =
            neighbour.ConsistentlyOriented ? states[t] : Opposite(states[t]);
          component.push_back(neighbour.Triangle);
        }
      }
    }
    if (volume < 0.0)
    {
      std::for_each(component.begin(), component.end(),
        [&](Index t) { FlipTriangle(oriented, t); });
    }
  }
  return oriented;
}

} // namespace spectralwatermark

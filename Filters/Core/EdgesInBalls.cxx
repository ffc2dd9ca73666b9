// SPDX-License-Identifier: BSD-3-Clause
#include "EdgesInBalls.h"

#include <algorithm>
#include <cmath>

namespace spectralwatermark
{

namespace
{

// How far along from p, which is inside, to q the sphere is met: the positive root of
// |p - o + t (q - p)| = r.
double ShareInside(const Eigen::RowVector3d& p, const Eigen::RowVector3d& q,
  const Eigen::RowVector3d& centre, double radius)
{
  const Eigen::RowVector3d along = q - p;
  const Eigen::RowVector3d from = p - centre;
  const double a = along.squaredNorm();
  const double b = along.dot(from);
  const double c = std::min(0.0, from.squaredNorm() - radius * radius);
  return std::clamp((std::sqrt(b * b - a * c) - b) / a, 0.0, 1.0);
}

} // namespace

EdgesInBalls::EdgesInBalls(const TriangleMesh& mesh)
  : Surface(mesh)
  , EdgeList(UniqueEdges(mesh))
  , Starts(static_cast<std::size_t>(mesh.NumberOfVertices()) + 1, 0)
  , EdgesOfVertices(2 * this->EdgeList.size())
{
  for (const auto& [i, j] : this->EdgeList)
  {
    ++this->Starts[static_cast<std::size_t>(i) + 1];
    ++this->Starts[static_cast<std::size_t>(j) + 1];
  }
  for (std::size_t v = 1; v < this->Starts.size(); ++v)
  {
    this->Starts[v] += this->Starts[v - 1];
  }
  std::vector<Index> next = this->Starts;
  for (std::size_t e = 0; e < this->EdgeList.size(); ++e)
  {
    for (const Index v : { this->EdgeList[e].first, this->EdgeList[e].second })
    {
      Index& at = next[static_cast<std::size_t>(v)];
      this->EdgesOfVertices[static_cast<std::size_t>(at++)] = static_cast<Index>(e);
    }
  }
}

EdgesInBalls::Room EdgesInBalls::MakeRoom() const
{
  return { std::vector<Index>(static_cast<std::size_t>(this->Surface.NumberOfVertices()), -1), {},
    {} };
}

void EdgesInBalls::Around(Index centre, double radius, Room& room) const
{
  const TriangleMesh::PointMatrix& points = this->Surface.Points;
  const Eigen::RowVector3d origin = points.row(centre);
  room.Inside.assign(1, centre);
  room.Pieces.clear();
  room.Visitor[static_cast<std::size_t>(centre)] = centre;
  for (std::size_t at = 0; at < room.Inside.size(); ++at) // grows as it goes
  {
    const Index v = room.Inside[at];
    const Index end = this->Starts[static_cast<std::size_t>(v) + 1];
    for (Index k = this->Starts[static_cast<std::size_t>(v)]; k < end; ++k)
    {
      const Index edge = this->EdgesOfVertices[static_cast<std::size_t>(k)];
      const auto& [first, second] = this->EdgeList[static_cast<std::size_t>(edge)];
      const Index w = first == v ? second : first;
      if ((points.row(w) - origin).squaredNorm() >= radius * radius)
      {
        room.Pieces.push_back(
          { edge, v, w, ShareInside(points.row(v), points.row(w), origin, radius) });
        continue;
      }
      Index& visitor = room.Visitor[static_cast<std::size_t>(w)];
      if (visitor != centre)
      {
        visitor = centre;
        room.Inside.push_back(w);
      }
      if (v < w) // else it is taken from there
      {
        room.Pieces.push_back({ edge, v, w, 1.0 });
      }
    }
  }
}

} // namespace spectralwatermark

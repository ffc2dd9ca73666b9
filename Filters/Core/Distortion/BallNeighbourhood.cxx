// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Distortion/BallNeighbourhood.h"

#include <algorithm>
#include <cmath>

namespace spectralwatermark
{

namespace
{

// The share of the way from p, which is inside the ball, to q at which the sphere is met: the
// positive root t of |p - centre + t (q - p)| = radius.
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

BallNeighbourhood::BallNeighbourhood(const TriangleMesh& mesh)
  : Surface(mesh)
  , Connectivity(mesh)
  , Starts(mesh.NumberOfVertices() + 1, 0)
  , EdgesOfVertices(2 * this->Edges().size())
{
  for (const auto& [i, j] : this->Edges())
  {
    ++this->Starts[i + 1];
    ++this->Starts[j + 1];
  }
  for (std::size_t v = 1; v < this->Starts.size(); ++v)
  {
    this->Starts[v] += this->Starts[v - 1];
  }
  std::vector<Index> next = this->Starts;
  for (std::size_t e = 0; e < this->Edges().size(); ++e)
  {
    for (const Index v : { this->Edges()[e].first, this->Edges()[e].second })
    {
      Index& at = next[v];
      this->EdgesOfVertices[at++] = static_cast<Index>(e);
    }
  }
}

BallNeighbourhood::Workspace BallNeighbourhood::MakeWorkspace() const
{
  return { std::vector<Index>(this->Surface.NumberOfVertices(), -1), {}, {} };
}

void BallNeighbourhood::Around(Index centre, double radius, Workspace& workspace) const
{
  const TriangleMesh::PointMatrix& points = this->Surface.Points;
  const Eigen::RowVector3d origin = points.row(centre);
  workspace.Inside.assign(1, centre);
  workspace.ClippedEdges.clear();
  workspace.Visitor[centre] = centre;
  // The loop appends to the vertices that it runs over.
  for (std::size_t at = 0; at < workspace.Inside.size(); ++at)
  {
    const Index v = workspace.Inside[at];
    const Index end = this->Starts[v + 1];
    for (Index k = this->Starts[v]; k < end; ++k)
    {
      const Index edge = this->EdgesOfVertices[k];
      const auto& [first, second] = this->Edges()[edge];
      const Index w = first == v ? second : first;
      if ((points.row(w) - origin).squaredNorm() >= radius * radius)
      {
        workspace.ClippedEdges.push_back(
          { edge, v, w, ShareInside(points.row(v), points.row(w), origin, radius) });
        continue;
      }
      Index& visitor = workspace.Visitor[w];
      if (visitor != centre)
      {
        visitor = centre;
        workspace.Inside.push_back(w);
      }
      // An edge with both ends inside is added from its smaller end only.
      if (v < w)
      {
        workspace.ClippedEdges.push_back({ edge, v, w, 1.0 });
      }
    }
  }
}

} // namespace spectralwatermark

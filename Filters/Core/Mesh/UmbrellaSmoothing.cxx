// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Mesh/UmbrellaSmoothing.h"

namespace spectralwatermark
{

UmbrellaSmoothing::UmbrellaSmoothing(const TriangleMesh& mesh)
  : UmbrellaSmoothing(EdgeTopology(mesh), mesh.NumberOfVertices())
{
}

UmbrellaSmoothing::UmbrellaSmoothing(const EdgeTopology& topology, Index vertices)
  : Neighbours(vertices)
{
  std::vector<bool> isInner(vertices, true);
  topology.ForEachEdge(
    [&](const Edge& edge, const EdgeTopology::Sides& sides)
    {
      const auto& [a, b] = edge;
      this->Neighbours[a].push_back(b);
      this->Neighbours[b].push_back(a);
      isInner[a] = isInner[a] && sides.size() == 2;
      isInner[b] = isInner[b] && sides.size() == 2;
    });
  for (Index v = 0; v < vertices; ++v)
  {
    if (!isInner[v])
    {
      this->Neighbours[v].clear();
    }
  }
}

TriangleMesh::PointMatrix UmbrellaSmoothing::Apply(const TriangleMesh::PointMatrix& points,
  double factor) const
{
  return this->Apply(points, [factor](double) { return factor; });
}

TriangleMesh::PointMatrix UmbrellaSmoothing::Apply(const TriangleMesh::PointMatrix& points,
  const std::function<double(double valence)>& factor) const
{
  TriangleMesh::PointMatrix relaxed = points;
  for (Index v = 0; v < points.rows(); ++v)
  {
    const std::vector<Index>& neighbours = this->Neighbours[v];
    if (neighbours.empty())
    {
      continue;
    }
    Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
    for (const Index w : neighbours)
    {
      sum += points.row(w);
    }
    const auto valence = static_cast<double>(neighbours.size());
    relaxed.row(v) += factor(valence) * (sum / valence - points.row(v));
  }
  return relaxed;
}

} // namespace spectralwatermark

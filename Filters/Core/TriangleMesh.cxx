// SPDX-License-Identifier: BSD-3-Clause
#include "TriangleMesh.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace spectralwatermark
{

bool SameTriangles(const TriangleMesh& a, const TriangleMesh& b)
{
  return a.NumberOfVertices() == b.NumberOfVertices() &&
    a.NumberOfTriangles() == b.NumberOfTriangles() && a.Triangles == b.Triangles;
}

std::vector<Edge> UniqueEdges(const TriangleMesh& mesh)
{
  std::vector<Edge> edges;
  edges.reserve(static_cast<std::size_t>(3 * mesh.NumberOfTriangles()));
  for (Index t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      const Index a = mesh.Triangles(t, corner);
      const Index b = mesh.Triangles(t, (corner + 1) % 3);
      edges.emplace_back(std::min(a, b), std::max(a, b));
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

std::map<Edge, std::vector<Index>> TrianglesOfEdges(const TriangleMesh& mesh)
{
  std::map<Edge, std::vector<Index>> triangles;
  for (Index t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      const Index a = mesh.Triangles(t, corner);
      const Index b = mesh.Triangles(t, (corner + 1) % 3);
      triangles[{ std::min(a, b), std::max(a, b) }].push_back(t);
    }
  }
  return triangles;
}

double MeanEdgeLength(const TriangleMesh& mesh)
{
  const std::vector<Edge> edges = UniqueEdges(mesh);
  double sum = 0.0;
  for (const Edge& edge : edges)
  {
    sum += (mesh.Points.row(edge.first) - mesh.Points.row(edge.second)).norm();
  }
  return edges.empty() ? 0.0 : sum / static_cast<double>(edges.size());
}

bool GoesAlong(const TriangleMesh& mesh, Index triangle, Index from, Index to)
{
  const auto corners = mesh.Triangles.row(triangle);
  return (corners[0] == from && corners[1] == to) || (corners[1] == from && corners[2] == to) ||
    (corners[2] == from && corners[0] == to);
}

Eigen::RowVector3d AreaVector(const TriangleMesh& mesh, Index triangle)
{
  const Eigen::RowVector3d p = mesh.Points.row(mesh.Triangles(triangle, 0));
  const Eigen::RowVector3d q = mesh.Points.row(mesh.Triangles(triangle, 1));
  const Eigen::RowVector3d r = mesh.Points.row(mesh.Triangles(triangle, 2));
  return (q - p).cross(r - p);
}

TriangleMesh::PointMatrix VertexNormals(const TriangleMesh& mesh)
{
  TriangleMesh::PointMatrix normals = TriangleMesh::PointMatrix::Zero(mesh.NumberOfVertices(), 3);
  for (Index t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    const Eigen::RowVector3d areaVector = AreaVector(mesh, t);
    for (int corner = 0; corner < 3; ++corner)
    {
      normals.row(mesh.Triangles(t, corner)) += areaVector;
    }
  }
  for (Index v = 0; v < normals.rows(); ++v)
  {
    const double length = normals.row(v).norm();
    if (length > 0.0)
    {
      normals.row(v) /= length;
    }
  }
  return normals;
}

} // namespace spectralwatermark

// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Mesh/Measures.h"

#include "Core/Mesh/EdgeTopology.h"

#include <Eigen/Geometry>

namespace spectralwatermark
{

Corners CornersOf(const TriangleMesh& mesh, Index triangle)
{
  return { mesh.Points.row(mesh.Triangles(triangle, 0)),
    mesh.Points.row(mesh.Triangles(triangle, 1)), mesh.Points.row(mesh.Triangles(triangle, 2)) };
}

double SignedVolume(const Corners& corners)
{
  return corners[0].dot(corners[1].cross(corners[2])) / 6.0;
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

Eigen::VectorXd VertexAreas(const TriangleMesh& mesh)
{
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(mesh.NumberOfVertices());
  for (Index t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    const double third = AreaVector(mesh, t).norm() / 6.0;
    for (int corner = 0; corner < 3; ++corner)
    {
      areas[mesh.Triangles(t, corner)] += third;
    }
  }
  return areas;
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

double MeanDistanceToCentre(const TriangleMesh& mesh)
{
  const Eigen::RowVector3d centre = mesh.Points.colwise().mean();
  return (mesh.Points.rowwise() - centre).rowwise().norm().mean();
}

double BoundingBoxDiagonal(const TriangleMesh::PointMatrix& points)
{
  return (points.colwise().maxCoeff() - points.colwise().minCoeff()).norm();
}

double LongestSide(const TriangleMesh::PointMatrix& points)
{
  return (points.colwise().maxCoeff() - points.colwise().minCoeff()).maxCoeff();
}

} // namespace spectralwatermark

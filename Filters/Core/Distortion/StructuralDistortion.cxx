// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Distortion/StructuralDistortion.h"

#include "Core/Mesh/Measures.h"
#include "Core/Support/Parallel.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace spectralwatermark
{

namespace
{

using Eigen::VectorXd;

// The number of vertices that one task takes.
constexpr Index VerticesPerTask = 2048;

// Calls work(vertex, workspace) for every vertex. Each task has a workspace of its own.
template <typename Work>
void ForEachVertex(const BallNeighbourhood& balls, int threads, const Work& work)
{
  const Index count = balls.Mesh().NumberOfVertices();
  ForEachTask(threads, (count + VerticesPerTask - 1) / VerticesPerTask,
    [&](Index task)
    {
      BallNeighbourhood::Workspace workspace = balls.MakeWorkspace();
      const Index end = std::min(count, (task + 1) * VerticesPerTask);
      for (Index v = task * VerticesPerTask; v < end; ++v)
      {
        work(v, workspace);
      }
    });
}

// The dihedral angle at every edge, between the normals of its triangles, positive where the
// surface is convex; 0 at edges that do not have two triangles.
std::vector<double> DihedralAngles(const BallNeighbourhood& balls)
{
  const TriangleMesh& mesh = balls.Mesh();
  std::vector<double> angles;
  angles.reserve(balls.Edges().size());
  const EdgeTopology& topology = balls.Topology();
  for (Index e = 0; e < static_cast<Index>(balls.Edges().size()); ++e)
  {
    const Edge& edge = balls.Edges()[e];
    const EdgeTopology::Sides sides = topology.TrianglesOf(e);
    if (sides.size() != 2)
    {
      angles.push_back(0.0);
      continue;
    }
    const bool along = HasDirectedEdge(mesh, sides[0], edge.first, edge.second);
    const double turned =
      along == HasDirectedEdge(mesh, sides[1], edge.first, edge.second) ? -1.0 : 1.0;
    const Eigen::Vector3d n = AreaVector(mesh, sides[0]).normalized();
    const Eigen::Vector3d other = turned * AreaVector(mesh, sides[1]).normalized();
    const Eigen::Vector3d direction =
      (mesh.Points.row(edge.second) - mesh.Points.row(edge.first)).normalized();
    angles.push_back(
      std::atan2((along ? 1.0 : -1.0) * n.cross(other).dot(direction), n.dot(other)));
  }
  return angles;
}

// The sum of the two larger absolute eigenvalues.
double TwoLarger(const Eigen::Matrix3d& tensor)
{
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(tensor, Eigen::EigenvaluesOnly);
  const Eigen::Array3d sizes = solver.eigenvalues().array().abs();
  return sizes.sum() - sizes.minCoeff();
}

// The weighted moments of the pairs of values in a window.
struct Moments
{
  double Weight = 0.0;
  Eigen::Vector2d Sum = Eigen::Vector2d::Zero();
  Eigen::Matrix2d Products = Eigen::Matrix2d::Zero();

  void Add(double weight, const Eigen::Vector2d& values)
  {
    this->Weight += weight;
    this->Sum += weight * values;
    this->Products += weight * values * values.transpose();
  }
};

// The structural difference in a window, from its moments about `origin`.
double Difference(const Moments& moments, const Eigen::Vector2d& origin, int exponent)
{
  const Eigen::Vector2d offset = moments.Sum / moments.Weight;
  const Eigen::Matrix2d covariance =
    moments.Products / moments.Weight - offset * offset.transpose();
  const Eigen::Vector2d mean = origin + offset;
  const Eigen::Vector2d deviation = covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  const double product = deviation[0] * deviation[1];
  const double l = std::abs(mean[0] - mean[1]) / (mean.maxCoeff() + 1.0);
  const double c = std::abs(deviation[0] - deviation[1]) / (deviation.maxCoeff() + 1.0);
  const double s = std::abs(product - covariance(0, 1)) / (product + 1.0);
  const auto power = [exponent](double value) { return std::pow(value, exponent); };
  return std::pow((power(l) + power(c) + 0.5 * power(s)) / 2.5, 1.0 / exponent);
}

} // namespace

VectorXd NormalCycleCurvature(const BallNeighbourhood& balls, double radius, int threads)
{
  const TriangleMesh& mesh = balls.Mesh();
  const std::vector<double> angles = DihedralAngles(balls);
  VectorXd curvature(mesh.NumberOfVertices());
  ForEachVertex(balls, threads,
    [&](Index v, BallNeighbourhood::Workspace& workspace)
    {
      balls.Around(v, radius, workspace);
      Eigen::Matrix3d tensor = Eigen::Matrix3d::Zero();
      for (const BallNeighbourhood::ClippedEdge& piece : workspace.ClippedEdges)
      {
        const Eigen::Vector3d edge = mesh.Points.row(piece.To) - mesh.Points.row(piece.From);
        const double length = edge.norm();
        if (length > 0.0)
        {
          tensor += angles[piece.Edge] * piece.Share / length * edge * edge.transpose();
        }
      }
      curvature[v] = 0.5 * TwoLarger(tensor) / (Pi * radius * radius);
    });
  return curvature;
}

VectorXd LocalStructuralDistortion(const BallNeighbourhood& balls, const VectorXd& here,
  const VectorXd& there, const StructuralWindow& window, int threads)
{
  const TriangleMesh::PointMatrix& points = balls.Mesh().Points;
  const double deviation = 0.5 * window.Radius;
  VectorXd local(points.rows());
  ForEachVertex(balls, threads,
    [&](Index centre, BallNeighbourhood::Workspace& workspace)
    {
      balls.Around(centre, window.Radius, workspace);
      Moments moments;
      // Moments about the values at the centre lose no digits.
      const Eigen::Vector2d origin(here[centre], there[centre]);
      const auto add = [&](const Eigen::RowVector3d& at, const Eigen::Vector2d& values)
      {
        const double distance = (at - points.row(centre)).norm() / deviation;
        moments.Add(window.Gaussian ? std::exp(-0.5 * distance * distance) : 1.0, values - origin);
      };
      for (const Index v : workspace.Inside)
      {
        add(points.row(v), { here[v], there[v] });
      }
      for (const auto& [edge, from, to, share] : workspace.ClippedEdges)
      {
        if (share < 1.0)
        {
          add(points.row(from) + share * (points.row(to) - points.row(from)),
            { here[from] + share * (here[to] - here[from]),
              there[from] + share * (there[to] - there[from]) });
        }
      }
      local[centre] = Difference(moments, origin, window.Exponent);
    });
  return local;
}

double CubicMean(const VectorXd& values)
{
  return std::cbrt(values.array().cube().mean());
}

VectorXd LocalMsdm(const BallNeighbourhood& reference, const BallNeighbourhood& distorted,
  double side, int threads)
{
  // The radii of the balls and of the windows, in D.
  constexpr double curvatureRadius = 0.005;
  constexpr double windowRadius = 0.015;
  const VectorXd before = side * NormalCycleCurvature(reference, curvatureRadius * side, threads);
  const VectorXd after = side * NormalCycleCurvature(distorted, curvatureRadius * side, threads);
  return LocalStructuralDistortion(reference, before, after, { windowRadius * side, false, 3 },
    threads);
}

} // namespace spectralwatermark

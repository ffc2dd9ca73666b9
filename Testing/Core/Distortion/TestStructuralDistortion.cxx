// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Distortion/BallNeighbourhood.h"
#include "Core/Distortion/StructuralDistortion.h"
#include "Core/Mesh/Measures.h"
#include "Support/Shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace spectralwatermark;

namespace
{

// Half of a square tube's corner: two planes that meet along the z axis at a right angle.
TriangleMesh Roof(Index cells)
{
  TriangleMesh mesh = shapes::Rectangle(2 * cells, 2 * cells, 2.0, 2.0);
  for (Index v = 0; v < mesh.NumberOfVertices(); ++v)
  {
    const Eigen::RowVector3d flat = mesh.Points.row(v) - Eigen::RowVector3d(1.0, 1.0, 0.0);
    mesh.Points.row(v) << std::max(0.0, flat[0]), std::max(0.0, -flat[0]), flat[1];
  }
  return mesh;
}

// An open cylinder about the z axis, radius 1, height 2, with a seam along which it does not close.
TriangleMesh Cylinder(Index around, Index along)
{
  TriangleMesh mesh = shapes::Rectangle(around, along, 2.0 * Pi, 2.0);
  for (Index v = 0; v < mesh.NumberOfVertices(); ++v)
  {
    const Eigen::RowVector3d flat = mesh.Points.row(v);
    mesh.Points.row(v) << std::cos(flat[0]), std::sin(flat[0]), flat[1];
  }
  return mesh;
}

Index NearestVertex(const TriangleMesh& mesh, const Eigen::RowVector3d& point)
{
  Index nearest = 0;
  (mesh.Points.rowwise() - point).rowwise().squaredNorm().minCoeff(&nearest);
  return nearest;
}

} // namespace

TEST(NormalCycleCurvature, VanishesOnAPlane)
{
  const TriangleMesh mesh = shapes::Rectangle(12, 12, 1.0, 1.0);
  EXPECT_LT(NormalCycleCurvature(BallNeighbourhood(mesh), 0.2, 1).maxCoeff(), 1e-12);
}

// On a sharp right angle the tensor has one eigenvalue, pi / 2 times the edge's length 2 r over the
// disc pi r^2: 1 / r. Half of it is the measure.
TEST(NormalCycleCurvature, FollowsTheAngleOfASharpEdge)
{
  const TriangleMesh mesh = Roof(10);
  const BallNeighbourhood balls(mesh);
  const Index middle = NearestVertex(mesh, Eigen::RowVector3d::Zero());
  for (const double radius : { 0.05, 0.23, 0.6 })
  {
    EXPECT_NEAR(NormalCycleCurvature(balls, radius, 2)[middle], 0.5 / radius, 1e-8 / radius);
  }
}

// 1 / R on a sphere, 1 / (2 R) on a cylinder, where the ball holds many edges: the discs pi r^2 and
// the balls' own surface differ by r^2 / (4 R^2) there, edges' ends by some percent.
TEST(NormalCycleCurvature, IsTheCurvatureOfRoundSurfaces)
{
  const double radius = 2.0;
  const TriangleMesh sphere = shapes::Icosphere(5, radius);
  const Eigen::VectorXd round = NormalCycleCurvature(BallNeighbourhood(sphere), 0.5, 2);
  EXPECT_NEAR(round.mean(), 1.0 / radius, 0.03 / radius);
  EXPECT_LT((round.array() - round.mean()).abs().maxCoeff(), 0.1 / radius);

  const TriangleMesh cylinder = Cylinder(120, 40);
  const Index middle = NearestVertex(cylinder, { -1.0, 0.0, 1.0 });
  EXPECT_NEAR(NormalCycleCurvature(BallNeighbourhood(cylinder), 0.4, 2)[middle], 0.5, 0.03);
}

TEST(NormalCycleCurvature, DoesNotDependOnOrientation)
{
  TriangleMesh mesh = shapes::Icosphere(3);
  const Eigen::VectorXd before = NormalCycleCurvature(BallNeighbourhood(mesh), 0.3, 1);
  mesh.Triangles.col(1).swap(mesh.Triangles.col(2));
  EXPECT_LT((NormalCycleCurvature(BallNeighbourhood(mesh), 0.3, 1) - before).norm(), 1e-12);
}

// Curvatures a and b everywhere: only the means differ.
TEST(LocalStructuralDistortion, ComparesMeansOfConstants)
{
  const TriangleMesh mesh = shapes::Icosphere(2);
  const BallNeighbourhood balls(mesh);
  const Eigen::VectorXd here = Eigen::VectorXd::Constant(mesh.NumberOfVertices(), 3.0);
  const Eigen::VectorXd there = Eigen::VectorXd::Constant(mesh.NumberOfVertices(), 7.0);
  const double difference = 4.0 / 8.0;
  for (const bool gaussian : { false, true })
  {
    const Eigen::VectorXd linear =
      LocalStructuralDistortion(balls, here, there, { 0.5, gaussian, 1 }, 1);
    EXPECT_LT((linear.array() - difference / 2.5).abs().maxCoeff(), 1e-12);
    const Eigen::VectorXd cubic =
      LocalStructuralDistortion(balls, there, here, { 0.5, gaussian, 3 }, 2);
    EXPECT_LT((cubic.array() - difference / std::cbrt(2.5)).abs().maxCoeff(), 1e-7);
  }
}

// x against -x about a vertex at 0, in a window without weights: means 0, the same deviation s, and
// covariance -s^2, so that S = 2 s^2 / (s^2 + 1).
TEST(LocalStructuralDistortion, ComparesCovarianceOfAMirroredSlope)
{
  const TriangleMesh mesh = shapes::Rectangle(20, 20, 2.0, 2.0);
  const BallNeighbourhood balls(mesh);
  const Index middle = NearestVertex(mesh, { 1.0, 1.0, 0.0 });
  const Eigen::VectorXd here = 5.0 * (mesh.Points.col(0).array() - 1.0);
  const StructuralWindow window{ 0.35, false, 1 };
  const double local = LocalStructuralDistortion(balls, here, -here, window, 1)[middle];

  BallNeighbourhood::Workspace room = balls.MakeWorkspace();
  balls.Around(middle, window.Radius, room);
  double sum = 0.0;
  double count = 0.0;
  for (const Index v : room.Inside)
  {
    sum += here[v] * here[v];
    count += 1.0;
  }
  for (const BallNeighbourhood::ClippedEdge& piece : room.ClippedEdges)
  {
    if (piece.Share < 1.0)
    {
      const double value = here[piece.From] + piece.Share * (here[piece.To] - here[piece.From]);
      sum += value * value;
      count += 1.0;
    }
  }
  const double variance = sum / count;
  EXPECT_NEAR(local, 0.5 * (2.0 * variance / (variance + 1.0)) / 2.5, 1e-10);
}

TEST(Msdm, IsZeroForAlikeAndGrowsWithRoughness)
{
  const TriangleMesh mesh = shapes::Bumpy(4);
  const BallNeighbourhood balls(mesh);
  const double side = LongestSide(mesh.Points);
  EXPECT_LT(LocalMsdm(balls, balls, side, 2).maxCoeff(), 1e-12);
  double last = 0.0;
  for (const double amplitude : { 1e-4, 1e-3, 1e-2 })
  {
    TriangleMesh rough = mesh;
    for (Index v = 0; v < mesh.NumberOfVertices(); ++v)
    {
      rough.Points.row(v) *= 1.0 + amplitude * std::sin(977.0 * static_cast<double>(v));
    }
    const double now = CubicMean(LocalMsdm(balls, BallNeighbourhood(rough), side, 2));
    EXPECT_GT(now, last);
    EXPECT_LT(now, 1.0);
    last = now;
  }
}

// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Distortion/BallNeighbourhood.h"
#include "Support/Shapes.h"

#include <gtest/gtest.h>

#include <set>

using namespace spectralwatermark;

TEST(BallNeighbourhood, AgreesWithABruteForceSearch)
{
  const TriangleMesh mesh = shapes::Bumpy(3);
  const BallNeighbourhood balls(mesh);
  BallNeighbourhood::Workspace room = balls.MakeWorkspace();
  const double radius = 0.4;
  for (const Index centre : { Index(0), Index(17), Index(300) })
  {
    balls.Around(centre, radius, room);
    const std::set<Index> inside(room.Inside.begin(), room.Inside.end());
    EXPECT_EQ(inside.size(), room.Inside.size());
    std::set<Index> expected;
    for (Index v = 0; v < mesh.NumberOfVertices(); ++v)
    {
      if ((mesh.Points.row(v) - mesh.Points.row(centre)).norm() < radius)
      {
        expected.insert(v); // the surface is gentle enough for the ball to hold one piece of it
      }
    }
    EXPECT_EQ(inside, expected);
    std::set<Index> edges;
    for (const BallNeighbourhood::ClippedEdge& piece : room.ClippedEdges)
    {
      EXPECT_TRUE(edges.insert(piece.Edge).second) << "an edge twice";
      const Eigen::RowVector3d end = mesh.Points.row(piece.From) +
        piece.Share * (mesh.Points.row(piece.To) - mesh.Points.row(piece.From));
      const double distance = (end - mesh.Points.row(centre)).norm();
      if (inside.count(piece.To) != 0)
      {
        EXPECT_EQ(piece.Share, 1.0);
      }
      else
      {
        EXPECT_NEAR(distance, radius, 1e-12);
      }
    }
    for (std::size_t e = 0; e < balls.Edges().size(); ++e)
    {
      const bool touches =
        inside.count(balls.Edges()[e].first) + inside.count(balls.Edges()[e].second) > 0;
      EXPECT_EQ(touches, edges.count(static_cast<Index>(e)) == 1);
    }
  }
}

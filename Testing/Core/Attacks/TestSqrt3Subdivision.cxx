// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Attacks/Sqrt3Subdivision.h"
#include "Core/Mesh/EdgeTopology.h"
#include "Core/Support/Progress.h"
#include "Support/Shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

using namespace spectralwatermark;

namespace
{

// How many triangles each edge has; every directed edge at most once on an oriented manifold.
std::map<Edge, int> SidesOfEdges(const TriangleMesh& mesh, bool& isOriented)
{
  std::map<Edge, int> sides;
  std::set<Edge> directed;
  isOriented = true;
  for (Index t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      const Index a = mesh.Triangles(t, corner);
      const Index b = mesh.Triangles(t, (corner + 1) % 3);
      ++sides[{ std::min(a, b), std::max(a, b) }];
      isOriented = directed.insert({ a, b }).second && isOriented;
    }
  }
  return sides;
}

} // namespace

TEST(Sqrt3Subdivision, DividesEveryTriangleIntoThree)
{
  const TriangleMesh mesh = shapes::Bumpy(2);
  const TriangleMesh fine = SubdivideSqrt3(mesh, 1, Progress());
  EXPECT_EQ(fine.NumberOfVertices(), mesh.NumberOfVertices() + mesh.NumberOfTriangles());
  EXPECT_EQ(fine.NumberOfTriangles(), 3 * mesh.NumberOfTriangles());
  bool isOriented = false;
  for (const auto& [edge, sides] : SidesOfEdges(fine, isOriented))
  {
    EXPECT_EQ(sides, 2);
  }
  EXPECT_TRUE(isOriented);
  EXPECT_EQ(SubdivideSqrt3(mesh, 2, Progress()).NumberOfTriangles(), 9 * mesh.NumberOfTriangles());
}

// Kobbelt's relaxation of a vertex with n neighbours: alpha = (4 - 2 cos(2 pi / n)) / 9.
TEST(Sqrt3Subdivision, RelaxesOldVertices)
{
  TriangleMesh octahedron;
  octahedron.Points.resize(6, 3);
  octahedron.Points << 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1;
  octahedron.Triangles.resize(8, 3);
  octahedron.Triangles << 0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5;
  const TriangleMesh fine = SubdivideSqrt3(octahedron, 1, Progress());
  const double alpha = 4.0 / 9.0; // cos(pi / 2) = 0, and the neighbours' mean is the centre
  EXPECT_LT((fine.Points.topRows(6) - (1.0 - alpha) * octahedron.Points).norm(), 1e-14);
  for (Index t = 0; t < 8; ++t)
  {
    EXPECT_NEAR(fine.Points.row(6 + t).norm(), 1.0 / std::sqrt(3.0), 1e-14);
  }
}

TEST(Sqrt3Subdivision, KeepsBoundaries)
{
  const TriangleMesh sheet = shapes::Rectangle(3, 3, 1.0, 1.0);
  const TriangleMesh fine = SubdivideSqrt3(sheet, 1, Progress());
  bool isOriented = false;
  bool wasOriented = false;
  std::set<Edge> boundary;
  for (const auto& [edge, sides] : SidesOfEdges(fine, isOriented))
  {
    if (sides == 1)
    {
      boundary.insert(edge);
    }
  }
  EXPECT_TRUE(isOriented);
  std::set<Edge> before;
  for (const auto& [edge, sides] : SidesOfEdges(sheet, wasOriented))
  {
    if (sides == 1)
    {
      before.insert(edge);
      EXPECT_EQ(fine.Points.row(edge.first), sheet.Points.row(edge.first));
    }
  }
  EXPECT_EQ(boundary, before);
  EXPECT_EQ(fine.Points.col(2).cwiseAbs().maxCoeff(), 0.0);
}

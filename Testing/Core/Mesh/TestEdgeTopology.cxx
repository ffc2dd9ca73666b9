// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Mesh/EdgeTopology.h"
#include "Support/Shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

using namespace spectralwatermark;

namespace
{

// A second construction: the triangles of every edge, by hand.
std::map<Edge, std::vector<Index>> TrianglesByEdge(const TriangleMesh& mesh)
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

// Closed, with a boundary, with edges of three and more triangles, in parts, and empty.
std::vector<std::pair<std::string, TriangleMesh>> SomeMeshes()
{
  const TriangleMesh sphere = shapes::Icosphere(1);
  const Index n = sphere.NumberOfVertices();
  const TriangleMesh fin = shapes::WithTriangles(sphere, { { 3.0, 0.0, 0.0 }, { 0.0, 3.0, 0.0 } },
    { { sphere.Triangles(4, 1), sphere.Triangles(4, 0), n },
      { sphere.Triangles(4, 0), sphere.Triangles(4, 1), n + 1 } });
  const TriangleMesh twice = shapes::WithTriangles(sphere, {},
    { { sphere.Triangles(0, 0), sphere.Triangles(0, 1), sphere.Triangles(0, 2) } });
  return { { "closed", sphere }, { "open", shapes::Rectangle(4, 3, 1.0, 1.0) }, { "fin", fin },
    { "a triangle twice", twice }, { "parts", shapes::Union({ sphere, shapes::Torus(5, 4) }, 4.0) },
    { "empty", {} } };
}

std::vector<Index> Listed(const EdgeTopology::Sides& sides)
{
  std::vector<Index> triangles;
  for (Index k = 0; k < sides.size(); ++k)
  {
    triangles.push_back(sides[k]);
  }
  return triangles;
}

} // namespace

TEST(EdgeTopology, ClosedSurfacesFollowEulersFormula)
{
  const TriangleMesh mesh = shapes::Icosphere(2);
  const std::vector<Edge> edges = UniqueEdges(mesh);
  EXPECT_EQ(static_cast<Index>(edges.size()), 3 * mesh.NumberOfTriangles() / 2);
  EXPECT_EQ(mesh.NumberOfVertices() - static_cast<Index>(edges.size()) + mesh.NumberOfTriangles(),
    2);
}

TEST(EdgeTopology, HasTheEdgesAndTrianglesOfAMapByHand)
{
  for (const auto& [name, mesh] : SomeMeshes())
  {
    SCOPED_TRACE(name);
    const std::map<Edge, std::vector<Index>> expected = TrianglesByEdge(mesh);
    const EdgeTopology topology(mesh);
    ASSERT_EQ(topology.Edges().size(), expected.size());
    EXPECT_EQ(UniqueEdges(mesh), topology.Edges());
    auto next = expected.begin();
    topology.ForEachEdge(
      [&](const Edge& edge, const EdgeTopology::Sides& sides)
      {
        EXPECT_EQ(edge, next->first);
        EXPECT_EQ(Listed(sides), next->second);
        EXPECT_EQ(Listed(topology.TrianglesBetween(edge.first, edge.second)), next->second);
        EXPECT_EQ(Listed(topology.TrianglesBetween(edge.second, edge.first)), next->second);
        ++next;
      });
    EXPECT_EQ(next, expected.end());
  }
}

TEST(EdgeTopology, CountsThreeSidesForEveryTriangle)
{
  for (const auto& [name, mesh] : SomeMeshes())
  {
    Index sides = 0;
    EdgeTopology(mesh).ForEachEdge(
      [&sides](const Edge&, const EdgeTopology::Sides& of) { sides += of.size(); });
    EXPECT_EQ(sides, 3 * mesh.NumberOfTriangles()) << name;
  }
}

TEST(EdgeTopology, DirectedEdgesFollowTheCorners)
{
  TriangleMesh mesh;
  mesh.Triangles.resize(1, 3);
  mesh.Triangles << 4, 7, 2;
  for (const auto& [from, to] : std::vector<Edge>{ { 4, 7 }, { 7, 2 }, { 2, 4 } })
  {
    EXPECT_TRUE(HasDirectedEdge(mesh, 0, from, to));
    EXPECT_FALSE(HasDirectedEdge(mesh, 0, to, from));
  }
  EXPECT_FALSE(HasDirectedEdge(mesh, 0, 4, 5));
}

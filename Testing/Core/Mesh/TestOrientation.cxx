// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Mesh/EdgeTopology.h"
#include "Core/Mesh/Measures.h"
#include "Core/Mesh/Orientation.h"
#include "Core/RobustScheme/SolidSpectrum.h"
#include "Support/RobustTesting.h"
#include "Support/Shapes.h"

#include <gtest/gtest.h>

#include <utility>

using namespace spectralwatermark;
using robusttesting::RandomWaves;

namespace
{

// Every third triangle the other way round.
TriangleMesh Disoriented(TriangleMesh mesh)
{
  for (Index t = 0; t < mesh.NumberOfTriangles(); t += 3)
  {
    std::swap(mesh.Triangles(t, 0), mesh.Triangles(t, 1));
  }
  return mesh;
}

double VolumeOf(const TriangleMesh& mesh)
{
  double volume = 0.0;
  for (Index t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    volume += SignedVolume(CornersOf(mesh, t));
  }
  return volume;
}

// Whether the two triangles of every inner edge run along it in opposite directions.
bool IsConsistent(const TriangleMesh& mesh)
{
  bool isConsistent = true;
  EdgeTopology(mesh).ForEachEdge(
    [&](const Edge& edge, const EdgeTopology::Sides& sides)
    {
      isConsistent = isConsistent &&
        (sides.size() != 2 ||
          HasDirectedEdge(mesh, sides[0], edge.first, edge.second) !=
            HasDirectedEdge(mesh, sides[1], edge.first, edge.second));
    });
  return isConsistent;
}

} // namespace

TEST(Orientation, RestoresFlippedTriangles)
{
  const TriangleMesh one = shapes::Bumpy(2);
  const TriangleMesh two = shapes::Union({ one, one }, 5.0);
  const Eigen::MatrixXd waves = RandomWaves(5, 4.0);
  const Eigen::VectorXd expected = SolidSpectrum(two, waves, 1);
  EXPECT_LT((SolidSpectrum(Oriented(Disoriented(two)), waves, 1) - expected).norm(),
    1e-9 * expected.norm());
  TriangleMesh inverted = two;
  inverted.Triangles.col(0).swap(inverted.Triangles.col(1));
  EXPECT_LT((SolidSpectrum(Oriented(inverted), waves, 1) - expected).norm(),
    1e-9 * expected.norm());
}

TEST(Orientation, IsConsistentAndEnclosesAVolume)
{
  const TriangleMesh torus = shapes::Torus(12, 6);
  const TriangleMesh disoriented = Disoriented(torus);
  EXPECT_FALSE(IsConsistent(disoriented));
  const TriangleMesh oriented = Oriented(disoriented);
  EXPECT_TRUE(IsConsistent(oriented));
  EXPECT_NEAR(VolumeOf(oriented), VolumeOf(torus), 1e-12);
  EXPECT_GT(VolumeOf(oriented), 0.0);
  EXPECT_EQ(Oriented(oriented).Triangles, oriented.Triangles);
}

TEST(Orientation, IsConsistentOnOpenSurfaces)
{
  const TriangleMesh sheet = Disoriented(shapes::Rectangle(4, 3, 1.0, 1.0));
  EXPECT_FALSE(IsConsistent(sheet));
  EXPECT_TRUE(IsConsistent(Oriented(sheet)));
}

// A third triangle at an edge says nothing of the orientation there.
TEST(Orientation, LeavesTrianglesAtNonManifoldEdges)
{
  const TriangleMesh fin = shapes::WithTriangles(shapes::Icosphere(0), { { 3.0, 3.0, 3.0 } }, {});
  const Index a = fin.Triangles(0, 0);
  const Index b = fin.Triangles(0, 1);
  for (const std::vector<Index>& triangle : { std::vector<Index>{ a, b, 12 }, { b, a, 12 } })
  {
    const TriangleMesh mesh = shapes::WithTriangles(fin, {}, { triangle });
    const TriangleMesh oriented = Oriented(mesh);
    EXPECT_EQ(oriented.Triangles.topRows(20), mesh.Triangles.topRows(20));
  }
}

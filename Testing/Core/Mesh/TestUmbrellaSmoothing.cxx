// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Mesh/EdgeTopology.h"
#include "Core/Mesh/UmbrellaSmoothing.h"
#include "Support/Shapes.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace spectralwatermark;

// The five neighbours of an icosahedron's vertex v have the mean v / sqrt(5).
TEST(UmbrellaSmoothing, ShrinksAnIcosahedronByAKnownFactor)
{
  const TriangleMesh mesh = shapes::Icosphere(0);
  const UmbrellaSmoothing smoothing(mesh);
  const double toMean = 1.0 - 1.0 / std::sqrt(5.0);
  for (const double factor : { 0.0, 0.1, 1.0, -0.3 })
  {
    const TriangleMesh::PointMatrix expected = (1.0 - factor * toMean) * mesh.Points;
    EXPECT_LT((smoothing.Apply(mesh.Points, factor) - expected).norm(), 1e-14) << factor;
  }
}

TEST(UmbrellaSmoothing, FactorsMayDependOnTheValence)
{
  const TriangleMesh mesh = shapes::Icosphere(1); // valences 5 and 6
  const UmbrellaSmoothing smoothing(EdgeTopology(mesh), mesh.NumberOfVertices());
  const TriangleMesh::PointMatrix moved =
    smoothing.Apply(mesh.Points, [](double valence) { return valence == 5.0 ? 0.5 : 0.0; });
  const TriangleMesh::PointMatrix all = smoothing.Apply(mesh.Points, 0.5);
  EXPECT_EQ(moved.topRows(12), all.topRows(12));
  EXPECT_EQ(moved.bottomRows(30), mesh.Points.bottomRows(30));
}

TEST(UmbrellaSmoothing, IsLinearAndKeepsConstants)
{
  const TriangleMesh mesh = shapes::Bumpy(2);
  const UmbrellaSmoothing smoothing(mesh);
  TriangleMesh::PointMatrix moved = mesh.Points;
  moved.rowwise() += Eigen::RowVector3d(3.0, -1.0, 2.0);
  TriangleMesh::PointMatrix expected = smoothing.Apply(mesh.Points, 0.4);
  expected.rowwise() += Eigen::RowVector3d(3.0, -1.0, 2.0);
  EXPECT_LT((smoothing.Apply(moved, 0.4) - expected).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(UmbrellaSmoothing, BoundariesAndNonManifoldEdgesStay)
{
  const TriangleMesh sheet = shapes::Rectangle(2, 2, 1.0, 1.0); // one inner vertex
  TriangleMesh bent = sheet;
  bent.Points(4, 2) = 1.0;
  TriangleMesh::PointMatrix expected = bent.Points;
  expected(4, 2) = 0.5;
  EXPECT_LT((UmbrellaSmoothing(bent).Apply(bent.Points, 0.5) - expected).norm(), 1e-15);

  const TriangleMesh sphere = shapes::Icosphere(1);
  const Index a = sphere.Triangles(0, 0);
  const Index b = sphere.Triangles(0, 1);
  const TriangleMesh fin = shapes::WithTriangles(sphere, { { 3.0, 3.0, 3.0 } }, { { a, b, 42 } });
  const TriangleMesh::PointMatrix smooth = UmbrellaSmoothing(fin).Apply(fin.Points, 0.5);
  for (Index v = 0; v < fin.NumberOfVertices(); ++v)
  {
    EXPECT_EQ(smooth.row(v) == fin.Points.row(v), v == a || v == b || v == 42) << v;
  }
}

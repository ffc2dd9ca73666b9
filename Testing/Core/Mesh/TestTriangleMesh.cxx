// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Mesh/TriangleMesh.h"
#include "Support/Shapes.h"

#include <gtest/gtest.h>

using namespace spectralwatermark;

TEST(TriangleMesh, SameTrianglesIgnoresThePoints)
{
  const TriangleMesh mesh = shapes::Icosphere(1);
  TriangleMesh other = mesh;
  other.Points *= 2.0;
  EXPECT_TRUE(SameTriangles(mesh, other));
  other.Triangles.row(3).swap(other.Triangles.row(7));
  EXPECT_FALSE(SameTriangles(mesh, other));
}

TEST(TriangleMesh, SameTrianglesComparesTheCounts)
{
  const TriangleMesh mesh = shapes::Icosphere(1);
  EXPECT_FALSE(SameTriangles(mesh, shapes::WithTriangles(mesh, { { 0.0, 0.0, 0.0 } }, {})));
  EXPECT_FALSE(SameTriangles(mesh, shapes::WithTriangles(mesh, {}, { { 0, 1, 2 } })));
  EXPECT_TRUE(SameTriangles(TriangleMesh(), TriangleMesh()));
}

TEST(TriangleMesh, ListsBecomeRows)
{
  TriangleMesh::TriangleMatrix expected(2, 3);
  expected << 4, 7, 2, 0, 1, 9;
  EXPECT_EQ(ToTriangleMatrix({ { 4, 7, 2 }, { 0, 1, 9 } }), expected);
  EXPECT_EQ(ToTriangleMatrix({}).rows(), 0);
}

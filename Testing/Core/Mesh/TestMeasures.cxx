// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Mesh/EdgeTopology.h"
#include "Core/Mesh/Measures.h"
#include "Support/Shapes.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace spectralwatermark;

TEST(Measures, VertexAreasAddUpToTheSurface)
{
  const TriangleMesh box = shapes::Box(2.0, 1.0, 0.5);
  EXPECT_NEAR(VertexAreas(box).sum(), 2.0 * (2.0 + 1.0 + 0.5), 1e-12);
}

TEST(Measures, NormalsOfASpherePointOutward)
{
  const TriangleMesh mesh = shapes::Icosphere(4, 3.0);
  EXPECT_LT((VertexNormals(mesh) - mesh.Points / 3.0).rowwise().norm().maxCoeff(), 0.01);
}

TEST(Measures, MeanDistanceOfASphereIsItsRadius)
{
  EXPECT_NEAR(MeanDistanceToCentre(shapes::Icosphere(3, 2.5)), 2.5, 1e-12);
}

TEST(Measures, SignedVolumesAddUpToTheSolid)
{
  TriangleMesh box = shapes::Box(2.0, 1.0, 0.5);
  box.Points.rowwise() += Eigen::RowVector3d(3.0, -4.0, 5.0);
  double volume = 0.0;
  for (Index t = 0; t < box.NumberOfTriangles(); ++t)
  {
    volume += SignedVolume(CornersOf(box, t));
  }
  EXPECT_NEAR(volume, 1.0, 1e-12);
}

// They sum to zero on a closed surface, and to its area times the normal on a flat one.
TEST(Measures, AreaVectorsAreNormalsTwiceTheArea)
{
  const TriangleMesh closed = shapes::Bumpy(2);
  const TriangleMesh flat = shapes::Rectangle(3, 5, 2.0, 1.0);
  Eigen::RowVector3d ofClosed = Eigen::RowVector3d::Zero();
  for (Index t = 0; t < closed.NumberOfTriangles(); ++t)
  {
    ofClosed += AreaVector(closed, t);
  }
  Eigen::RowVector3d ofFlat = Eigen::RowVector3d::Zero();
  for (Index t = 0; t < flat.NumberOfTriangles(); ++t)
  {
    ofFlat += AreaVector(flat, t);
  }
  EXPECT_LT(ofClosed.norm(), 1e-12);
  EXPECT_LT((ofFlat - Eigen::RowVector3d(0.0, 0.0, 4.0)).norm(), 1e-12);
}

TEST(Measures, LengthsAreThoseOfSimpleShapes)
{
  const double radius = 2.0;
  const double edge = radius / std::sin(2.0 * Pi / 5.0); // of an icosahedron
  EXPECT_NEAR(MeanEdgeLength(shapes::Icosphere(0, radius)), edge, 1e-12);
  EXPECT_EQ(MeanEdgeLength(TriangleMesh()), 0.0);
  const TriangleMesh box = shapes::Box(2.0, 1.0, 2.0);
  EXPECT_NEAR(BoundingBoxDiagonal(box.Points), 3.0, 1e-15);
  EXPECT_EQ(LongestSide(box.Points), 2.0);
}

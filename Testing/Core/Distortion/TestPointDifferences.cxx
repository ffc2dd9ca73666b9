// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Distortion/PointDifferences.h"
#include "Core/Mesh/EdgeTopology.h"
#include "Support/Shapes.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace spectralwatermark;

TEST(PointDifferences, LaplacianVanishesOnRegularPlanarVertices)
{
  const TriangleMesh mesh = shapes::Rectangle(6, 6, 1.0, 1.0);
  const TriangleMesh::PointMatrix laplacian = GeometricLaplacian(UniqueEdges(mesh), mesh.Points);
  EXPECT_LT(laplacian.row(3 * 7 + 3).norm(), 1e-15);
  EXPECT_GT(laplacian.row(0).norm(), 0.01); // a corner
}

// The 12 vertices of an icosahedron: 5 neighbours at equal distance, so the Laplacian is
// v (1 - cos(angle between neighbours)) = v (1 - 1 / sqrt(5)).
TEST(PointDifferences, LaplacianIsKnownOnTheIcosahedron)
{
  const TriangleMesh mesh = shapes::Icosphere(0, 2.0);
  const TriangleMesh::PointMatrix laplacian = GeometricLaplacian(UniqueEdges(mesh), mesh.Points);
  EXPECT_LT((laplacian - (1.0 - 1.0 / std::sqrt(5.0)) * mesh.Points).norm(), 1e-14);
}

TEST(PointDifferences, TranslationMovesEveryVertexButNoCurvature)
{
  const TriangleMesh mesh = shapes::Bumpy(3);
  TriangleMesh::PointMatrix moved = mesh.Points;
  moved.rowwise() += Eigen::RowVector3d(3.0, 4.0, 0.0);
  const Eigen::VectorXd geometric = GeometricDifference(mesh.Points, moved);
  EXPECT_NEAR(geometric.minCoeff(), 5.0, 1e-12);
  EXPECT_NEAR(geometric.maxCoeff(), 5.0, 1e-12);
  EXPECT_LT(CurvatureDifference(UniqueEdges(mesh), mesh.Points, moved).maxCoeff(), 1e-13);
}

TEST(PointDifferences, CoincidentNeighbourGivesTheLimit)
{
  TriangleMesh mesh = shapes::Rectangle(2, 2, 1.0, 1.0);
  mesh.Points.row(4) = mesh.Points.row(0);
  const TriangleMesh::PointMatrix laplacian = GeometricLaplacian(UniqueEdges(mesh), mesh.Points);
  EXPECT_TRUE(laplacian.allFinite());
  EXPECT_EQ(laplacian.row(4).norm(), 0.0);
}

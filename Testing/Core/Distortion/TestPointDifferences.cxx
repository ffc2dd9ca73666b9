// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Attacks/Attacks.h"
#include "Core/Distortion/PointDifferences.h"
#include "Core/Mesh/EdgeTopology.h"
#include "Core/Mesh/Measures.h"
#include "Core/Support/Random.h"
#include "Support/Shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

using namespace spectralwatermark;

TEST(Distortion, LaplacianVanishesOnRegularPlanarVertices)
{
  const TriangleMesh mesh = shapes::Rectangle(6, 6, 1.0, 1.0);
  const TriangleMesh::PointMatrix laplacian = GeometricLaplacian(UniqueEdges(mesh), mesh.Points);
  EXPECT_LT(laplacian.row(3 * 7 + 3).norm(), 1e-15);
  EXPECT_GT(laplacian.row(0).norm(), 0.01); // a corner
}

// The 12 vertices of an icosahedron: 5 neighbours at equal distance, so the Laplacian is
// v (1 - cos(angle between neighbours)) = v (1 - 1 / sqrt(5)).
TEST(Distortion, LaplacianOfTheIcosahedron)
{
  const TriangleMesh mesh = shapes::Icosphere(0, 2.0);
  const TriangleMesh::PointMatrix laplacian = GeometricLaplacian(UniqueEdges(mesh), mesh.Points);
  EXPECT_LT((laplacian - (1.0 - 1.0 / std::sqrt(5.0)) * mesh.Points).norm(), 1e-14);
}

TEST(Distortion, TranslationMovesEveryVertexButNoCurvature)
{
  const TriangleMesh mesh = shapes::Bumpy(3);
  TriangleMesh::PointMatrix moved = mesh.Points;
  moved.rowwise() += Eigen::RowVector3d(3.0, 4.0, 0.0);
  const Eigen::VectorXd geometric = GeometricDifference(mesh.Points, moved);
  EXPECT_NEAR(geometric.minCoeff(), 5.0, 1e-12);
  EXPECT_NEAR(geometric.maxCoeff(), 5.0, 1e-12);
  EXPECT_LT(CurvatureDifference(UniqueEdges(mesh), mesh.Points, moved).maxCoeff(), 1e-13);
}

TEST(Distortion, CoincidentNeighbourGivesTheLimit)
{
  TriangleMesh mesh = shapes::Rectangle(2, 2, 1.0, 1.0);
  mesh.Points.row(4) = mesh.Points.row(0);
  const TriangleMesh::PointMatrix laplacian = GeometricLaplacian(UniqueEdges(mesh), mesh.Points);
  EXPECT_TRUE(laplacian.allFinite());
  EXPECT_EQ(laplacian.row(4).norm(), 0.0);
}

TEST(TriangleMesh, EdgesOfAClosedSurface)
{
  const TriangleMesh mesh = shapes::Icosphere(2);
  const std::vector<Edge> edges = UniqueEdges(mesh);
  EXPECT_EQ(static_cast<Index>(edges.size()), 3 * mesh.NumberOfTriangles() / 2);
  EXPECT_EQ(mesh.NumberOfVertices() - static_cast<Index>(edges.size()) + mesh.NumberOfTriangles(),
    2);
}

TEST(TriangleMesh, NormalsOfASpherePointOutward)
{
  const TriangleMesh mesh = shapes::Icosphere(4, 3.0);
  EXPECT_LT((VertexNormals(mesh) - mesh.Points / 3.0).rowwise().norm().maxCoeff(), 0.01);
}

TEST(Noise, IsStandardNormal)
{
  const Index n = 200000;
  Eigen::VectorXd samples(n);
  for (Index i = 0; i < n; ++i)
  {
    samples[i] = NormalRandom(42, static_cast<std::uint64_t>(i));
  }
  const double mean = samples.mean();
  const Eigen::ArrayXd centred = samples.array() - mean;
  const double variance = centred.square().mean();
  EXPECT_NEAR(mean, 0.0, 5.0 / std::sqrt(static_cast<double>(n)));
  EXPECT_NEAR(variance, 1.0, 5.0 * std::sqrt(2.0 / static_cast<double>(n)));
  EXPECT_NEAR(centred.pow(4).mean(), 3.0, 0.1);
  // Neighbouring elements are independent.
  EXPECT_NEAR((centred.head(n - 1) * centred.tail(n - 1)).mean(), 0.0, 0.012);
}

TEST(Noise, DependsOnTheSeedAndNothingElse)
{
  EXPECT_EQ(NormalRandom(7, 3), NormalRandom(7, 3));
  std::set<double> values;
  for (std::uint64_t seed = 0; seed < 50; ++seed)
  {
    for (std::uint64_t element = 0; element < 50; ++element)
    {
      values.insert(NormalRandom(seed, element));
    }
  }
  EXPECT_EQ(values.size(), 2500u);
}

TEST(Noise, MovesAlongNormalsByTheFactor)
{
  const TriangleMesh mesh = shapes::Icosphere(4);
  const TriangleMesh::PointMatrix moved = NoiseAlongNormals(mesh, 0.5, 1);
  const TriangleMesh::PointMatrix step = moved - mesh.Points;
  const Eigen::VectorXd along = step.cwiseProduct(VertexNormals(mesh)).rowwise().sum();
  EXPECT_NEAR(step.norm(), along.norm(), 1e-12);
  const double rms = step.norm() / std::sqrt(static_cast<double>(mesh.NumberOfVertices()));
  EXPECT_NEAR(rms, 0.5 * MeanEdgeLength(mesh), 0.05 * rms);
}

// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Attacks/Attacks.h"
#include "Core/Mesh/Measures.h"
#include "Core/Support/Progress.h"
#include "Support/Shapes.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

using namespace spectralwatermark;

TEST(Attacks, NoiseFillsItsRangeAndDependsOnTheSeed)
{
  const TriangleMesh mesh = shapes::Bumpy(4);
  const double range = 0.01 * MeanDistanceToCentre(mesh);
  const Eigen::MatrixXd noise = NoiseUniform(mesh, 0.01, 1) - mesh.Points;
  EXPECT_LE(noise.cwiseAbs().maxCoeff(), range);
  EXPECT_NEAR(std::sqrt(noise.array().square().mean()), range / std::sqrt(3.0), 0.03 * range);
  EXPECT_NEAR(noise.mean(), 0.0, 0.03 * range);
  EXPECT_EQ(NoiseUniform(mesh, 0.01, 1), NoiseUniform(mesh, 0.01, 1));
  EXPECT_NE(NoiseUniform(mesh, 0.01, 1), NoiseUniform(mesh, 0.01, 2));
  EXPECT_EQ(NoiseUniform(mesh, 0.0, 1), mesh.Points);
}

TEST(Attacks, NoiseMovesAlongNormalsByTheFactor)
{
  const TriangleMesh mesh = shapes::Icosphere(4);
  const TriangleMesh::PointMatrix moved = NoiseAlongNormals(mesh, 0.5, 1);
  const TriangleMesh::PointMatrix step = moved - mesh.Points;
  const Eigen::VectorXd along = step.cwiseProduct(VertexNormals(mesh)).rowwise().sum();
  EXPECT_NEAR(step.norm(), along.norm(), 1e-12);
  const double rms = step.norm() / std::sqrt(static_cast<double>(mesh.NumberOfVertices()));
  EXPECT_NEAR(rms, 0.5 * MeanEdgeLength(mesh), 0.05 * rms);
}

TEST(Attacks, SmoothingMovesToTheMeanOfTheNeighbours)
{
  // A cell's corner in a flat grid has six neighbours around it: lifted, it sinks by the factor.
  TriangleMesh mesh = shapes::Rectangle(4, 4, 4.0, 4.0);
  const Index middle = 12;
  ASSERT_EQ(mesh.Points.row(middle), Eigen::RowVector3d(2.0, 2.0, 0.0));
  mesh.Points(middle, 2) = 1.0;
  const TriangleMesh::PointMatrix smooth = LaplacianSmoothing(mesh, 0.1, 1, Progress());
  EXPECT_NEAR(smooth(middle, 2), 0.9, 1e-15);
  double lifted = 0.0;
  for (Index v = 0; v < smooth.rows(); ++v)
  {
    lifted += v == middle ? 0.0 : smooth(v, 2);
  }
  EXPECT_NEAR(lifted, 6.0 * 0.1 / 6.0, 1e-12); // neighbours have six each as well
}

TEST(Attacks, SmoothingKeepsBoundariesAndShrinksTheRest)
{
  const TriangleMesh sheet = shapes::Rectangle(5, 5, 1.0, 2.0);
  const TriangleMesh::PointMatrix smooth = LaplacianSmoothing(sheet, 0.5, 20, Progress());
  EXPECT_LT((smooth - sheet.Points).cwiseAbs().maxCoeff(), 1e-12); // regular: nothing to smooth

  TriangleMesh bent = sheet;
  bent.Points.col(2) = (3.0 * bent.Points.col(0)).array().sin();
  const TriangleMesh::PointMatrix flatter = LaplacianSmoothing(bent, 0.5, 20, Progress());
  for (Index v = 0; v < bent.NumberOfVertices(); ++v)
  {
    const Eigen::RowVector3d p = sheet.Points.row(v);
    const bool isBoundary = p[0] == 0.0 || p[0] == 1.0 || p[1] == 0.0 || p[1] == 2.0;
    EXPECT_EQ(flatter.row(v) == bent.Points.row(v), isBoundary) << v;
  }

  const TriangleMesh sphere = shapes::Icosphere(3);
  EXPECT_LT(LaplacianSmoothing(sphere, 0.1, 10, Progress()).rowwise().norm().maxCoeff(), 0.999);
  EXPECT_EQ(LaplacianSmoothing(sphere, 0.1, 0, Progress()), sphere.Points);
}

TEST(Attacks, QuantizationHasAsManyLevelsAsItSays)
{
  const TriangleMesh mesh = shapes::Bumpy(4);
  for (const int bits : { 1, 5, 9 })
  {
    TriangleMesh coarse = mesh;
    coarse.Points = Quantize(mesh, bits);
    for (Index axis = 0; axis < 3; ++axis)
    {
      const double size = mesh.Points.col(axis).maxCoeff() - mesh.Points.col(axis).minCoeff();
      const double half = 0.5 * size / (std::ldexp(1.0, bits) - 1.0);
      EXPECT_LE((coarse.Points - mesh.Points).col(axis).cwiseAbs().maxCoeff(),
        half * (1.0 + 1e-12));
      const Eigen::VectorXd column = coarse.Points.col(axis);
      EXPECT_EQ(column.minCoeff(), mesh.Points.col(axis).minCoeff());
      EXPECT_NEAR(column.maxCoeff(), mesh.Points.col(axis).maxCoeff(), 1e-12);
      const std::set<double> values(column.begin(), column.end());
      EXPECT_LE(values.size(), std::size_t{ 1 } << bits);
      EXPECT_GE(values.size(), std::size_t{ 1 } << std::min(bits, 5));
    }
  }
  const TriangleMesh flat = shapes::Rectangle(3, 3, 1.0, 1.0);
  EXPECT_EQ(Quantize(flat, 4).col(2), flat.Points.col(2));
}

TEST(Attacks, SimilaritiesAreSimilarities)
{
  const TriangleMesh mesh = shapes::Bumpy(2);
  double smallest = 1.0;
  double largest = 1.0;
  Eigen::Matrix3d mean = Eigen::Matrix3d::Zero();
  constexpr int count = 400;
  for (int seed = 0; seed < count; ++seed)
  {
    const SimilarityTransform t = RandomSimilarity(mesh, static_cast<std::uint64_t>(seed));
    EXPECT_LT((t.Rotation.transpose() * t.Rotation - Eigen::Matrix3d::Identity()).norm(), 1e-14);
    EXPECT_NEAR(t.Rotation.determinant(), 1.0, 1e-14);
    EXPECT_LE(t.Translation.cwiseAbs().maxCoeff(), 5.0 * MeanDistanceToCentre(mesh));
    smallest = std::min(smallest, t.Scale);
    largest = std::max(largest, t.Scale);
    mean += t.Rotation / count;
  }
  EXPECT_GE(smallest, 0.1);
  EXPECT_LT(smallest, 0.2);
  EXPECT_LE(largest, 10.0);
  EXPECT_GT(largest, 5.0);
  EXPECT_LT(mean.cwiseAbs().maxCoeff(), 5.0 / std::sqrt(3.0 * count)); // no direction preferred
}

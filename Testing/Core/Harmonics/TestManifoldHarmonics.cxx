// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Harmonics/LaplaceOperator.h"
#include "Core/Harmonics/ManifoldHarmonics.h"
#include "Core/Support/Errors.h"
#include "Support/CoreTesting.h"
#include "Support/Shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace spectralwatermark;

namespace
{

ManifoldHarmonics Compute(const TriangleMesh& mesh, Index count,
  MassMatrix mass = MassMatrix::Lumped, double tolerance = 1e-8)
{
  HarmonicsOptions options;
  options.Count = count;
  options.Mass = mass;
  options.Tolerance = tolerance;
  return ComputeManifoldHarmonics(mesh, options);
}

// Largest relative error of the first 48 non-constant eigenvalues of a sphere of this radius.
double SphereError(int level, double radius, MassMatrix mass)
{
  const ManifoldHarmonics harmonics = Compute(shapes::Icosphere(level, radius), 49, mass);
  double error = 0.0;
  for (int l = 1; l <= 6; ++l)
  {
    const double expected = l * (l + 1) / (radius * radius);
    for (int k = l * l; k < (l + 1) * (l + 1); ++k)
    {
      error = std::max(error, std::abs(harmonics.Eigenvalues[k] / expected - 1.0));
    }
  }
  return error;
}

} // namespace

// l (l + 1) / r^2 with multiplicity 2 l + 1, l = 0 to 6.
TEST(ManifoldHarmonics, SphereSpectrumIsWithinOnePercent)
{
  EXPECT_LT(SphereError(5, 1.0, MassMatrix::Lumped), 0.01);
  EXPECT_LT(SphereError(5, 3.5, MassMatrix::Lumped), 0.01);
  EXPECT_LT(SphereError(5, 3.5, MassMatrix::Consistent), 0.01);
}

TEST(ManifoldHarmonics, SphereErrorFallsQuadratically)
{
  for (const MassMatrix mass : { MassMatrix::Lumped, MassMatrix::Consistent })
  {
    const double order = std::log2(SphereError(3, 1.0, mass) / SphereError(4, 1.0, mass));
    EXPECT_NEAR(order, 2.0, 0.25);
  }
}

// Natural boundary: pi^2 (i^2 / a^2 + j^2 / b^2) on a rectangle.
TEST(ManifoldHarmonics, RectangleHasTheNeumannSpectrum)
{
  const double a = 1.0;
  const double b = 1.37;
  std::vector<double> expected;
  for (int i = 0; i < 12; ++i)
  {
    for (int j = 0; j < 12; ++j)
    {
      expected.push_back(Pi * Pi * (i * i / (a * a) + j * j / (b * b)));
    }
  }
  std::sort(expected.begin(), expected.end());
  const ManifoldHarmonics harmonics = Compute(shapes::Rectangle(60, 82, a, b), 30);
  EXPECT_EQ(harmonics.Eigenvalues[0], 0.0);
  for (Index k = 1; k < 30; ++k)
  {
    EXPECT_NEAR(harmonics.Eigenvalues[k] / expected[static_cast<std::size_t>(k)], 1.0, 0.01);
  }
}

TEST(ManifoldHarmonics, BasisIsOrthonormalWithSmallResiduals)
{
  for (const MassMatrix mass : { MassMatrix::Lumped, MassMatrix::Consistent })
  {
    const TriangleMesh mesh = shapes::Bumpy(4);
    const ManifoldHarmonics harmonics = Compute(mesh, 150, mass);
    const Eigen::MatrixXd gram = harmonics.Basis.transpose() * (harmonics.Mass * harmonics.Basis);
    EXPECT_LT((gram - Eigen::MatrixXd::Identity(150, 150)).cwiseAbs().maxCoeff(), 1e-10);
    EXPECT_LT(harmonics.Residuals.maxCoeff(), 1e-8);
    EXPECT_TRUE(std::is_sorted(harmonics.Eigenvalues.data(),
      harmonics.Eigenvalues.data() + harmonics.Count()));
    // Residuals are what they say: recomputed here for one harmonic.
    const LaplaceOperator op = AssembleLaplaceOperator(mesh, mass);
    const Eigen::VectorXd h = harmonics.Basis.col(77);
    const double lambda = harmonics.Eigenvalues[77];
    const double residual = (op.Stiffness * h - lambda * (op.Mass * h)).norm() /
      ((lambda + 1.0 / op.Area) * (op.Mass * h).norm());
    EXPECT_NEAR(residual, harmonics.Residuals[77], 1e-10);
  }
}

TEST(ManifoldHarmonics, SignIsFixed)
{
  const ManifoldHarmonics harmonics = Compute(shapes::Bumpy(3), 40);
  EXPECT_GT(harmonics.Basis.col(0).minCoeff(), 0.0);
  for (Index k = 0; k < harmonics.Count(); ++k)
  {
    EXPECT_GE(harmonics.Basis.col(k).maxCoeff(), -(1.0 + 1e-5) * harmonics.Basis.col(k).minCoeff());
  }
}

TEST(ManifoldHarmonics, EigenvaluesScaleInversely)
{
  TriangleMesh mesh = shapes::Bumpy(3);
  const ManifoldHarmonics unit = Compute(mesh, 30);
  mesh.Points *= 1e-6;
  const ManifoldHarmonics tiny = Compute(mesh, 30);
  EXPECT_LT((tiny.Eigenvalues * 1e-12 - unit.Eigenvalues).cwiseAbs().maxCoeff(),
    1e-9 * unit.Eigenvalues[29]);
}

TEST(ManifoldHarmonics, OwnBasisIsAdoptedAndAStaleOneIsNot)
{
  const TriangleMesh mesh = shapes::Bumpy(3);
  const ManifoldHarmonics own = Compute(mesh, 25);
  const auto adopt = [&own](const TriangleMesh& other, MassMatrix mass)
  { return AdoptManifoldHarmonics(other, mass, own.Eigenvalues, own.Basis, own.VertexMass); };
  EXPECT_TRUE(adopt(mesh, MassMatrix::Lumped).has_value());
  EXPECT_FALSE(adopt(mesh, MassMatrix::Consistent).has_value());

  // A rotation leaves the basis valid; moving a single vertex a little does not.
  TriangleMesh rotated = mesh;
  rotated.Points.col(0).swap(rotated.Points.col(1));
  EXPECT_TRUE(adopt(rotated, MassMatrix::Lumped).has_value());
  TriangleMesh moved = mesh;
  moved.Points.row(100) *= 1.001;
  EXPECT_FALSE(adopt(moved, MassMatrix::Lumped).has_value());

  Eigen::MatrixXd mixed = own.Basis;
  mixed.col(3) *= 1.01;
  EXPECT_FALSE(
    AdoptManifoldHarmonics(mesh, MassMatrix::Lumped, own.Eigenvalues, mixed, own.VertexMass)
      .has_value());
}

TEST(ManifoldHarmonics, MoreHarmonicsThanVerticesAreRefused)
{
  const TriangleMesh mesh = shapes::Icosphere(1);
  coretesting::ExpectRefusal([&] { Compute(mesh, 43); },
    "43 harmonics were requested, but the mesh has only 42 ");
  coretesting::ExpectRefusal([&] { Compute(mesh, 0); }, "no harmonic was requested");
  EXPECT_EQ(Compute(mesh, 42).Count(), 42);
}

// Rounding a mesh to a coarse grid leaves triangles without area; after merging, still some on
// a line. Here a fan of them hangs on a sound mesh.
TEST(ManifoldHarmonics, TrianglesWithoutAreaBarelyChangeTheSpectrum)
{
  const TriangleMesh mesh = shapes::Bumpy(3);
  const ManifoldHarmonics sound = Compute(mesh, 40);
  // A vertex on the middle of an edge, joined to its ends: zero area, all edges proper.
  const Eigen::RowVector3d middle =
    0.5 * (mesh.Points.row(mesh.Triangles(50, 0)) + mesh.Points.row(mesh.Triangles(50, 1)));
  const TriangleMesh damaged = shapes::WithTriangles(mesh, { middle },
    { { mesh.Triangles(50, 0), mesh.Triangles(50, 1), mesh.NumberOfVertices() } });
  const ManifoldHarmonics harmonics = Compute(damaged, 40);
  EXPECT_TRUE(harmonics.Basis.allFinite());
  // The flap ties the two ends of its edge to each other: a local change.
  EXPECT_LT((harmonics.Eigenvalues - sound.Eigenvalues).cwiseAbs().maxCoeff(),
    0.02 * sound.Eigenvalues[39]);
  const Eigen::MatrixXd gram = harmonics.Basis.transpose() * (harmonics.Mass * harmonics.Basis);
  EXPECT_LT((gram - Eigen::MatrixXd::Identity(40, 40)).cwiseAbs().maxCoeff(), 1e-10);
}

// Of 512 vertices, all but an icosahedron's are without area: the mass matrix is nearly all zero,
// and there is no room for a Krylov space.
TEST(ManifoldHarmonics, FewVerticesWithAreaAmongManySuffice)
{
  const TriangleMesh sphere = shapes::Icosphere(0);
  const std::vector<Eigen::RowVector3d> points(500, sphere.Points.row(0));
  std::vector<std::vector<Index>> triangles;
  for (Index i = 0; i < 500; ++i)
  {
    triangles.push_back({ 0, 1, 12 + i });
  }
  const TriangleMesh mesh = shapes::WithTriangles(sphere, points, triangles);
  const ManifoldHarmonics harmonics = Compute(mesh, 4);
  EXPECT_TRUE(harmonics.Basis.allFinite());
  EXPECT_EQ(harmonics.Eigenvalues[0], 0.0);
  EXPECT_THROW(Compute(mesh, 13), InvalidInput); // only twelve have mass
}

// Spheres and needles between them: all but one of the small eigenvalues are next to 0, and rounding must
// not take them under.
TEST(ManifoldHarmonics, EigenvaluesOfBarelyConnectedPartsStayOrdered)
{
  constexpr Index parts = 8;
  for (const int level : { 1, 2 }) // for the dense solver, and for the Lanczos ones
  {
    const TriangleMesh spheres =
      shapes::Union(std::vector<TriangleMesh>(parts, shapes::Icosphere(level)), 3.0);
    const Index n = spheres.NumberOfVertices();
    for (const double width : { 1e-6, 1e-9, 1e-12, 1e-15 })
    {
      std::vector<Eigen::RowVector3d> points;
      std::vector<std::vector<Index>> needles;
      for (Index k = 1; k < parts; ++k)
      {
        const Index end = k * n / parts;
        needles.push_back({ end - 1, end, n + k - 1 });
        points.emplace_back(spheres.Points.row(end) + Eigen::RowVector3d(0, 0, width));
      }
      const ManifoldHarmonics harmonics =
        Compute(shapes::WithTriangles(spheres, points, needles), 40);
      EXPECT_GE(harmonics.Eigenvalues.minCoeff(), 0.0) << width;
      EXPECT_LT(harmonics.Eigenvalues[parts - 1], 1e-5) << width;
      EXPECT_GT(harmonics.Eigenvalues[parts], 0.5) << width;
      EXPECT_TRUE(std::is_sorted(harmonics.Eigenvalues.begin(), harmonics.Eigenvalues.end()));
    }
  }
}

// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Harmonics/LaplaceOperator.h"
#include "Support/CoreTesting.h"
#include "Support/Shapes.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>

using namespace spectralwatermark;
using coretesting::ExpectRefusal;

namespace
{

double AreaOf(const TriangleMesh& mesh)
{
  double area = 0.0;
  for (Index t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    const Eigen::RowVector3d p = mesh.Points.row(mesh.Triangles(t, 0));
    const Eigen::RowVector3d q = mesh.Points.row(mesh.Triangles(t, 1));
    const Eigen::RowVector3d r = mesh.Points.row(mesh.Triangles(t, 2));
    area += 0.5 * (q - p).cross(r - p).norm();
  }
  return area;
}

} // namespace

TEST(LaplaceOperator, ConstantsAreInTheKernel)
{
  for (const TriangleMesh& mesh :
    { shapes::Bumpy(3), shapes::Rectangle(7, 5, 2.0, 1.0), shapes::Icosphere(2) })
  {
    const LaplaceOperator op = AssembleLaplaceOperator(mesh, MassMatrix::Lumped);
    const Eigen::VectorXd ones = Eigen::VectorXd::Ones(mesh.NumberOfVertices());
    EXPECT_LT((op.Stiffness * ones).cwiseAbs().maxCoeff(), 1e-12);
  }
}

TEST(LaplaceOperator, StiffnessIsExactlySymmetricAndPositiveSemiDefinite)
{
  const LaplaceOperator op = AssembleLaplaceOperator(shapes::Bumpy(2), MassMatrix::Lumped);
  const Eigen::MatrixXd s(op.Stiffness);
  EXPECT_EQ((s - s.transpose()).cwiseAbs().maxCoeff(), 0.0);
  const Eigen::VectorXd values = s.selfadjointView<Eigen::Lower>().eigenvalues();
  EXPECT_GT(values[0], -1e-12);
  EXPECT_GT(values[1], 1e-6);
}

TEST(LaplaceOperator, MassesSumToTheArea)
{
  const TriangleMesh mesh = shapes::Bumpy(3);
  const double area = AreaOf(mesh);
  for (const MassMatrix kind : { MassMatrix::Lumped, MassMatrix::Consistent })
  {
    const LaplaceOperator op = AssembleLaplaceOperator(mesh, kind);
    EXPECT_NEAR(op.Mass.sum(), area, 1e-12 * area);
    EXPECT_NEAR(op.VertexMass.sum(), area, 1e-12 * area);
    EXPECT_NEAR(op.Area, area, 1e-12 * area);
  }
}

TEST(LaplaceOperator, LumpedMassIsTheRowSumOfTheConsistentOne)
{
  const TriangleMesh mesh = shapes::Bumpy(2);
  const LaplaceOperator op = AssembleLaplaceOperator(mesh, MassMatrix::Consistent);
  const Eigen::VectorXd rowSums = op.Mass * Eigen::VectorXd::Ones(mesh.NumberOfVertices());
  EXPECT_LT((rowSums - op.VertexMass).cwiseAbs().maxCoeff(), 1e-15);
}

// x^T S x is the Dirichlet energy: the integral of the squared gradient, triangle by triangle,
// here from gradients instead of cotangents.
TEST(LaplaceOperator, QuadraticFormIsTheDirichletEnergy)
{
  const TriangleMesh mesh = shapes::Bumpy(3);
  const LaplaceOperator op = AssembleLaplaceOperator(mesh, MassMatrix::Lumped);
  const Eigen::VectorXd f = (3.0 * mesh.Points.col(0)).array().sin() + mesh.Points.col(2).array();
  double energy = 0.0;
  for (Index t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    const auto corner = mesh.Triangles.row(t);
    Eigen::Matrix<double, 2, 3> edges;
    edges.row(0) = mesh.Points.row(corner[1]) - mesh.Points.row(corner[0]);
    edges.row(1) = mesh.Points.row(corner[2]) - mesh.Points.row(corner[0]);
    const Eigen::Vector2d rise(f[corner[1]] - f[corner[0]], f[corner[2]] - f[corner[0]]);
    const Eigen::Matrix2d metric = edges * edges.transpose();
    energy += 0.5 * std::sqrt(metric.determinant()) * rise.dot(metric.inverse() * rise);
  }
  EXPECT_NEAR(f.dot(op.Stiffness * f), energy, 1e-12 * energy);
}

TEST(LaplaceOperator, ScaleChangesMassesButNotStiffness)
{
  const TriangleMesh mesh = shapes::Bumpy(2);
  TriangleMesh scaled = mesh;
  scaled.Points *= 1e-7;
  const LaplaceOperator op = AssembleLaplaceOperator(mesh, MassMatrix::Lumped);
  const LaplaceOperator small = AssembleLaplaceOperator(scaled, MassMatrix::Lumped);
  EXPECT_LT((op.Stiffness - small.Stiffness).norm(), 1e-12 * op.Stiffness.norm());
  EXPECT_LT((op.VertexMass - 1e14 * small.VertexMass).norm(), 1e-12 * op.VertexMass.norm());
}

TEST(LaplaceOperator, KernelHasOneVectorPerComponent)
{
  const TriangleMesh mesh =
    shapes::Union({ shapes::Icosphere(1), shapes::Bumpy(2), shapes::Icosphere(0, 0.3) }, 4.0);
  for (const MassMatrix kind : { MassMatrix::Lumped, MassMatrix::Consistent })
  {
    const LaplaceOperator op = AssembleLaplaceOperator(mesh, kind);
    ASSERT_EQ(op.Kernel.cols(), 3);
    EXPECT_LT((op.Stiffness * op.Kernel).cwiseAbs().maxCoeff(), 1e-12);
    const Eigen::MatrixXd gram = op.Kernel.transpose() * (op.Mass * op.Kernel);
    EXPECT_LT((gram - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_NEAR(op.Kernel.col(0).maxCoeff(), op.Kernel.col(0).minCoeff(), 1e-15);
  }
}

TEST(LaplaceOperator, ZeroAreaTriangleKeepsTheOperatorFiniteAndTheAreaTrue)
{
  TriangleMesh mesh = shapes::Rectangle(4, 4, 1.0, 1.0);
  // A triangle on three points of one line, as rounding of coordinates leaves them.
  mesh = shapes::WithTriangles(mesh, {}, { { 0, 1, 2 } });
  const LaplaceOperator op = AssembleLaplaceOperator(mesh, MassMatrix::Lumped);
  EXPECT_TRUE(Eigen::MatrixXd(op.Stiffness).allFinite());
  EXPECT_NEAR(op.VertexMass.sum(), 1.0, 1e-14);
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(mesh.NumberOfVertices());
  EXPECT_LT((op.Stiffness * ones).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(LaplaceOperator, ComponentWithoutAreaIsPinned)
{
  TriangleMesh mesh = shapes::Icosphere(1);
  const Index n = mesh.NumberOfVertices();
  mesh =
    shapes::WithTriangles(mesh, { { 5, 0, 0 }, { 6, 0, 0 }, { 7, 0, 0 } }, { { n, n + 1, n + 2 } });
  const LaplaceOperator op = AssembleLaplaceOperator(mesh, MassMatrix::Lumped);
  EXPECT_EQ(op.Kernel.cols(), 1);
  EXPECT_EQ(op.Rank, n);
  EXPECT_EQ(op.Kernel.bottomRows(3).cwiseAbs().maxCoeff(), 0.0);
}

TEST(LaplaceOperator, MeshWithoutAreaIsRefused)
{
  TriangleMesh mesh = shapes::Icosphere(1);
  mesh.Points.setOnes();
  ExpectRefusal([&] { AssembleLaplaceOperator(mesh, MassMatrix::Lumped); },
    "every triangle has zero area");
}

TEST(LaplaceOperator, MeshesThatMatricesCannotIndexAreRefused)
{
  constexpr Index most = 178956970; // 12 entries of each triangle are counted in an int
  EXPECT_NO_THROW(CheckMatrixSize(most, most));
  const std::string text =
    "over 178956970 triangles or points, more than the matrices can index; simplify it first";
  ExpectRefusal([] { CheckMatrixSize(most / 2, most + 1); }, text);
  ExpectRefusal([] { CheckMatrixSize(Index{ 1 } << 33, 2); }, text);
}

TEST(LaplaceOperator, SphereAreaConvergesQuadratically)
{
  const double coarse =
    4.0 * Pi - AssembleLaplaceOperator(shapes::Icosphere(3), MassMatrix::Lumped).Area;
  const double fine =
    4.0 * Pi - AssembleLaplaceOperator(shapes::Icosphere(4), MassMatrix::Lumped).Area;
  EXPECT_NEAR(coarse / fine, 4.0, 0.1);
}

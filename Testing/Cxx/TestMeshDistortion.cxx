// SPDX-License-Identifier: BSD-3-Clause
#include "Support/FilterTesting.h"

#include <vtkDataArray.h>
#include <vtkMeshDistortion.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSpectralWatermarkEmbed.h>

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

using namespace filtertesting;

namespace
{

double Mean(vtkDataArray* array)
{
  double sum = 0.0;
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    sum += array->GetComponent(i, 0);
  }
  return sum / static_cast<double>(array->GetNumberOfTuples());
}

} // namespace

TEST(MeshDistortion, TranslationIsAllGeometryAndNoCurvature)
{
  shapes::TriangleMesh moved = shapes::Icosphere(3);
  moved.Points.rowwise() += Eigen::RowVector3d(0.0, 0.3, 0.4);
  vtkNew<vtkMeshDistortion> distortion;
  EXPECT_EQ(distortion->GetGeomDiff(), -1.0);
  distortion->SetInputData(0, PolyData(shapes::Icosphere(3)));
  distortion->SetInputData(1, PolyData(moved));
  distortion->Update();
  const shapes::TriangleMesh sphere = shapes::Icosphere(3);
  const double diagonal =
    (sphere.Points.colwise().maxCoeff() - sphere.Points.colwise().minCoeff()).norm();
  EXPECT_NEAR(distortion->GetGeomDiff(), 0.5 / diagonal, 1e-14);
  EXPECT_NEAR(distortion->GetCurvDiff(), 0.0, 1e-14);
  EXPECT_TRUE(SamePoints(distortion->GetOutput(), PolyData(moved)));
}

// Growing a sphere of radius 1 by a tenth moves every vertex by 0.1 and its geometric Laplacian
// by a tenth of what it was.
TEST(MeshDistortion, ScalingOfTheIcosahedron)
{
  vtkNew<vtkMeshDistortion> distortion;
  distortion->SetInputData(0, PolyData(shapes::Icosphere(0, 1.0)));
  distortion->SetInputData(1, PolyData(shapes::Icosphere(0, 1.1)));
  distortion->Update();
  const shapes::TriangleMesh unit = shapes::Icosphere(0, 1.0);
  const double diagonal =
    (unit.Points.colwise().maxCoeff() - unit.Points.colwise().minCoeff()).norm();
  EXPECT_NEAR(distortion->GetGeomDiff(), 0.1 / diagonal, 1e-14);
  EXPECT_NEAR(distortion->GetCurvDiff(), 0.1 * (1.0 - 1.0 / std::sqrt(5.0)) / diagonal, 1e-14);
}

TEST(MeshDistortion, ArraysAverageToTheGetters)
{
  const auto mesh = PolyData(shapes::Bumpy(3));
  vtkNew<vtkSpectralWatermarkEmbed> embed;
  embed->SetInputData(mesh);
  vtkNew<vtkMeshDistortion> distortion;
  distortion->SetInputData(0, mesh);
  distortion->SetInputConnection(1, embed->GetOutputPort());
  distortion->Update();
  vtkDataArray* geometric = PointArray(distortion->GetOutput(), "GeometricDifference");
  vtkDataArray* curvature = PointArray(distortion->GetOutput(), "CurvatureDifference");
  ASSERT_NE(geometric, nullptr);
  ASSERT_NE(curvature, nullptr);
  EXPECT_NEAR(Mean(geometric), distortion->GetGeomDiff(), 1e-15);
  EXPECT_NEAR(Mean(curvature), distortion->GetCurvDiff(), 1e-15);
  EXPECT_GT(distortion->GetGeomDiff(), 1e-4);
  EXPECT_LT(distortion->GetGeomDiff(), 0.05);
  // The embedder's own account agrees.
  vtkDataArray* own = PointArray(distortion->GetOutput(), "GeometricDistortion");
  ASSERT_NE(own, nullptr);
  EXPECT_NEAR(Mean(own), distortion->GetGeomDiff(), 1e-14);
}

TEST(MeshDistortion, DifferentPointCountsAreRefused)
{
  vtkNew<vtkMeshDistortion> distortion;
  Listener listener(distortion);
  distortion->SetInputData(0, PolyData(shapes::Icosphere(2)));
  distortion->SetInputData(1, PolyData(shapes::Icosphere(1)));
  distortion->Update();
  EXPECT_NE(listener.Errors.find("162 and 42 points"), std::string::npos) << listener.Errors;
  EXPECT_NE(distortion->GetErrorCode(), 0u);
  EXPECT_EQ(distortion->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_EQ(distortion->GetGeomDiff(), -1.0);
}

TEST(MeshDistortion, PrintsItsResults)
{
  vtkNew<vtkMeshDistortion> distortion;
  std::ostringstream text;
  distortion->Print(text);
  EXPECT_NE(text.str().find("GeomDiff: -1"), std::string::npos);
  EXPECT_NE(text.str().find("CurvDiff: -1"), std::string::npos);
}

// SPDX-License-Identifier: BSD-3-Clause
#include "Support/FilterTesting.h"

#include <vtkDataArray.h>
#include <vtkMath.h>
#include <vtkMeshAttack.h>
#include <vtkMeshDistortion.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkSpectralWatermarkEmbed.h>

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <vector>

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
  embed->SetSchemeToPaperSlots();
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

// Other triangles of the same surface: no point has a counterpart, and the surfaces are the same.
TEST(MeshDistortion, ComparesSurfacesWhateverTheirTriangles)
{
  vtkNew<vtkMeshDistortion> distortion;
  distortion->SetInputData(0, PolyData(shapes::Rectangle(1, 1, 3.0, 4.0)));
  distortion->SetInputData(1, PolyData(shapes::Rectangle(7, 5, 3.0, 4.0)));
  distortion->Update();
  EXPECT_EQ(distortion->GetErrorCode(), 0u);
  EXPECT_EQ(distortion->GetGeomDiff(), -1.0);
  EXPECT_EQ(distortion->GetCurvDiff(), -1.0);
  EXPECT_EQ(distortion->GetMSDM(), -1.0);
  EXPECT_EQ(PointArray(distortion->GetOutput(), "GeometricDifference"), nullptr);
  EXPECT_NEAR(distortion->GetMRMS(), 0.0, 1e-12);
  EXPECT_NEAR(distortion->GetHausdorff(), 0.0, 1e-12);
  EXPECT_NEAR(distortion->GetMSDM2(), 0.0, 1e-9);
  EXPECT_NE(PointArray(distortion->GetOutput(), "SurfaceDistance"), nullptr);
  EXPECT_NE(PointArray(distortion->GetOutput(), "LocalMSDM2"), nullptr);
}

// A rectangle 3 x 4, diagonal 5, moved along its normal, or by 1 in its plane: a strip of 1 x 4 is then
// farther from the other one, up to 1, with squares that average to (1/3) of 1, over a third of the area.
TEST(MeshDistortion, DistancesBetweenRectangles)
{
  const shapes::TriangleMesh rectangle = shapes::Rectangle(1, 1, 3.0, 4.0);
  shapes::TriangleMesh above = rectangle;
  above.Points.col(2).array() += 0.5;
  shapes::TriangleMesh aside = rectangle;
  aside.Points.col(0).array() += 1.0;
  vtkNew<vtkMeshDistortion> distortion;
  distortion->SetInputData(0, PolyData(rectangle));
  distortion->SetInputData(1, PolyData(above));
  distortion->Update();
  EXPECT_NEAR(distortion->GetMRMS(), 0.1, 1e-12);
  EXPECT_NEAR(distortion->GetHausdorff(), 0.1, 1e-12);
  EXPECT_NEAR(distortion->GetMSDM(), 0.0, 1e-9);
  EXPECT_NEAR(distortion->GetMSDM2(), 0.0, 1e-9);
  EXPECT_NEAR(PointArray(distortion->GetOutput(), "SurfaceDistance")->GetTuple1(0), 0.1, 1e-12);
  distortion->SetInputData(1, PolyData(aside));
  distortion->Update();
  EXPECT_NEAR(distortion->GetMRMS(), std::sqrt(1.0 / 9.0) / 5.0, 1e-4);
  EXPECT_NEAR(distortion->GetHausdorff(), 0.2, 1e-12);
}

// The larger of both directions, whichever port has what sticks out.
TEST(MeshDistortion, SeesWhatOnlyOneSurfaceHas)
{
  const shapes::TriangleMesh plane = shapes::Rectangle(2, 2, 3.0, 4.0);
  shapes::TriangleMesh spike = shapes::Rectangle(30, 40, 3.0, 4.0);
  spike.Points(20 * 31 + 15, 2) = 1.0;
  vtkNew<vtkMeshDistortion> distortion;
  distortion->ComputePerceptualDistancesOff();
  distortion->SetInputData(0, PolyData(plane));
  distortion->SetInputData(1, PolyData(spike));
  distortion->Update();
  const double diagonal = 5.0;
  EXPECT_NEAR(distortion->GetHausdorff(), 1.0 / diagonal, 1e-12);
  EXPECT_EQ(distortion->GetMSDM2(), -1.0);
  EXPECT_EQ(PointArray(distortion->GetOutput(), "LocalMSDM2"), nullptr);
  const double rms = distortion->GetMRMS();
  distortion->SetInputData(0, PolyData(spike));
  distortion->SetInputData(1, PolyData(plane));
  distortion->Update();
  const double diagonalOfSpike = std::sqrt(26.0);
  EXPECT_NEAR(distortion->GetHausdorff(), 1.0 / diagonalOfSpike, 1e-12);
  EXPECT_NEAR(distortion->GetMRMS() * diagonalOfSpike, rms * diagonal, 1e-12);
}

TEST(MeshDistortion, MeasuresOnlyWhatIsAskedFor)
{
  vtkNew<vtkMeshDistortion> distortion;
  distortion->SetInputData(0, PolyData(shapes::Icosphere(2)));
  distortion->SetInputData(1, PolyData(shapes::Icosphere(2, 1.1)));
  distortion->ComputeSurfaceDistancesOff();
  distortion->ComputePerceptualDistancesOff();
  distortion->Update();
  EXPECT_GT(distortion->GetGeomDiff(), 0.0);
  EXPECT_EQ(distortion->GetMRMS(), -1.0);
  EXPECT_EQ(distortion->GetHausdorff(), -1.0);
  EXPECT_EQ(distortion->GetMSDM(), -1.0);
  EXPECT_EQ(distortion->GetMSDM2(), -1.0);
  EXPECT_EQ(PointArray(distortion->GetOutput(), "SurfaceDistance"), nullptr);
}

// Points in another order have no counterparts by number; the surfaces are the same.
TEST(MeshDistortion, ShuffledPointsDoNotCorrespond)
{
  const auto mesh = PolyData(shapes::Bumpy(3));
  vtkNew<vtkMeshAttack> shuffle;
  shuffle->SetInputData(mesh);
  shuffle->SetAttackToVertexReordering();
  vtkNew<vtkMeshDistortion> distortion;
  distortion->SetInputData(0, mesh);
  distortion->SetInputConnection(1, shuffle->GetOutputPort());
  distortion->Update();
  EXPECT_EQ(distortion->GetGeomDiff(), -1.0);
  EXPECT_NEAR(distortion->GetHausdorff(), 0.0, 1e-12);
  EXPECT_NEAR(distortion->GetMSDM2(), 0.0, 1e-6);
}

// To the eye: nothing for what a similarity does to both, the same from either side, and more the
// rougher the copy is. The cells that nearest points fall into must be the right ones for that.
TEST(MeshDistortion, PerceptualDistanceFollowsRoughness)
{
  const auto mesh = PolyData(shapes::Bumpy(4));
  vtkNew<vtkMeshAttack> noise;
  noise->SetInputData(mesh);
  noise->SetAttackToNoiseUniform();
  vtkNew<vtkMeshDistortion> distortion;
  distortion->SetInputData(0, mesh);
  distortion->SetInputConnection(1, noise->GetOutputPort());
  double last = 0.0;
  for (const double percent : { 0.01, 0.1, 1.0 })
  {
    noise->SetNoisePercent(percent);
    distortion->Update();
    EXPECT_GT(distortion->GetMSDM2(), 2.0 * last) << percent;
    EXPECT_LT(distortion->GetMSDM2(), 1.0);
    last = distortion->GetMSDM2();
  }
  distortion->SetInputConnection(0, noise->GetOutputPort());
  distortion->SetInputData(1, mesh);
  distortion->Update();
  EXPECT_NEAR(distortion->GetMSDM2(), last, 0.02 * last); // D is the reference's

  vtkNew<vtkMeshAttack> before;
  before->SetInputData(mesh);
  before->SetAttackToUniformScaling();
  before->SetScaleFactor(40.0);
  vtkNew<vtkMeshAttack> after;
  after->SetInputConnection(noise->GetOutputPort());
  after->SetAttackToUniformScaling();
  after->SetScaleFactor(40.0);
  distortion->SetInputConnection(0, before->GetOutputPort());
  distortion->SetInputConnection(1, after->GetOutputPort());
  distortion->Update();
  EXPECT_NEAR(distortion->GetMSDM2(), last, 1e-3 * last);
}

// Quantised coarsely, triangles fold onto each other: which of two that are equally close is taken must
// not depend on how threads fared.
TEST(MeshDistortion, IsTheSameEveryTime)
{
  const auto mesh = PolyData(shapes::Bumpy(6));
  vtkNew<vtkMeshAttack> quantise;
  quantise->SetInputData(mesh);
  quantise->SetAttackToQuantization();
  quantise->SetQuantizationBits(6);
  quantise->Update();
  const auto localDistortions = [&]()
  {
    vtkNew<vtkMeshDistortion> distortion;
    distortion->SetInputData(0, mesh);
    distortion->SetInputData(1, quantise->GetOutput());
    distortion->ComputeSurfaceDistancesOff();
    distortion->Update();
    vtkDataArray* array = PointArray(distortion->GetOutput(), "LocalMSDM2");
    std::vector<double> values;
    for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
    {
      values.push_back(array->GetComponent(i, 0));
    }
    return values;
  };
  const std::vector<double> first = localDistortions();
  for (int run = 0; run < 4; ++run)
  {
    EXPECT_EQ(localDistortions(), first);
  }
}

TEST(MeshDistortion, NeedsASurfaceOnBothPorts)
{
  vtkNew<vtkMeshDistortion> distortion;
  Listener listener(distortion);
  distortion->SetInputData(0, PolyData(shapes::Icosphere(1)));
  distortion->SetInputData(1, vtkSmartPointer<vtkPolyData>::New());
  distortion->Update();
  EXPECT_NE(listener.Errors.find("no points"), std::string::npos) << listener.Errors;
  EXPECT_NE(distortion->GetErrorCode(), 0u);
  EXPECT_EQ(distortion->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_EQ(distortion->GetMRMS(), -1.0);
}

// Meshes that do not correspond, where nothing but the correspondence is asked for.
TEST(MeshDistortion, DamagedMeshesAreRefusedThoughNothingIsMeasured)
{
  for (const int damagedPort : { 0, 1 })
  {
    const auto damaged = PolyData(shapes::Icosphere(2));
    damaged->GetPoints()->SetPoint(7, 0.0, vtkMath::Nan(), 0.0);
    vtkNew<vtkMeshDistortion> distortion;
    distortion->ComputeSurfaceDistancesOff();
    distortion->ComputePerceptualDistancesOff();
    distortion->SetInputData(damagedPort, damaged);
    distortion->SetInputData(1 - damagedPort, PolyData(shapes::Icosphere(1)));
    Listener listener(distortion);
    distortion->Update();
    EXPECT_NE(listener.Errors.find("point 7 has a coordinate that is not finite"),
      std::string::npos)
      << listener.Errors;
    EXPECT_EQ(distortion->GetOutput()->GetNumberOfPoints(), 0);
  }
}

// Points in a row: VTK measures no distance from triangles without area.
TEST(MeshDistortion, DistancesNeedASurfaceWithArea)
{
  shapes::TriangleMesh row = shapes::Rectangle(4, 4, 1.0, 1.0);
  row.Points.rightCols(2).setZero();
  row.Points.col(0).setLinSpaced(0.0, 1.0);
  for (const int port : { 0, 1 })
  {
    vtkNew<vtkMeshDistortion> distortion;
    distortion->SetInputData(port, PolyData(row));
    distortion->SetInputData(1 - port, PolyData(shapes::Icosphere(1)));
    Listener listener(distortion);
    distortion->Update();
    EXPECT_NE(listener.Errors.find("no triangle of the surface has an area"), std::string::npos)
      << listener.Errors;
    EXPECT_EQ(distortion->GetOutput()->GetNumberOfPoints(), 0);
    EXPECT_EQ(distortion->GetHausdorff(), -1.0);
  }
}

// Points in a row that is not along an axis: by rounding, triangles do have a little area.
TEST(MeshDistortion, PerceptualDistanceStaysInItsRangeBesideNeedles)
{
  shapes::TriangleMesh row = shapes::Rectangle(4, 4, 1.0, 1.0);
  row.Points.col(0).setLinSpaced(0.0, 1.0);
  row.Points.col(1) = (0.3 * row.Points.col(0)).array() + 1.0;
  row.Points.col(2) = 0.7 * row.Points.col(0);
  for (const int port : { 0, 1 })
  {
    vtkNew<vtkMeshDistortion> distortion;
    distortion->SetInputData(port, PolyData(row));
    distortion->SetInputData(1 - port, PolyData(shapes::SquaresOnABall(4)));
    distortion->Update();
    EXPECT_GT(distortion->GetMSDM2(), 0.0);
    EXPECT_LE(distortion->GetMSDM2(), 1.0);
    EXPECT_GT(distortion->GetHausdorff(), 0.1);
  }
}

TEST(MeshDistortion, PrintsItsResults)
{
  vtkNew<vtkMeshDistortion> distortion;
  std::ostringstream text;
  distortion->Print(text);
  EXPECT_NE(text.str().find("GeomDiff: -1"), std::string::npos);
  EXPECT_NE(text.str().find("CurvDiff: -1"), std::string::npos);
}

// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Mesh/Measures.h"

#include "Support/ExpectError.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFloatArray.h>
#include <vtkIdList.h>
#include <vtkImplicitPolyDataDistance.h>
#include <vtkMassProperties.h>
#include <vtkMath.h>
#include <vtkMeshAttack.h>
#include <vtkNew.h>
#include <vtkOutputWindow.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataConnectivityFilter.h>
#include <vtkPolyDataNormals.h>
#include <vtkStringOutputWindow.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <sstream>

using namespace filtertesting;

namespace
{

double Distance(vtkPolyData* a, vtkPolyData* b, vtkIdType i)
{
  double p[3];
  double q[3];
  a->GetPoint(i, p);
  b->GetPoint(i, q);
  return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

} // namespace

TEST(MeshAttack, RotationTurnsPointsAndNormals)
{
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(PolyData(shapes::Bumpy(2)));
  normals->SplittingOff();
  normals->Update();
  vtkPolyData* mesh = normals->GetOutput();
  const auto attack = AttackOn(mesh, vtkMeshAttack::Rotation);
  attack->SetRotationAxis(0.0, 0.0, 2.0);
  attack->SetRotationAngle(90.0);
  attack->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  attack->Update();
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    double before[3];
    double after[3];
    mesh->GetPoint(i, before);
    attack->GetOutput()->GetPoint(i, after);
    EXPECT_NEAR(after[0], -before[1], 1e-12);
    EXPECT_NEAR(after[1], before[0], 1e-12);
    EXPECT_NEAR(after[2], before[2], 1e-12);
    double normal[3];
    double turned[3];
    mesh->GetPointData()->GetNormals()->GetTuple(i, normal);
    attack->GetOutput()->GetPointData()->GetNormals()->GetTuple(i, turned);
    EXPECT_NEAR(turned[0], -normal[1], 1e-6);
    EXPECT_NEAR(turned[1], normal[0], 1e-6);
  }
}

TEST(MeshAttack, ScalingAndTranslation)
{
  const auto mesh = PolyData(shapes::Bumpy(1));
  const auto scaling = AttackOn(mesh, vtkMeshAttack::UniformScaling);
  scaling->SetScaleFactor(3.0);
  scaling->Update();
  const auto translation = AttackOn(mesh, vtkMeshAttack::Translation);
  translation->SetTranslationVector(1.0, 2.0, 2.0);
  translation->Update();
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    double p[3];
    double q[3];
    mesh->GetPoint(i, p);
    scaling->GetOutput()->GetPoint(i, q);
    EXPECT_NEAR(q[2], 3.0 * p[2], 1e-14);
    EXPECT_NEAR(Distance(mesh, translation->GetOutput(), i), 3.0, 1e-14);
  }
}

TEST(MeshAttack, NoiseIsDeterministicAndOfTheRightSize)
{
  const auto mesh = PolyData(shapes::Icosphere(4));
  const auto noise = AttackOn(mesh, vtkMeshAttack::NoiseAlongNormals);
  noise->SetNoiseFactor(0.3);
  noise->SetSeed(5);
  noise->Update();
  vtkNew<vtkPolyData> first;
  first->DeepCopy(noise->GetOutput());
  noise->Modified();
  noise->Update();
  EXPECT_TRUE(SamePoints(first, noise->GetOutput()));
  noise->SetSeed(6);
  noise->Update();
  EXPECT_FALSE(SamePoints(first, noise->GetOutput()));

  double squares = 0.0;
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    squares += std::pow(Distance(mesh, first, i), 2);
  }
  const double rms = std::sqrt(squares / static_cast<double>(mesh->GetNumberOfPoints()));
  const double edge = spectralwatermark::MeanEdgeLength(shapes::Icosphere(4));
  EXPECT_NEAR(rms, 0.3 * edge, 0.03 * 0.3 * edge);
}

TEST(MeshAttack, SmoothingRemovesDetailAndCanKeepTheResidual)
{
  const auto mesh = PolyData(shapes::Bumpy(4));
  const auto smoothing = AttackOn(mesh, vtkMeshAttack::SpectralSmoothing);
  smoothing->SetNumberOfHarmonics(100);
  smoothing->SetCutoffComponent(100);
  smoothing->KeepResidualOn();
  smoothing->Update();
  double largest = 0.0;
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    largest = std::max(largest, Distance(mesh, smoothing->GetOutput(), i));
  }
  EXPECT_LT(largest, 1e-12); // nothing over the cutoff, nothing dropped: nothing moved
  smoothing->KeepResidualOff();
  smoothing->Update();
  double dropped = 0.0;
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    dropped = std::max(dropped, Distance(mesh, smoothing->GetOutput(), i));
  }
  EXPECT_GT(dropped, 1e-4);
}

TEST(MeshAttack, SimplificationRemovesTheShareAskedFor)
{
  const auto mesh = PolyData(shapes::Bumpy(4), true);
  for (const double percent : { 0.0, 30.0, 90.0 })
  {
    const auto attack = AttackOn(mesh, vtkMeshAttack::Simplification);
    attack->SetSimplificationPercent(percent);
    attack->Update();
    const double left = static_cast<double>(attack->GetOutput()->GetNumberOfPolys()) /
      static_cast<double>(mesh->GetNumberOfPolys());
    EXPECT_NEAR(left, 1.0 - percent / 100.0, 0.01);
    // No point is left over, and the precision is the input's.
    EXPECT_NEAR(static_cast<double>(attack->GetOutput()->GetNumberOfPoints()),
      2.0 + 0.5 * static_cast<double>(attack->GetOutput()->GetNumberOfPolys()), 0.5);
    EXPECT_EQ(attack->GetOutput()->GetPoints()->GetDataType(), VTK_FLOAT);
  }
}

TEST(MeshAttack, AttributesAndUnusedPointsStay)
{
  const auto mesh = PolyData(shapes::Bumpy(3));
  const vtkIdType lonely = mesh->GetPoints()->InsertNextPoint(5.0, 5.0, 5.0);
  vtkNew<vtkFloatArray> colour;
  colour->SetName("Colour");
  colour->SetNumberOfTuples(mesh->GetNumberOfPoints());
  colour->Fill(0.25);
  mesh->GetPointData()->AddArray(colour);
  const auto noise = AttackOn(mesh, vtkMeshAttack::NoiseAlongNormals);
  noise->Update();
  EXPECT_NE(PointArray(noise->GetOutput(), "Colour"), nullptr);
  EXPECT_EQ(Distance(mesh, noise->GetOutput(), lonely), 0.0);
}

TEST(MeshAttack, EveryAttackHasItsNameAndLeavesASurface)
{
  const auto mesh = PolyData(shapes::Bumpy(3));
  const char* const names[] = { "Rotation", "UniformScaling", "Translation", "Similarity",
    "NoiseAlongNormals", "NoiseUniform", "SpectralSmoothing", "LaplacianSmoothing", "Quantization",
    "Simplification", "Subdivision", "VertexReordering", "Cropping", "Remeshing",
    "NonUniformScaling" };
  int kind = 0;
  for (const char* name : names)
  {
    SCOPED_TRACE(name);
    const auto attack = AttackOn(mesh, kind++);
    attack->SetIsosurfaceResolution(32);
    Listener listener(attack);
    attack->Update();
    EXPECT_STREQ(attack->GetAttackAsString(), name);
    EXPECT_EQ(listener.Errors, "");
    EXPECT_GT(attack->GetOutput()->GetNumberOfPolys(), 100);
    EXPECT_TRUE(std::is_sorted(listener.Progress.begin(), listener.Progress.end()));
    const auto again = AttackOn(mesh, attack->GetAttack());
    again->Update();
    EXPECT_TRUE(SamePoints(attack->GetOutput(), again->GetOutput()));
  }
}

TEST(MeshAttack, SimilarityKeepsProportions)
{
  const auto mesh = PolyData(shapes::Bumpy(2));
  const auto attack = AttackOn(mesh, vtkMeshAttack::Similarity);
  attack->SetSeed(7);
  attack->Update();
  const auto sizeOf = [](vtkPolyData* data, vtkIdType i)
  {
    double a[3];
    double b[3];
    data->GetPoint(i, a);
    data->GetPoint(i + 1, b);
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
  };
  const double scale = sizeOf(attack->GetOutput(), 0) / sizeOf(mesh, 0);
  EXPECT_GE(scale, 0.1);
  EXPECT_LE(scale, 10.0);
  for (vtkIdType i = 0; i + 1 < mesh->GetNumberOfPoints(); ++i)
  {
    EXPECT_NEAR(sizeOf(attack->GetOutput(), i), scale * sizeOf(mesh, i), 1e-5 * scale);
  }
}

TEST(MeshAttack, NonUniformScalingMultipliesEachAxis)
{
  const auto mesh = PolyData(shapes::Bumpy(1));
  const auto attack = AttackOn(mesh, vtkMeshAttack::NonUniformScaling);
  attack->SetAxisScaleFactors(2.0, 1.0, 0.5);
  attack->Update();
  double before[3];
  double after[3];
  mesh->GetPoint(5, before);
  attack->GetOutput()->GetPoint(5, after);
  EXPECT_DOUBLE_EQ(after[0], 2.0 * before[0]);
  EXPECT_DOUBLE_EQ(after[1], before[1]);
  EXPECT_DOUBLE_EQ(after[2], 0.5 * before[2]);
}

// Every point and polygon is there with its attributes, at another place.
TEST(MeshAttack, ReorderingKeepsPointsCellsAndAttributes)
{
  const auto mesh = PolyData(shapes::Bumpy(2));
  const vtkIdType points = mesh->GetNumberOfPoints();
  const vtkIdType cells = mesh->GetNumberOfCells();
  vtkNew<vtkFloatArray> number;
  number->SetName("Number");
  vtkNew<vtkFloatArray> cellNumber;
  cellNumber->SetName("CellNumber");
  for (vtkIdType i = 0; i < std::max(points, cells); ++i)
  {
    i < points ? number->InsertNextValue(static_cast<float>(i)) : 0;
    i < cells ? cellNumber->InsertNextValue(static_cast<float>(i)) : 0;
  }
  mesh->GetPointData()->AddArray(number);
  mesh->GetCellData()->AddArray(cellNumber);
  const auto attack = AttackOn(mesh, vtkMeshAttack::VertexReordering);
  attack->Update();
  vtkPolyData* shuffled = attack->GetOutput();
  ASSERT_EQ(shuffled->GetNumberOfPoints(), points);
  ASSERT_EQ(shuffled->GetNumberOfCells(), cells);
  vtkDataArray* from = PointArray(shuffled, "Number");
  std::set<vtkIdType> seen;
  vtkIdType inPlace = 0;
  for (vtkIdType i = 0; i < points; ++i)
  {
    const auto old = static_cast<vtkIdType>(from->GetTuple1(i));
    seen.insert(old);
    inPlace += old == i ? 1 : 0;
    double p[3];
    double q[3];
    shuffled->GetPoint(i, p);
    mesh->GetPoint(old, q);
    EXPECT_TRUE(std::equal(p, p + 3, q));
  }
  EXPECT_EQ(static_cast<vtkIdType>(seen.size()), points);
  EXPECT_LT(inPlace, 10);
  vtkDataArray* fromCell = shuffled->GetCellData()->GetArray("CellNumber");
  vtkNew<vtkIdList> corners;
  vtkNew<vtkIdList> oldCorners;
  for (vtkIdType c = 0; c < cells; ++c)
  {
    shuffled->GetCellPoints(c, corners);
    mesh->GetCellPoints(static_cast<vtkIdType>(fromCell->GetTuple1(c)), oldCorners);
    for (vtkIdType k = 0; k < 3; ++k)
    {
      EXPECT_EQ(from->GetTuple1(corners->GetId(k)), static_cast<double>(oldCorners->GetId(k)));
    }
  }
}

TEST(MeshAttack, CroppingLeavesTheShareAskedForWithItsAttributes)
{
  const auto mesh = PolyData(shapes::Bumpy(4));
  vtkNew<vtkFloatArray> height;
  height->SetName("Height");
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    height->InsertNextValue(static_cast<float>(mesh->GetPoint(i)[2]));
  }
  mesh->GetPointData()->AddArray(height);
  const auto attack = AttackOn(mesh, vtkMeshAttack::Cropping);
  attack->SetCroppingPercent(30.0);
  attack->Update();
  vtkPolyData* part = attack->GetOutput();
  EXPECT_NEAR(static_cast<double>(part->GetNumberOfPoints()),
    0.7 * static_cast<double>(mesh->GetNumberOfPoints()), 1.0);
  EXPECT_LT(part->GetNumberOfPolys(), mesh->GetNumberOfPolys() * 75 / 100);
  EXPECT_GT(part->GetNumberOfPolys(), mesh->GetNumberOfPolys() * 60 / 100);
  for (vtkIdType i = 0; i < part->GetNumberOfPoints(); ++i)
  {
    EXPECT_EQ(PointArray(part, "Height")->GetTuple1(i), static_cast<float>(part->GetPoint(i)[2]));
  }
}

TEST(MeshAttack, SubdivisionsHaveTheTrianglesOfTheirRule)
{
  const auto mesh = PolyData(shapes::Bumpy(2));
  const vtkIdType before = mesh->GetNumberOfPolys();
  const auto attack = AttackOn(mesh, vtkMeshAttack::Subdivision);
  attack->Update();
  EXPECT_STREQ(attack->GetSubdivisionTypeAsString(), "Midpoint");
  EXPECT_EQ(attack->GetOutput()->GetNumberOfPolys(), 4 * before);
  attack->SetSubdivisionTypeToLoop();
  attack->SetNumberOfSubdivisions(2);
  attack->Update();
  EXPECT_EQ(attack->GetOutput()->GetNumberOfPolys(), 16 * before);
  attack->SetSubdivisionTypeToSqrt3();
  attack->Update();
  EXPECT_EQ(attack->GetOutput()->GetNumberOfPolys(), 9 * before);
}

// Both remeshings lie on the surface, with other triangles.
TEST(MeshAttack, RemeshingStaysOnTheSurface)
{
  const auto mesh = PolyData(shapes::Bumpy(4));
  vtkNew<vtkImplicitPolyDataDistance> distance;
  distance->SetInput(mesh);
  const auto farthest = [&distance](vtkPolyData* data)
  {
    double most = 0.0;
    for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
    {
      most = std::max(most, std::abs(distance->EvaluateFunction(data->GetPoint(i))));
    }
    return most;
  };
  const auto attack = AttackOn(mesh, vtkMeshAttack::Remeshing);
  for (const double percent : { 30.0, 100.0, 200.0 })
  {
    attack->SetRemeshingPercent(percent);
    attack->Update();
    EXPECT_NEAR(static_cast<double>(attack->GetOutput()->GetNumberOfPoints()),
      percent / 100.0 * static_cast<double>(mesh->GetNumberOfPoints()),
      0.1 * percent / 100.0 * static_cast<double>(mesh->GetNumberOfPoints()));
    EXPECT_LT(farthest(attack->GetOutput()), 0.02 * mesh->GetLength());
  }
  attack->SetRemeshingMethodToIsosurface();
  attack->SetIsosurfaceResolution(64);
  attack->Update();
  EXPECT_STREQ(attack->GetRemeshingMethodAsString(), "Isosurface");
  EXPECT_GT(attack->GetOutput()->GetNumberOfPolys(), 10000);
  EXPECT_LT(farthest(attack->GetOutput()), 0.25 * mesh->GetLength() / 64.0);
  vtkNew<vtkMassProperties> before;
  before->SetInputData(mesh);
  vtkNew<vtkMassProperties> after;
  after->SetInputData(attack->GetOutput());
  EXPECT_NEAR(after->GetVolume(), before->GetVolume(), 0.005 * before->GetVolume());
}

// The edges that come in are split many times over, and neighbours at the same points.
TEST(MeshAttack, RemeshingTakesNeedles)
{
  const auto square = PolyData(shapes::Rectangle(200, 1, 1.0, 1.0));
  const auto attack = AttackOn(square, vtkMeshAttack::Remeshing);
  attack->Update();
  vtkPolyData* output = attack->GetOutput();
  const auto points = static_cast<double>(square->GetNumberOfPoints());
  EXPECT_NEAR(static_cast<double>(output->GetNumberOfPoints()), points, 0.1 * points);
  vtkNew<vtkMassProperties> size;
  size->SetInputData(output);
  EXPECT_NEAR(size->GetSurfaceArea(), 1.0, 0.15); // the border shrinks by a part of a step
  vtkNew<vtkPolyDataConnectivityFilter> parts;
  parts->SetInputData(output);
  parts->Update();
  EXPECT_EQ(parts->GetNumberOfExtractedRegions(), 1);
}

// A box has triangles far larger than the grid's steps: its inside must be inside everywhere.
TEST(MeshAttack, AnIsosurfaceOfLargeTrianglesIsTheirSolid)
{
  shapes::TriangleMesh box; // 2 x 1 x 1
  box.Points.resize(8, 3);
  box.Points << 0, 0, 0, 2, 0, 0, 0, 1, 0, 2, 1, 0, 0, 0, 1, 2, 0, 1, 0, 1, 1, 2, 1, 1;
  box.Triangles.resize(12, 3);
  box.Triangles << 0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2,
    2, 4, 6, 1, 3, 5, 3, 7, 5;
  const auto attack = AttackOn(PolyData(box), vtkMeshAttack::Remeshing);
  attack->SetRemeshingMethodToIsosurface();
  attack->SetIsosurfaceResolution(40);
  attack->Update();
  vtkNew<vtkMassProperties> solid;
  solid->SetInputData(attack->GetOutput());
  EXPECT_NEAR(solid->GetVolume(), 2.0, 0.02);
  EXPECT_NEAR(solid->GetSurfaceArea(), 10.0, 0.6); // edges of length 16 lose up to a step
}

// Turned inside out, and with a second solid that overlaps the first: what is inside of one is inside.
TEST(MeshAttack, AnIsosurfaceIsThatOfTheUnion)
{
  shapes::TriangleMesh two = shapes::Union({ shapes::Icosphere(3), shapes::Icosphere(3) }, 1.0);
  two.Triangles.col(1).swap(two.Triangles.col(2));
  const auto attack = AttackOn(PolyData(two), vtkMeshAttack::Remeshing);
  attack->SetRemeshingMethodToIsosurface();
  attack->SetIsosurfaceResolution(90);
  attack->Update();
  vtkNew<vtkMassProperties> solid;
  solid->SetInputData(attack->GetOutput());
  const double pi = 3.14159265358979323846;
  EXPECT_NEAR(solid->GetVolume(), 2.25 * pi, 0.02 * 2.25 * pi); // two caps of height 1.5
  vtkNew<vtkPolyDataConnectivityFilter> parts;
  parts->SetInputConnection(attack->GetOutputPort());
  parts->SetExtractionModeToAllRegions();
  parts->Update();
  EXPECT_EQ(parts->GetNumberOfExtractedRegions(), 1);
  double bounds[6];
  attack->GetOutput()->GetBounds(bounds);
  EXPECT_LT(bounds[1] - bounds[0], 3.0 + 0.05);
}

namespace
{

vtkSmartPointer<vtkPolyData> ThreeOnOneEdge()
{
  shapes::TriangleMesh fins;
  fins.Points.resize(5, 3);
  fins.Points << 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 1.0;
  fins.Triangles.resize(3, 3);
  fins.Triangles << 0, 1, 2, 0, 1, 3, 0, 1, 4;
  return PolyData(fins);
}

} // namespace

TEST(MeshAttack, PropertiesMustBeFinite)
{
  struct Property
  {
    const char* Name;
    int Attack;
    std::function<void(vtkMeshAttack*, double)> Set;
  };
  const std::vector<Property> properties = {
    { "RotationAngle", vtkMeshAttack::Rotation,
      [](auto* attack, double value) { attack->SetRotationAngle(value); } },
    { "RotationAxis", vtkMeshAttack::Rotation,
      [](auto* attack, double value) { attack->SetRotationAxis(1.0, value, 0.0); } },
    { "ScaleFactor", vtkMeshAttack::UniformScaling,
      [](auto* attack, double value) { attack->SetScaleFactor(value); } },
    { "AxisScaleFactors", vtkMeshAttack::NonUniformScaling,
      [](auto* attack, double value) { attack->SetAxisScaleFactors(1.0, 1.0, value); } },
    { "TranslationVector", vtkMeshAttack::Translation,
      [](auto* attack, double value) { attack->SetTranslationVector(0.0, 0.0, value); } },
    { "NoiseFactor", vtkMeshAttack::NoiseAlongNormals,
      [](auto* attack, double value) { attack->SetNoiseFactor(value); } },
    { "NoisePercent", vtkMeshAttack::NoiseUniform,
      [](auto* attack, double value) { attack->SetNoisePercent(value); } },
    { "SmoothingFactor", vtkMeshAttack::LaplacianSmoothing,
      [](auto* attack, double value) { attack->SetSmoothingFactor(value); } },
    { "SmoothingGain", vtkMeshAttack::SpectralSmoothing,
      [](auto* attack, double value) { attack->SetSmoothingGain(value); } },
  };
  const auto mesh = PolyData(shapes::Bumpy(1));
  for (const Property& property : properties)
  {
    const auto attack = AttackOn(mesh, property.Attack);
    property.Set(attack, vtkMath::Nan());
    ExpectError(attack, property.Name, "the value is not finite");
  }
}

// What VTK's filters inside say does not reach the user as well.
TEST(MeshAttack, AnErrorIsSaidOnce)
{
  vtkNew<vtkStringOutputWindow> window;
  const vtkSmartPointer<vtkOutputWindow> before = vtkOutputWindow::GetInstance();
  vtkOutputWindow::SetInstance(window);
  ExpectError(AttackOn(ThreeOnOneEdge(), vtkMeshAttack::Subdivision), "", "cannot be subdivided");
  vtkOutputWindow::SetInstance(before);
  EXPECT_EQ(window->GetOutput(), "");
}

TEST(MeshAttack, UnknownAttackAndBadParametersAreErrors)
{
  const auto mesh = PolyData(shapes::Bumpy(1));
  ExpectError(AttackOn(mesh, 77), "Attack", "77 is unknown");
  EXPECT_STREQ(AttackOn(mesh, 77)->GetAttackAsString(), "Unknown");
  auto attack = AttackOn(mesh, vtkMeshAttack::Rotation);
  attack->SetRotationAxis(0.0, 0.0, 0.0);
  ExpectError(attack, "RotationAxis", "length 0");
  attack = AttackOn(mesh, vtkMeshAttack::SpectralSmoothing);
  ExpectError(attack, "NumberOfHarmonics",
    "300 harmonics were requested, but the mesh has only 42");
  attack = AttackOn(mesh, vtkMeshAttack::Subdivision);
  attack->SetSubdivisionType(5);
  ExpectError(attack, "SubdivisionType", "5 is unknown");
  attack = AttackOn(ThreeOnOneEdge(), vtkMeshAttack::Subdivision);
  for (const int rule : { vtkMeshAttack::Midpoint, vtkMeshAttack::Loop })
  {
    attack->SetSubdivisionType(rule);
    ExpectError(attack, "", "cannot be subdivided: an edge has more than two triangles");
  }
  attack = AttackOn(mesh, vtkMeshAttack::Remeshing);
  attack->SetRemeshingMethod(-1);
  ExpectError(attack, "RemeshingMethod", "-1 is unknown");
  attack = AttackOn(PolyData(shapes::Rectangle(3, 3, 1.0, 1.0)), vtkMeshAttack::Remeshing);
  attack->SetRemeshingMethodToIsosurface();
  ExpectError(attack, "RemeshingMethod", "needs a closed surface");
  shapes::TriangleMesh flat = shapes::Icosphere(2);
  flat.Points.col(2) *= 1e-4;
  attack = AttackOn(PolyData(flat), vtkMeshAttack::Remeshing);
  attack->SetRemeshingMethodToIsosurface();
  attack->SetIsosurfaceResolution(8);
  ExpectError(attack, "IsosurfaceResolution", "thinner than a step of the grid; raise it");
  attack = AttackOn(mesh, vtkMeshAttack::NonUniformScaling);
  attack->SetAxisScaleFactors(1.0, 0.0, 1.0);
  ExpectError(attack, "AxisScaleFactors", "a factor of 0");
  attack = AttackOn(PolyData(shapes::Icosphere(0)), vtkMeshAttack::Simplification);
  attack->SetSimplificationPercent(99.9);
  ExpectError(attack, "SimplificationPercent", "no triangle is left; lower it");
  attack = AttackOn(PolyData(shapes::Icosphere(0)), vtkMeshAttack::Remeshing);
  attack->SetRemeshingPercent(0.1);
  ExpectError(attack, "RemeshingPercent", "no triangle is left; raise it");
  shapes::TriangleMesh needle = shapes::Icosphere(3); // from corner to corner of its bounding box
  needle.Points *= 1e-4;
  needle.Points.colwise() += Eigen::VectorXd::LinSpaced(needle.NumberOfVertices(), 0.0, 1.0).eval();
  shapes::TriangleMesh ribbon = shapes::Rectangle(3, 3, 1.0, 1e-5); // along an axis
  for (const shapes::TriangleMesh& thin : { needle, ribbon })
  {
    ExpectError(AttackOn(PolyData(thin), vtkMeshAttack::Remeshing), "",
      "too thin for its extent to be remeshed uniformly");
  }
  attack = AttackOn(mesh, vtkMeshAttack::Cropping);
  attack->SetCroppingPercent(99.0);
  ExpectError(attack, "CroppingPercent", "no polygon is left");
}

TEST(MeshAttack, PrintsItsProperties)
{
  vtkNew<vtkMeshAttack> attack;
  std::ostringstream text;
  attack->Print(text);
  for (const char* name : { "Attack: NoiseAlongNormals", "Seed: 0", "RotationAngle: 30",
         "ScaleFactor: 2", "NoiseFactor: 0.5", "CutoffComponent: 200", "SmoothingGain: 0.5",
         "SimplificationPercent: 50", "NoisePercent: 0.3", "SmoothingIterations: 10",
         "QuantizationBits: 9", "SubdivisionType: Midpoint", "CroppingPercent: 10",
         "RemeshingMethod: Uniform", "IsosurfaceResolution: 256", "AxisScaleFactors: 1 1 1.1" })
  {
    EXPECT_NE(text.str().find(name), std::string::npos) << name;
  }
}

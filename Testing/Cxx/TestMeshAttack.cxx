// SPDX-License-Identifier: BSD-3-Clause
#include "Support/FilterTesting.h"

#include <vtkDataArray.h>
#include <vtkFloatArray.h>
#include <vtkMath.h>
#include <vtkMeshAttack.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataNormals.h>

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

using namespace filtertesting;

namespace
{

vtkSmartPointer<vtkMeshAttack> AttackOn(vtkPolyData* mesh, int kind)
{
  auto attack = vtkSmartPointer<vtkMeshAttack>::New();
  attack->SetInputData(mesh);
  attack->SetAttack(kind);
  return attack;
}

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

TEST(MeshAttack, UnknownAttackAndBadParametersAreErrors)
{
  const auto mesh = PolyData(shapes::Bumpy(1));
  const auto expectError = [&](vtkMeshAttack* attack, const char* part)
  {
    Listener listener(attack);
    attack->Update();
    EXPECT_NE(listener.Errors.find(part), std::string::npos) << listener.Errors;
    EXPECT_NE(attack->GetErrorCode(), 0u);
    EXPECT_EQ(attack->GetOutput()->GetNumberOfPoints(), 0);
  };
  expectError(AttackOn(mesh, 77), "attack 77 is unknown");
  EXPECT_STREQ(AttackOn(mesh, 77)->GetAttackAsString(), "Unknown");
  auto attack = AttackOn(mesh, vtkMeshAttack::Rotation);
  attack->SetRotationAxis(0.0, 0.0, 0.0);
  expectError(attack, "length 0");
  attack = AttackOn(mesh, vtkMeshAttack::Translation);
  attack->SetTranslationVector(vtkMath::Nan(), 0.0, 0.0);
  expectError(attack, "must be finite");
  attack = AttackOn(mesh, vtkMeshAttack::SpectralSmoothing);
  expectError(attack, "300 harmonics were asked for, but the mesh has 42");
}

TEST(MeshAttack, PrintsItsProperties)
{
  vtkNew<vtkMeshAttack> attack;
  std::ostringstream text;
  attack->Print(text);
  for (const char* name : { "Attack: NoiseAlongNormals", "Seed: 0", "RotationAngle: 30",
         "ScaleFactor: 2", "NoiseFactor: 0.5", "CutoffComponent: 200", "SmoothingGain: 0.5",
         "SimplificationPercent: 50" })
  {
    EXPECT_NE(text.str().find(name), std::string::npos) << name;
  }
}

// SPDX-License-Identifier: BSD-3-Clause
#include "Support/FilterTesting.h"

#include <vtkDataArray.h>
#include <vtkManifoldHarmonics.h>
#include <vtkManifoldHarmonicsReconstruction.h>
#include <vtkManifoldHarmonicsSimilarity.h>
#include <vtkMeshAttack.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkTable.h>

#include <gtest/gtest.h>

#include <sstream>

using namespace filtertesting;

namespace
{

class HarmonicsSimilarity : public testing::Test
{
protected:
  HarmonicsSimilarity()
  {
    this->Similarity->SetInputData(0, PolyData(shapes::Bumpy(4)));
    this->Similarity->SetNumberOfHarmonics(60);
  }

  double Of(int component)
  {
    vtkDataArray* array = FieldArray(this->Similarity->GetOutput(), "Similarity");
    return array == nullptr ? -1.0 : array->GetComponent(component - 1, 0);
  }

  vtkNew<vtkManifoldHarmonicsSimilarity> Similarity;
};

} // namespace

TEST_F(HarmonicsSimilarity, TheSameMeshIsAllOnes)
{
  this->Similarity->SetInputData(1, PolyData(shapes::Bumpy(4)));
  this->Similarity->Update();
  EXPECT_EQ(this->Similarity->GetNumberOfEigensolves(), 2);
  EXPECT_NEAR(this->Similarity->GetMeanSimilarity(), 1.0, 1e-9);
  auto* table = vtkTable::SafeDownCast(this->Similarity->GetOutputDataObject(1));
  ASSERT_NE(table, nullptr);
  ASSERT_EQ(table->GetNumberOfRows(), 60);
  for (vtkIdType row = 0; row < 60; ++row)
  {
    EXPECT_EQ(table->GetValueByName(row, "Component").ToInt(), row + 1);
    EXPECT_EQ(table->GetValueByName(row, "Eigenvalue").ToDouble(),
      table->GetValueByName(row, "OtherEigenvalue").ToDouble());
    EXPECT_EQ(table->GetValueByName(row, "Similarity").ToDouble(),
      this->Of(static_cast<int>(row) + 1));
  }
}

// Figure 3: component 50 doubled. Low components hardly change; all stay in [0, 1].
TEST_F(HarmonicsSimilarity, OneDoubledComponentLeavesMostOfTheBasis)
{
  vtkNew<vtkManifoldHarmonicsReconstruction> doubled;
  doubled->SetInputData(PolyData(shapes::Bumpy(4)));
  doubled->SetNumberOfHarmonics(60);
  doubled->KeepResidualOn();
  doubled->SetGain(50, 2.0);
  this->Similarity->SetInputConnection(1, doubled->GetOutputPort());
  this->Similarity->Update();
  for (int component = 1; component <= 60; ++component)
  {
    EXPECT_GE(this->Of(component), 0.0);
    EXPECT_LE(this->Of(component), 1.0);
  }
  EXPECT_GT(this->Of(2), 0.999);
  EXPECT_GT(this->Similarity->GetMeanSimilarity(), 0.8);
  EXPECT_LT(this->Similarity->GetMeanSimilarity(), 1.0 - 1e-9);
}

// Another triangulation of the same surface, compared at closest points.
TEST_F(HarmonicsSimilarity, SimplifiedMeshIsComparedAtClosestPoints)
{
  vtkNew<vtkMeshAttack> simplify;
  simplify->SetInputData(PolyData(shapes::Bumpy(4)));
  simplify->SetAttackToSimplification();
  this->Similarity->SetInputConnection(1, simplify->GetOutputPort());
  this->Similarity->SetNumberOfHarmonics(20);
  this->Similarity->Update();
  EXPECT_NEAR(this->Of(1), 1.0, 1e-9); // constants stay constants
  for (int component = 2; component <= 12; ++component)
  {
    EXPECT_GT(this->Of(component), 0.97) << component;
  }
}

TEST_F(HarmonicsSimilarity, BasesOnTheInputsAreUsed)
{
  vtkNew<vtkManifoldHarmonics> harmonics;
  harmonics->SetInputData(PolyData(shapes::Bumpy(4)));
  harmonics->SetNumberOfHarmonics(30);
  this->Similarity->SetInputConnection(0, harmonics->GetOutputPort());
  this->Similarity->SetInputConnection(1, harmonics->GetOutputPort());
  this->Similarity->SetNumberOfHarmonics(0);
  this->Similarity->Update();
  EXPECT_EQ(this->Similarity->GetNumberOfEigensolves(), 0);
  EXPECT_EQ(FieldArray(this->Similarity->GetOutput(), "Similarity")->GetNumberOfTuples(), 30);
}

TEST_F(HarmonicsSimilarity, WithoutABasisItSaysSo)
{
  this->Similarity->SetNumberOfHarmonics(0);
  this->Similarity->SetInputData(1, PolyData(shapes::Bumpy(4)));
  Listener listener(this->Similarity);
  this->Similarity->Update();
  EXPECT_NE(listener.Errors.find("carries no basis"), std::string::npos) << listener.Errors;
  EXPECT_NE(this->Similarity->GetErrorCode(), 0u);
  EXPECT_EQ(this->Similarity->GetMeanSimilarity(), -1.0);
  EXPECT_EQ(this->Similarity->GetOutput()->GetNumberOfPoints(), 0);
}

TEST_F(HarmonicsSimilarity, PrintsItsProperties)
{
  std::ostringstream text;
  this->Similarity->Print(text);
  for (const char* name : { "NumberOfHarmonics: 60", "ClusterTolerance: 1e-06" })
  {
    EXPECT_NE(text.str().find(name), std::string::npos) << name;
  }
}

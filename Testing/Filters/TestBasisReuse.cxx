// SPDX-License-Identifier: BSD-3-Clause
// A basis computed once serves every filter after it, and a stale one none.
#include "Support/FilterTesting.h"

#include <vtkDataArray.h>
#include <vtkManifoldHarmonics.h>
#include <vtkMeshAttack.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSpectralWatermarkDetect.h>
#include <vtkSpectralWatermarkEmbed.h>
#include <vtkTransform.h>
#include <vtkTransformPolyDataFilter.h>

#include <gtest/gtest.h>

using namespace filtertesting;

namespace
{

class BasisReuse : public testing::Test
{
protected:
  BasisReuse()
  {
    this->Harmonics->SetInputData(PolyData(shapes::Bumpy(4)));
    this->Harmonics->SetNumberOfHarmonics(80);
  }

  // Eigensolves that detection needs behind a transform of the mesh with its basis.
  int SolvesBehind(vtkTransform* transform)
  {
    vtkNew<vtkTransformPolyDataFilter> move;
    move->SetInputConnection(this->Harmonics->GetOutputPort());
    move->SetTransform(transform);
    vtkNew<vtkSpectralWatermarkDetect> detect;
    detect->SetSchemeToPaperSlots();
    detect->SetInputConnection(move->GetOutputPort());
    detect->Update();
    EXPECT_NE(PointArray(move->GetOutput(), "ManifoldHarmonics"), nullptr);
    return detect->GetNumberOfEigensolves();
  }

  vtkNew<vtkManifoldHarmonics> Harmonics;
};

} // namespace

TEST_F(BasisReuse, DetectComputesNoneBehindHarmonics)
{
  vtkNew<vtkSpectralWatermarkDetect> detect;
  detect->SetSchemeToPaperSlots();
  detect->SetInputConnection(this->Harmonics->GetOutputPort());
  detect->Update();
  EXPECT_EQ(detect->GetNumberOfEigensolves(), 0);

  vtkNew<vtkSpectralWatermarkDetect> alone;
  alone->SetSchemeToPaperSlots();
  alone->SetInputConnection(this->Harmonics->GetOutputPort());
  alone->SetNumberOfBits(7); // 90 harmonics: more than there are
  alone->Update();
  EXPECT_EQ(alone->GetNumberOfEigensolves(), 1);
  EXPECT_EQ(std::string(alone->GetExtractedMessage()).substr(0, 5), detect->GetExtractedMessage());
}

TEST_F(BasisReuse, EmbedSavesItsFirstSolveAndComesToTheSameMesh)
{
  vtkNew<vtkSpectralWatermarkEmbed> with;
  with->SetSchemeToPaperSlots();
  with->SetInputConnection(this->Harmonics->GetOutputPort());
  with->Update();
  vtkNew<vtkSpectralWatermarkEmbed> without;
  without->SetSchemeToPaperSlots();
  without->SetInputData(PolyData(shapes::Bumpy(4)));
  without->Update();
  EXPECT_EQ(with->GetNumberOfEigensolves(), with->GetNumberOfIterationsUsed());
  EXPECT_EQ(without->GetNumberOfEigensolves(), without->GetNumberOfIterationsUsed() + 1);
  EXPECT_STREQ(with->GetExtractedMessage(), without->GetExtractedMessage());
  for (vtkIdType i = 0; i < with->GetOutput()->GetNumberOfPoints(); i += 13)
  {
    double p[3];
    double q[3];
    with->GetOutput()->GetPoint(i, p);
    without->GetOutput()->GetPoint(i, q);
    EXPECT_NEAR(p[0], q[0], 1e-7);
  }
}

TEST_F(BasisReuse, FiltersThatMovePointsDropTheBasis)
{
  vtkNew<vtkSpectralWatermarkEmbed> embed;
  embed->SetSchemeToPaperSlots();
  embed->SetInputConnection(this->Harmonics->GetOutputPort());
  embed->Update();
  vtkNew<vtkMeshAttack> attack;
  attack->SetInputConnection(this->Harmonics->GetOutputPort());
  attack->SetAttackToRotation();
  attack->Update();
  for (vtkPolyData* output : { embed->GetOutput(), attack->GetOutput() })
  {
    EXPECT_EQ(PointArray(output, "ManifoldHarmonics"), nullptr);
    EXPECT_EQ(PointArray(output, "VertexMass"), nullptr);
    EXPECT_EQ(FieldArray(output, "Eigenvalues"), nullptr);
    EXPECT_EQ(FieldArray(output, "Spectrum"), nullptr);
    EXPECT_EQ(FieldArray(output, "SpectrumMagnitude"), nullptr);
    EXPECT_EQ(FieldArray(output, "Residuals"), nullptr);
  }
  // And take nothing from the filter before them.
  EXPECT_NE(PointArray(this->Harmonics->GetOutput(), "ManifoldHarmonics"), nullptr);
  EXPECT_NE(FieldArray(this->Harmonics->GetOutput(), "Eigenvalues"), nullptr);
}

TEST_F(BasisReuse, ARotatedBasisIsStillOne)
{
  vtkNew<vtkTransform> rotation;
  rotation->RotateX(40.0);
  rotation->Translate(1.0, 2.0, 3.0);
  EXPECT_EQ(this->SolvesBehind(rotation), 0);
}

TEST_F(BasisReuse, AStaleBasisIsNoticed)
{
  vtkNew<vtkTransform> scaling;
  scaling->Scale(1.001, 1.001, 1.001);
  EXPECT_EQ(this->SolvesBehind(scaling), 1);
  vtkNew<vtkTransform> stretching;
  stretching->Scale(1.0, 1.0, 1.0001);
  EXPECT_EQ(this->SolvesBehind(stretching), 1);
}

TEST_F(BasisReuse, AConsistentBasisIsNotTakenForALumpedOne)
{
  this->Harmonics->SetMassMatrixToConsistent();
  vtkNew<vtkSpectralWatermarkDetect> detect;
  detect->SetSchemeToPaperSlots();
  detect->SetInputConnection(this->Harmonics->GetOutputPort());
  detect->Update();
  EXPECT_EQ(detect->GetNumberOfEigensolves(), 1);
}

TEST_F(BasisReuse, SmoothingUsesTheBasisToo)
{
  vtkNew<vtkMeshAttack> attack;
  attack->SetInputConnection(this->Harmonics->GetOutputPort());
  attack->SetAttackToSpectralSmoothing();
  attack->SetNumberOfHarmonics(80);
  attack->SetCutoffComponent(60);
  attack->Update();
  EXPECT_EQ(attack->GetNumberOfEigensolves(), 0);
}

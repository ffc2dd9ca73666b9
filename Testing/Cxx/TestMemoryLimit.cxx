// SPDX-License-Identifier: BSD-3-Clause
// What does not fit into memory is refused before the work, and the filter works once it fits.
#include "Support/AddressSpace.h"
#include "Support/FilterTesting.h"

#include <vtkErrorCode.h>
#include <vtkManifoldHarmonics.h>
#include <vtkMeshAttack.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSpectralWatermarkEmbed.h>

#include <gtest/gtest.h>

#ifndef SPECTRALWATERMARK_NO_ADDRESS_LIMIT

using namespace filtertesting;

namespace
{

constexpr double Little = 120e6;

void ExpectRefusal(vtkPolyDataAlgorithm* filter, const std::string& work, const std::string& advice)
{
  Listener listener(filter);
  {
    const AddressSpaceLimit limit(Little);
    ASSERT_TRUE(limit.Holds());
    filter->Update();
  }
  EXPECT_EQ(filter->GetErrorCode(), vtkErrorCode::UserError);
  EXPECT_NE(listener.Errors.find(work + " need about "), std::string::npos) << listener.Errors;
  EXPECT_NE(listener.Errors.find(" are free: " + advice), std::string::npos) << listener.Errors;
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
}

vtkSmartPointer<vtkPolyData> LargeSphere()
{
  return PolyData(shapes::Icosphere(6)); // 40,962 vertices
}

} // namespace

TEST(MemoryLimit, Harmonics)
{
  vtkNew<vtkManifoldHarmonics> harmonics;
  harmonics->SetInputData(LargeSphere());
  harmonics->SetNumberOfHarmonics(100);
  ExpectRefusal(harmonics, "100 harmonics of 40962 vertices", "ask for fewer harmonics");
  harmonics->Modified();
  harmonics->Update();
  EXPECT_EQ(harmonics->GetErrorCode(), vtkErrorCode::NoError);
  EXPECT_EQ(PointArray(harmonics->GetOutput(), "ManifoldHarmonics")->GetNumberOfComponents(), 100);
}

TEST(MemoryLimit, TheDenseSolver)
{
  vtkNew<vtkManifoldHarmonics> harmonics;
  harmonics->SetSolverToDense();
  harmonics->SetInputData(PolyData(shapes::Icosphere(4)));
  ExpectRefusal(harmonics, "100 harmonics of 2562 vertices", "choose another solver");
}

TEST(MemoryLimit, Embedding)
{
  vtkNew<vtkSpectralWatermarkEmbed> embed;
  embed->SetInputData(LargeSphere());
  embed->SetSecretKey("an owner");
  ExpectRefusal(embed, "64 bits in 40962 vertices", "embed fewer bits");
}

TEST(MemoryLimit, Attacks)
{
  vtkNew<vtkMeshAttack> attack;
  attack->SetInputData(LargeSphere());
  attack->SetAttackToSubdivision();
  attack->SetNumberOfSubdivisions(6);
  ExpectRefusal(attack, "335544320 triangles", "lower NumberOfSubdivisions");
  attack->SetSubdivisionTypeToSqrt3();
  ExpectRefusal(attack, "59719680 triangles", "lower NumberOfSubdivisions");
  attack->SetAttackToRemeshing();
  attack->SetRemeshingPercent(1000.0);
  ExpectRefusal(attack, "409620 vertices", "lower RemeshingPercent");
  attack->SetRemeshingMethodToIsosurface();
  attack->SetIsosurfaceResolution(1024);
  ExpectRefusal(attack, "1024 steps along the longest side", "lower IsosurfaceResolution");
}

#endif

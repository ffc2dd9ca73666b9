// SPDX-License-Identifier: BSD-3-Clause
// Unmarked meshes that are unlike scans, on which eigenvalues repeat and most magnitudes are rounding
// errors. The p-values of PaperSlots hold there too; Core/RobustScheme/TestRobustReader.cxx tests
// those of Robust.
#include "Support/FilterTesting.h"
#include "Support/PValues.h"

#include <vtkErrorCode.h>
#include <vtkManifoldHarmonics.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSpectralWatermarkDetect.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace filtertesting;

namespace
{

struct Host
{
  const char* Name;
  vtkSmartPointer<vtkPolyData> Mesh;
};

std::vector<Host> Hosts()
{
  return { { "sphere", PolyData(shapes::Icosphere(3)) },
    { "torus", PolyData(shapes::Torus(48, 16)) }, { "cube", PolyData(shapes::Cube(10)) },
    { "square", PolyData(shapes::Rectangle(20, 20, 1.0, 1.0)) },
    { "strip", PolyData(shapes::Rectangle(150, 3, 50.0, 1.0)) },
    { "two spheres", PolyData(shapes::Union({ 2, shapes::Icosphere(2) }, 3.0)) } };
}

vtkSmartPointer<vtkPolyData> WithHarmonics(vtkPolyData* mesh, int count)
{
  vtkNew<vtkManifoldHarmonics> harmonics;
  harmonics->SetInputData(mesh);
  harmonics->SetNumberOfHarmonics(count);
  harmonics->Update();
  return harmonics->GetOutput();
}

std::vector<double> PValuesOfKeys(vtkSpectralWatermarkDetect* detect, int keys)
{
  std::vector<double> pValues;
  detect->UseDerivedMessageOn();
  detect->SetFalsePositiveRate(1e-3); // what so few bits can prove
  for (int k = 0; k < keys; ++k)
  {
    detect->SetSecretKey(("who marked nothing " + std::to_string(k)).c_str());
    detect->Update();
    EXPECT_EQ(detect->GetErrorCode(), vtkErrorCode::NoError);
    pValues.push_back(detect->GetPValue());
  }
  return pValues;
}

} // namespace

TEST(FalsePositives, PaperSlotsUnderKeys)
{
  for (const Host& host : Hosts())
  {
    SCOPED_TRACE(host.Name);
    for (const int detector :
      { vtkSpectralWatermarkDetect::HardDecisions, vtkSpectralWatermarkDetect::Likelihood })
    {
      vtkNew<vtkSpectralWatermarkDetect> detect;
      detect->SetInputData(WithHarmonics(host.Mesh, 160));
      detect->SetSchemeToPaperSlots();
      detect->SetNumberOfBits(12);
      detect->SetFirstComponent(21);
      detect->SetDetector(detector);
      pvalues::ExpectValid(PValuesOfKeys(detect, 200));
      EXPECT_EQ(detect->GetNumberOfEigensolves(), 0);
    }
  }
}

// Without a key anyone knows where to look. Of all messages, no more agree than the p-value says,
// whatever the mesh.
TEST(FalsePositives, PaperSlotsWithoutAKeyOverAllMessages)
{
  constexpr int bits = 7;
  constexpr int messages = 1 << bits;
  for (const Host& host : Hosts())
  {
    SCOPED_TRACE(host.Name);
    vtkNew<vtkSpectralWatermarkDetect> detect;
    detect->SetInputData(WithHarmonics(host.Mesh, 120));
    detect->SetSchemeToPaperSlots();
    detect->SetFalsePositiveRate(0.05); // what so few bits can prove
    std::vector<double> pValues;
    for (int number = 0; number < messages; ++number)
    {
      std::string message;
      for (int bit = 0; bit < bits; ++bit)
      {
        message += (number >> bit & 1) != 0 ? '1' : '0';
      }
      detect->SetExpectedMessage(message.c_str());
      detect->Update();
      EXPECT_EQ(detect->GetErrorCode(), vtkErrorCode::NoError);
      pValues.push_back(detect->GetPValue());
    }
    for (const double value : pValues)
    {
      const auto asSmall = std::count_if(pValues.begin(), pValues.end(),
        [value](double other) { return other <= value; });
      EXPECT_LE(static_cast<double>(asSmall) / messages, value);
    }
  }
}

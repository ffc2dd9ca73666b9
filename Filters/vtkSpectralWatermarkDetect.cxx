// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSpectralWatermarkDetect.h"

#include "Core/SlotWatermark.h"
#include "Private/FilterRun.h"
#include "Private/HarmonicsArrays.h"
#include "Private/PolyDataMesh.h"
#include "Private/SlotTable.h"

#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkTable.h>

namespace sw = spectralwatermark;

vtkStandardNewMacro(vtkSpectralWatermarkDetect);

vtkSpectralWatermarkDetect::vtkSpectralWatermarkDetect() = default;
vtkSpectralWatermarkDetect::~vtkSpectralWatermarkDetect() = default;

void vtkSpectralWatermarkDetect::SetExpectedMessage(const char* message)
{
  const std::string wanted = message != nullptr ? message : "";
  if (wanted != this->ExpectedMessage)
  {
    this->ExpectedMessage = wanted;
    this->Modified();
  }
}

int vtkSpectralWatermarkDetect::RequestData(vtkInformation*, vtkInformationVector** inputs,
  vtkInformationVector* outputs)
{
  this->ResetResults();
  return sw::RunFilter(this, this->ErrorCode, outputs,
    [&]()
    {
      vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
      const sw::PolyDataMesh mesh = sw::ToMesh(input);

      sw::SlotOptions slots;
      this->GetSlotOptions(slots);
      sw::CheckMessage(this->ExpectedMessage);
      const sw::Index bits = this->ExpectedMessage.empty()
        ? this->NumberOfBits
        : static_cast<sw::Index>(this->ExpectedMessage.size());
      sw::CheckSlots(slots, bits);
      sw::CheckCapacity(slots, bits, mesh.Mesh.NumberOfVertices());

      const sw::ManifoldHarmonics harmonics = sw::FindOrComputeHarmonics(input, mesh,
        sw::ComponentsNeeded(slots, bits), sw::ProgressOf(this), this->NumberOfEigensolves);
      sw::CheckSlotsAboveKernel(slots, harmonics.KernelDimension);
      const std::vector<sw::SlotReading> readings = sw::ReadSlots(
        sw::Magnitudes(sw::ForwardTransform(harmonics, mesh.Mesh.Points)), slots, bits);

      vtkPolyData::GetData(outputs, 0)->ShallowCopy(input);
      sw::FillDetectionTable(vtkTable::GetData(outputs, 1), readings);
      this->ExtractedMessage = sw::MessageOf(readings);
      this->CompareWithExpected();
    });
}

void vtkSpectralWatermarkDetect::ResetResults()
{
  this->ExtractedMessage.clear();
  this->BitErrorRate = -1.0;
  this->Correlation = 0.0;
  this->PValue = 1.0;
  this->Detected = 0;
  this->NumberOfEigensolves = 0;
}

void vtkSpectralWatermarkDetect::CompareWithExpected()
{
  if (this->ExpectedMessage.empty())
  {
    return;
  }
  const auto bits = static_cast<sw::Index>(this->ExpectedMessage.size());
  const sw::Index agreements = sw::CountAgreements(this->ExtractedMessage, this->ExpectedMessage);
  this->BitErrorRate = 1.0 - static_cast<double>(agreements) / static_cast<double>(bits);
  this->Correlation = 1.0 - 2.0 * this->BitErrorRate;
  this->PValue = sw::AgreementPValue(agreements, bits);
  this->Detected = this->PValue <= this->FalsePositiveRate ? 1 : 0;
  const double reachable = sw::AgreementPValue(bits, bits);
  if (reachable > this->FalsePositiveRate)
  {
    vtkWarningMacro(<< bits << " bits cannot prove a mark at a false positive rate of "
                    << this->FalsePositiveRate << ": even full agreement happens by chance with "
                    << "probability " << reachable
                    << ". Embed more bits, or raise FalsePositiveRate");
  }
}

void vtkSpectralWatermarkDetect::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfBits: " << this->NumberOfBits << "\n";
  os << indent << "ExpectedMessage: " << this->ExpectedMessage << "\n";
  os << indent << "FalsePositiveRate: " << this->FalsePositiveRate << "\n";
  os << indent << "ExtractedMessage: " << this->ExtractedMessage << "\n";
  os << indent << "MessageIsValid: " << this->MessageIsValid << "\n";
  os << indent << "BitErrorRate: " << this->BitErrorRate << "\n";
  os << indent << "Correlation: " << this->Correlation << "\n";
  os << indent << "PValue: " << this->PValue << "\n";
  os << indent << "Detected: " << this->Detected << "\n";
  os << indent << "NumberOfEigensolves: " << this->NumberOfEigensolves << "\n";
}

// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSpectralWatermarkAlgorithm.h"

#include "Core/Errors.h"
#include "Core/SlotWatermark.h"

#include <vtkInformation.h>
#include <vtkTable.h>

#include <string>

namespace sw = spectralwatermark;

vtkSpectralWatermarkAlgorithm::vtkSpectralWatermarkAlgorithm()
{
  this->SetNumberOfOutputPorts(2);
}

vtkSpectralWatermarkAlgorithm::~vtkSpectralWatermarkAlgorithm() = default;

const char* vtkSpectralWatermarkAlgorithm::GetSchemeAsString() const
{
  return this->Scheme == PaperSlots ? "PaperSlots" : "Unknown";
}

const char* vtkSpectralWatermarkAlgorithm::GetSlotDivisionAsString() const
{
  return this->SlotDivision == Normal ? "Normal" : "InterleavedNarrow";
}

int vtkSpectralWatermarkAlgorithm::FillOutputPortInformation(int port, vtkInformation* info)
{
  if (port == 0)
  {
    return this->Superclass::FillOutputPortInformation(port, info);
  }
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkTable");
  return 1;
}

void vtkSpectralWatermarkAlgorithm::GetSlotOptions(sw::SlotOptions& options) const
{
  if (this->Scheme != PaperSlots)
  {
    throw sw::InvalidInput(
      "scheme " + std::to_string(this->Scheme) + " is unknown: this version has PaperSlots (0)");
  }
  options.FirstComponent = this->FirstComponent;
  options.SlotSize = this->SlotSize;
  options.CarrierPosition = this->CarrierPosition;
  options.Division = static_cast<sw::SlotDivision>(this->SlotDivision);
}

void vtkSpectralWatermarkAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Scheme: " << this->GetSchemeAsString() << "\n";
  os << indent << "SlotDivision: " << this->GetSlotDivisionAsString() << "\n";
  os << indent << "FirstComponent: " << this->FirstComponent << "\n";
  os << indent << "SlotSize: " << this->SlotSize << "\n";
  os << indent << "CarrierPosition: " << this->CarrierPosition << "\n";
}

// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSpectralWatermarkEmbed.h"

#include "Core/Distortion.h"
#include "Core/IterativeEmbedding.h"
#include "Core/SecretKey.h"
#include "Private/FilterRun.h"
#include "Private/HarmonicsArrays.h"
#include "Private/PolyDataMesh.h"
#include "Private/SlotTable.h"

#include <vtkDoubleArray.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkTable.h>

namespace sw = spectralwatermark;

vtkStandardNewMacro(vtkSpectralWatermarkEmbed);

vtkSpectralWatermarkEmbed::vtkSpectralWatermarkEmbed() = default;
vtkSpectralWatermarkEmbed::~vtkSpectralWatermarkEmbed() = default;

void vtkSpectralWatermarkEmbed::SetMessage(const char* message)
{
  const std::string wanted = message != nullptr ? message : "";
  if (wanted != this->Message)
  {
    this->Message = wanted;
    this->Modified();
  }
}

int vtkSpectralWatermarkEmbed::RequestData(vtkInformation*, vtkInformationVector** inputs,
  vtkInformationVector* outputs)
{
  this->ResetResults();
  return sw::RunFilter(this, this->ErrorCode, outputs,
    [&]()
    {
      vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
      vtkPolyData* output = vtkPolyData::GetData(outputs, 0);
      const sw::PolyDataMesh mesh = sw::ToMesh(input);

      const std::unique_ptr<sw::SecretKey> key = this->ReadSecretKey();
      sw::EmbeddingOptions options;
      options.Message =
        this->Message.empty() && key ? key->Message(this->GetNumberOfBits()) : this->Message;
      const auto bits = static_cast<sw::Index>(options.Message.size());
      options.Slots = this->GetSlotOptions(key.get(), bits);
      options.RequiredBits = this->RequiredBits;
      options.MaximumIterations = this->MaximumNumberOfIterations;
      options.Threads = sw::ThreadsOfVtk();
      options.RoundToFloat = sw::StoresFloat(input, this->OutputPointsPrecision);

      const sw::Index needed = sw::ComponentsNeeded(options.Slots, bits);
      const sw::EmbeddingResult result = sw::EmbedMessage(mesh.Mesh, options,
        sw::FindHarmonics(input, sw::DefaultBasisName, mesh, sw::MassMatrix::Lumped, needed),
        sw::ProgressOf(this));

      output->ShallowCopy(input);
      sw::DropHarmonics(output);
      sw::SetPoints(output, input, mesh, result.Points, this->OutputPointsPrecision);
      output->GetPointData()->AddArray(sw::ToPointArray("GeometricDistortion", mesh,
        sw::GeometricDifference(mesh.Mesh.Points, result.Points) /
          sw::BoundingBoxDiagonal(mesh.Mesh.Points)));
      sw::FillEmbeddingTable(vtkTable::GetData(outputs, 1), result.History, options.Message);

      this->Converged = result.Converged ? 1 : 0;
      this->NumberOfIterationsUsed = static_cast<int>(result.Iterations);
      this->NumberOfEigensolves = static_cast<int>(result.Eigensolves);
      this->ExtractedMessage = result.ExtractedMessage;
      this->WarnUnlessConverged(options.Message);
    });
}

void vtkSpectralWatermarkEmbed::ResetResults()
{
  this->Converged = 0;
  this->NumberOfIterationsUsed = 0;
  this->NumberOfEigensolves = 0;
  this->ExtractedMessage.clear();
}

void vtkSpectralWatermarkEmbed::WarnUnlessConverged(const std::string& wanted)
{
  if (!this->Converged)
  {
    vtkWarningMacro("embedding did not converge in "
      << this->MaximumNumberOfIterations << " iterations: the output reads "
      << this->ExtractedMessage << ", wanted " << wanted
      << ". Try another TurbulenceFactor, SlotDivision or FirstComponent, or more iterations");
  }
}

void vtkSpectralWatermarkEmbed::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Message: " << this->Message << "\n";
  os << indent << "RequiredBits: " << this->RequiredBits << "\n";
  os << indent << "MaximumNumberOfIterations: " << this->MaximumNumberOfIterations << "\n";
  os << indent << "OutputPointsPrecision: " << this->OutputPointsPrecision << "\n";
  os << indent << "Converged: " << this->Converged << "\n";
  os << indent << "NumberOfIterationsUsed: " << this->NumberOfIterationsUsed << "\n";
  os << indent << "NumberOfEigensolves: " << this->NumberOfEigensolves << "\n";
  os << indent << "ExtractedMessage: " << this->ExtractedMessage << "\n";
}

// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSpectralWatermarkEmbed.h"

#include "Core/Distortion/PointDifferences.h"
#include "Core/Harmonics/LaplaceOperator.h"
#include "Core/Mesh/Measures.h"
#include "Core/Mesh/RoundTrip.h"
#include "Core/PaperScheme/SlotEmbedding.h"
#include "Core/PaperScheme/Slots.h"
#include "Core/Payload/SecretKey.h"
#include "Core/RobustScheme/Capacity.h"
#include "Core/RobustScheme/RobustEmbedding.h"
#include "Core/Support/Errors.h"
#include "Core/Support/Progress.h"
#include "Private/FilterExecution.h"
#include "Private/HarmonicsArrays.h"
#include "Private/PolyDataMesh.h"
#include "Private/Results.h"
#include "Private/Tables.h"

#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkTable.h>

#include <utility>

namespace sw = spectralwatermark;

vtkStandardNewMacro(vtkSpectralWatermarkEmbed);

vtkSpectralWatermarkEmbed::vtkSpectralWatermarkEmbed() = default;
vtkSpectralWatermarkEmbed::~vtkSpectralWatermarkEmbed() = default;

void vtkSpectralWatermarkEmbed::SetMessage(const char* message)
{
  const std::string wanted = message != nullptr ? message : "";
  if (wanted != this->GetMessage())
  {
    this->Message = wanted;
    this->Modified();
  }
  this->Message = wanted;
  this->MessageIsSet = true;
}

const char* vtkSpectralWatermarkEmbed::GetMessage() const
{
  const bool isPapers = !this->MessageIsSet && !this->IsRobust();
  return isPapers ? "10110" : this->Message.c_str();
}

namespace
{

// What a detector is given.
sw::RoundTrip RoundTripIn(vtkPolyData* input, const sw::PolyDataMesh& mesh, int precision)
{
  return [input, &mesh, precision](const sw::TriangleMesh::PointMatrix& points)
  {
    vtkNew<vtkPolyData> output;
    output->ShallowCopy(input);
    sw::SetPoints(output, input, mesh, points, precision);
    sw::PolyDataMesh read = sw::ToMesh(output);
    sw::RoundTripResult stored;
    stored.Mesh = std::move(read.Mesh);
    stored.Points = sw::PointsOf(output, mesh.PointOfVertex);
    stored.VertexOf.assign(mesh.PointOfVertex.size(), -1);
    for (std::size_t point = 0; point < mesh.VertexOfPoint.size(); ++point)
    {
      const sw::Index vertex = mesh.VertexOfPoint[point];
      if (vertex >= 0 && read.VertexOfPoint[point] >= 0)
      {
        stored.VertexOf[vertex] = read.VertexOfPoint[point];
      }
    }
    return stored;
  };
}

// What is the same whatever the scheme.
void SetMarkedPoints(vtkPolyData* output, vtkPolyData* input, const sw::PolyDataMesh& mesh,
  const sw::TriangleMesh::PointMatrix& points, int precision)
{
  output->ShallowCopy(input);
  sw::DropHarmonics(output);
  sw::SetPoints(output, input, mesh, points, precision);
  output->GetPointData()->AddArray(sw::ToPointArray("GeometricDistortion", mesh,
    sw::GeometricDifference(mesh.Mesh.Points, points) / sw::BoundingBoxDiagonal(mesh.Mesh.Points)));
}

} // namespace

int vtkSpectralWatermarkEmbed::RequestData(vtkInformation*, vtkInformationVector** inputs,
  vtkInformationVector* outputs)
{
  return this->Run(outputs,
    [&]()
    {
      this->CheckScheme();
      sw::CheckFinite("MaximumDistortion", this->MaximumDistortion);
      vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
      vtkPolyData* output = vtkPolyData::GetData(outputs, 0);
      vtkTable* table = vtkTable::GetData(outputs, 1);
      if (this->IsRobust())
      {
        this->EmbedRobust(input, output, table);
      }
      else
      {
        this->EmbedInSlots(input, output, table);
      }
      sw::AddResult(table, "ExtractedMessage", this->ExtractedMessage);
      sw::AddResults(table,
        { { "Converged", this->Converged }, { "Distortion", this->Distortion },
          { "Margin", this->Margin }, { "Capacity", this->Capacity } });
    });
}

std::string vtkSpectralWatermarkEmbed::WantedMessage(const sw::SecretKey* key) const
{
  const std::string message = this->GetMessage();
  return message.empty() && this->GetHasSecretKey() ? key->Message(this->GetNumberOfBits())
                                                    : message;
}

void vtkSpectralWatermarkEmbed::EmbedInSlots(vtkPolyData* input, vtkPolyData* output,
  vtkTable* table)
{
  const sw::PolyDataMesh mesh = sw::ToMesh(input);
  const std::unique_ptr<sw::SecretKey> key = this->ReadSecretKey();
  sw::SlotEmbeddingOptions options;
  options.Message = this->WantedMessage(key.get());
  const auto bits = static_cast<sw::Index>(options.Message.size());
  options.Slots = this->GetSlotOptions(key.get(), bits);
  options.RequiredBits = this->RequiredBits;
  options.MaximumIterations = this->MaximumNumberOfIterations;
  options.Threads = sw::ThreadsOfVtk();
  options.Store = RoundTripIn(input, mesh, this->OutputPointsPrecision);

  const sw::Index needed = sw::ComponentsNeeded(options.Slots, bits);
  const sw::SlotEmbeddingResult result = sw::EmbedMessageInSlots(mesh.Mesh, options,
    sw::FindHarmonics(input, sw::DefaultBasisName, mesh, sw::MassMatrix::Lumped, needed),
    sw::ProgressOf(this));

  SetMarkedPoints(output, input, mesh, result.Points, this->OutputPointsPrecision);
  sw::FillEmbeddingTable(table, result.History, options.Message);
  this->Converged = result.Converged ? 1 : 0;
  this->NumberOfIterationsUsed = static_cast<int>(result.Iterations);
  this->NumberOfEigensolves = static_cast<int>(result.Eigensolves);
  this->ExtractedMessage = result.ExtractedMessage;
  this->WarnUnlessConverged(options.Message);
}

void vtkSpectralWatermarkEmbed::EmbedRobust(vtkPolyData* input, vtkPolyData* output,
  vtkTable* table)
{
  const sw::PolyDataMesh mesh = sw::ToMesh(input);
  const std::unique_ptr<sw::SecretKey> key = this->ReadRobustKey();
  sw::RobustEmbeddingOptions options;
  options.Message = this->WantedMessage(key.get());
  if (options.Message.empty())
  {
    throw sw::InvalidInput("Message", "the message is empty",
      "set one, or set a secret key to derive one from");
  }
  options.MaximumDistortion = this->MaximumDistortion / 100.0;
  options.Threads = sw::ThreadsOfVtk();
  options.Store = RoundTripIn(input, mesh, this->OutputPointsPrecision);
  const sw::Progress progress = sw::ProgressOf(this);
  const sw::RobustEmbeddingResult result = sw::EmbedRobust(mesh.Mesh, *key, options,
    this->ReportCapacity ? progress.Part(0.0, 0.5) : progress);
  if (this->ReportCapacity)
  {
    this->Capacity = static_cast<int>(sw::CapacityOf(mesh.Mesh, *key, options.MaximumDistortion,
      options.Threads, progress.Part(0.5, 1.0)));
  }

  SetMarkedPoints(output, input, mesh, result.Points, this->OutputPointsPrecision);
  sw::FillRoundsTable(table, result.Rounds);
  this->Converged = result.Converged ? 1 : 0;
  this->NumberOfIterationsUsed = static_cast<int>(result.Rounds.size()) - 1;
  this->Distortion = 100.0 * result.Distortion;
  this->Margin = result.Margin;
  this->ExtractedMessage = result.ExtractedMessage;
  if (!this->Converged)
  {
    vtkWarningMacro("embedding did not succeed: the output reads "
      << this->ExtractedMessage << ", wanted " << options.Message << ", at a distortion of "
      << this->Distortion << " % of " << this->MaximumDistortion
      << " % at most. Raise MaximumDistortion, or embed fewer bits"
      << (sw::StoresFloat(input, this->OutputPointsPrecision)
             ? ", or store double points: these are rounded to float"
             : ""));
  }
}

void vtkSpectralWatermarkEmbed::ResetResults()
{
  this->Distortion = 0.0;
  this->Margin = 0.0;
  this->Capacity = 0;
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
  os << indent << "Message: " << this->GetMessage() << "\n";
  os << indent << "RequiredBits: " << this->RequiredBits << "\n";
  os << indent << "MaximumNumberOfIterations: " << this->MaximumNumberOfIterations << "\n";
  os << indent << "MaximumDistortion: " << this->MaximumDistortion << "\n";
  os << indent << "OutputPointsPrecision: " << this->OutputPointsPrecision << "\n";
  os << indent << "Distortion: " << this->Distortion << "\n";
  os << indent << "Margin: " << this->Margin << "\n";
  os << indent << "ReportCapacity: " << this->ReportCapacity << "\n";
  os << indent << "Capacity: " << this->Capacity << "\n";
  os << indent << "Converged: " << this->Converged << "\n";
  os << indent << "NumberOfIterationsUsed: " << this->NumberOfIterationsUsed << "\n";
  os << indent << "NumberOfEigensolves: " << this->NumberOfEigensolves << "\n";
  os << indent << "ExtractedMessage: " << this->ExtractedMessage << "\n";
}

// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSpectralWatermarkDetect.h"

#include "Core/Harmonics/ManifoldHarmonics.h"
#include "Core/Harmonics/Transform.h"
#include "Core/PaperScheme/SlotDetection.h"
#include "Core/PaperScheme/Slots.h"
#include "Core/Payload/BitAgreement.h"
#include "Core/Payload/Bits.h"
#include "Core/Payload/SecretKey.h"
#include "Core/RobustScheme/CarrierSet.h"
#include "Core/RobustScheme/RobustReader.h"
#include "Core/Support/Errors.h"
#include "Core/Support/MemoryBudget.h"
#include "Private/FilterExecution.h"
#include "Private/HarmonicsArrays.h"
#include "Private/PolyDataMesh.h"
#include "Private/Results.h"
#include "Private/Tables.h"

#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkTable.h>

#include <cmath>

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

const char* vtkSpectralWatermarkDetect::GetDetectorAsString() const
{
  return this->Detector == HardDecisions ? "HardDecisions" : "Likelihood";
}

int vtkSpectralWatermarkDetect::RequestData(vtkInformation*, vtkInformationVector** inputs,
  vtkInformationVector* outputs)
{
  return this->Run(outputs,
    [&]()
    {
      this->CheckScheme();
      sw::CheckFinite("FalsePositiveRate", this->FalsePositiveRate);
      vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
      vtkTable* table = vtkTable::GetData(outputs, 1);
      if (this->IsRobust())
      {
        this->ReadRobust(input, table);
      }
      else
      {
        this->ReadSlots(input, table);
      }
      vtkPolyData::GetData(outputs, 0)->ShallowCopy(input);
      sw::AddResult(table, "ExtractedMessage", this->ExtractedMessage);
      sw::AddResults(table,
        { { "MessageIsValid", this->MessageIsValid }, { "BitErrorRate", this->BitErrorRate },
          { "PValue", this->PValue }, { "Detected", this->Detected } });
    });
}

void vtkSpectralWatermarkDetect::ReadSlots(vtkPolyData* input, vtkTable* table)
{
  const sw::PolyDataMesh mesh = sw::ToMesh(input);
  const std::unique_ptr<sw::SecretKey> key = this->ReadSecretKey();
  const std::string wanted = this->WantedMessage(key.get());
  const sw::Index bits =
    wanted.empty() ? this->GetNumberOfBits() : static_cast<sw::Index>(wanted.size());
  const sw::SlotOptions slots = this->GetSlotOptions(key.get(), bits);
  sw::CheckCapacity(slots, bits, mesh.Mesh.NumberOfVertices());

  const sw::ManifoldHarmonics harmonics = sw::FindOrComputeHarmonics(input, mesh,
    sw::ComponentsNeeded(slots, bits), sw::ProgressOf(this), this->NumberOfEigensolves);
  sw::CheckSlotsAboveKernel(slots, harmonics.KernelDimension);
  const std::vector<sw::SlotReading> readings =
    sw::ReadSlots(sw::Magnitudes(sw::ForwardTransform(harmonics, mesh.Mesh.Points)), slots, bits);

  sw::FillDetectionTable(table, readings, slots);
  this->ExtractedMessage = sw::MessageOf(readings);
  if (!wanted.empty())
  {
    this->Compare(readings, slots, wanted);
  }
}

void vtkSpectralWatermarkDetect::ReadRobust(vtkPolyData* input, vtkTable* table)
{
  const sw::PolyDataMesh mesh = sw::ToMesh(input);
  // The peak memory of detection. Testing/Benchmark/memory measures it.
  constexpr double detectionBytesPerTriangle = 455.0;
  sw::RequireMemoryForTriangles(mesh.Mesh.NumberOfTriangles(), detectionBytesPerTriangle);
  const std::unique_ptr<sw::SecretKey> key = this->ReadRobustKey();
  const std::string wanted = this->WantedMessage(this->GetHasSecretKey() ? key.get() : nullptr);
  const sw::Index bits =
    wanted.empty() ? this->GetNumberOfBits() : static_cast<sw::Index>(wanted.size());
  const sw::RobustReading reading =
    sw::ReadRobust(mesh.Mesh, *key, bits, sw::ThreadsOfVtk(), sw::ProgressOf(this));

  sw::FillCarriersTable(table, reading);
  this->ExtractedMessage = reading.Message;
  this->MessageIsValid = reading.IsValid ? 1 : 0;
  this->UndoneSmoothing = reading.Hypothesis.Smoothing;
  if (!wanted.empty())
  {
    this->CountErrors(wanted);
    const std::string data = sw::DataOf(wanted, *key, sw::CheckBitsOf(bits));
    this->PValue = sw::PValueOf(reading, data);
    this->Judge(std::ldexp(1.0, -static_cast<int>(data.size())));
  }
}

void vtkSpectralWatermarkDetect::ResetResults()
{
  this->ExtractedMessage.clear();
  this->BitErrorRate = -1.0;
  this->Correlation = 0.0;
  this->PValue = 1.0;
  this->SmallestPValue = -1.0;
  this->LogLikelihoodRatio = 0.0;
  this->Detected = 0;
  this->NumberOfEigensolves = 0;
  this->MessageIsValid = 0;
  this->UndoneSmoothing = 0;
}

std::string vtkSpectralWatermarkDetect::WantedMessage(const sw::SecretKey* key)
{
  if (!this->UseDerivedMessage)
  {
    sw::CheckMessage(this->ExpectedMessage, "ExpectedMessage");
    return this->ExpectedMessage;
  }
  if (key == nullptr)
  {
    throw sw::InvalidInput("UseDerivedMessage", "there is no secret key to derive a message from",
      "set a secret key or a file with one");
  }
  if (!this->ExpectedMessage.empty())
  {
    throw sw::InvalidInput("UseDerivedMessage", "an expected message is set as well",
      "leave one of them unset: only one message can be looked for");
  }
  return key->Message(this->GetNumberOfBits());
}

void vtkSpectralWatermarkDetect::CountErrors(const std::string& wanted)
{
  const sw::Index agreements = sw::CountAgreements(this->ExtractedMessage, wanted);
  this->BitErrorRate = 1.0 - static_cast<double>(agreements) / static_cast<double>(wanted.size());
  this->Correlation = 1.0 - 2.0 * this->BitErrorRate;
}

void vtkSpectralWatermarkDetect::Compare(const std::vector<sw::SlotReading>& readings,
  const sw::SlotOptions& slots, const std::string& wanted)
{
  this->CountErrors(wanted);
  this->LogLikelihoodRatio = sw::LogLikelihoodRatio(readings, slots, wanted);
  const sw::UnmarkedModel unmarked = sw::UnmarkedModelOf(slots);
  this->PValue = this->Detector == Likelihood
    ? sw::WeightedAgreementPValue(readings, slots, wanted)
    : sw::AgreementPValue(this->ExtractedMessage, wanted, unmarked);
  this->Judge(sw::AgreementPValue(wanted, wanted, unmarked));
}

void vtkSpectralWatermarkDetect::Judge(double smallestPValue)
{
  this->SmallestPValue = smallestPValue;
  this->Detected = this->PValue <= this->FalsePositiveRate ? 1 : 0;
  if (smallestPValue > this->FalsePositiveRate)
  {
    vtkWarningMacro("FalsePositiveRate: this few bits cannot prove a mark at a rate of "
      << this->FalsePositiveRate
      << ", since even full agreement happens by chance with probability " << smallestPValue
      << "; embed more bits, or raise it");
  }
}

void vtkSpectralWatermarkDetect::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ExpectedMessage: " << this->ExpectedMessage << "\n";
  os << indent << "UseDerivedMessage: " << this->UseDerivedMessage << "\n";
  os << indent << "Detector: " << this->GetDetectorAsString() << "\n";
  os << indent << "FalsePositiveRate: " << this->FalsePositiveRate << "\n";
  os << indent << "ExtractedMessage: " << this->ExtractedMessage << "\n";
  os << indent << "MessageIsValid: " << this->MessageIsValid << "\n";
  os << indent << "BitErrorRate: " << this->BitErrorRate << "\n";
  os << indent << "Correlation: " << this->Correlation << "\n";
  os << indent << "PValue: " << this->PValue << "\n";
  os << indent << "SmallestPValue: " << this->SmallestPValue << "\n";
  os << indent << "LogLikelihoodRatio: " << this->LogLikelihoodRatio << "\n";
  os << indent << "Detected: " << this->Detected << "\n";
  os << indent << "UndoneSmoothing: " << this->UndoneSmoothing << "\n";
  os << indent << "NumberOfEigensolves: " << this->NumberOfEigensolves << "\n";
}

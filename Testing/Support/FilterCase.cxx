// SPDX-License-Identifier: BSD-3-Clause
#include "Support/FilterCase.h"

#include "Support/FilterTesting.h"
#include "Support/RandomMesh.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataObject.h>
#include <vtkErrorCode.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkManifoldHarmonics.h>
#include <vtkManifoldHarmonicsReconstruction.h>
#include <vtkManifoldHarmonicsSimilarity.h>
#include <vtkMeshAttack.h>
#include <vtkMeshDistortion.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSpectralWatermarkDetect.h>
#include <vtkSpectralWatermarkEmbed.h>
#include <vtkTable.h>
#include <vtkVariant.h>

#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>

namespace fuzzing
{

namespace
{

using filtertesting::Listener;

// Thrown by what is checked.
struct Violation : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

void Require(bool holds, const std::string& what)
{
  if (!holds)
  {
    throw Violation(what);
  }
}

// --- Properties ----------------------------------------------------------------------------------

// Mostly small, sometimes anything.
int Count(Bytes& bytes, int usual)
{
  return bytes.Below(32) == 0 ? bytes.Raw<int>() : bytes.Below(usual + 1);
}

double Real(Bytes& bytes, double usual)
{
  switch (bytes.Below(16))
  {
    case 0:
      return bytes.Raw<double>();
    case 1:
      return bytes.Flag() ? std::numeric_limits<double>::quiet_NaN() : 0.0;
    default:
      return usual * (2.0 * bytes.Share() - 0.5);
  }
}

vtkSmartPointer<vtkPolyDataAlgorithm> Harmonics(Bytes& bytes)
{
  auto filter = vtkSmartPointer<vtkManifoldHarmonics>::New();
  filter->SetNumberOfHarmonics(Count(bytes, 60));
  filter->SetMassMatrix(bytes.Below(2));
  filter->SetSolver(bytes.Below(5));
  filter->SetBandSize(Count(bytes, 40));
  filter->SetTolerance(Real(bytes, 1e-6));
  filter->SetArrayName(bytes.Flag() ? "ManifoldHarmonics" : "");
  return filter;
}

vtkSmartPointer<vtkPolyDataAlgorithm> Reconstruction(Bytes& bytes)
{
  auto filter = vtkSmartPointer<vtkManifoldHarmonicsReconstruction>::New();
  filter->SetNumberOfHarmonics(Count(bytes, 60));
  filter->SetKeepResidual(bytes.Flag());
  filter->SetGain(Count(bytes, 20), Real(bytes, 2.0));
  filter->SetOutputPointsPrecision(bytes.Below(3));
  return filter;
}

vtkSmartPointer<vtkPolyDataAlgorithm> Similarity(Bytes& bytes)
{
  auto filter = vtkSmartPointer<vtkManifoldHarmonicsSimilarity>::New();
  filter->SetNumberOfHarmonics(Count(bytes, 60));
  filter->SetClusterTolerance(Real(bytes, 0.1));
  return filter;
}

vtkSmartPointer<vtkPolyDataAlgorithm> Attack(Bytes& bytes)
{
  auto filter = vtkSmartPointer<vtkMeshAttack>::New();
  filter->SetAttack(bytes.Below(17) - 1);
  filter->SetSeed(bytes.Raw<int>());
  filter->SetRotationAngle(Real(bytes, 180.0));
  filter->SetRotationAxis(Real(bytes, 1.0), Real(bytes, 1.0), Real(bytes, 1.0));
  filter->SetScaleFactor(Real(bytes, 2.0));
  filter->SetTranslationVector(Real(bytes, 1.0), Real(bytes, 1.0), Real(bytes, 1.0));
  filter->SetNoiseFactor(Real(bytes, 1.0));
  filter->SetNumberOfHarmonics(Count(bytes, 60));
  filter->SetCutoffComponent(Count(bytes, 60));
  filter->SetSmoothingGain(Real(bytes, 1.0));
  filter->SetKeepResidual(bytes.Flag());
  filter->SetSimplificationPercent(Real(bytes, 60.0));
  filter->SetNoisePercent(Real(bytes, 1.0));
  filter->SetSmoothingFactor(Real(bytes, 1.0));
  filter->SetSmoothingIterations(bytes.Below(30));
  filter->SetQuantizationBits(Count(bytes, 30));
  filter->SetSubdivisionType(bytes.Below(4));
  filter->SetNumberOfSubdivisions(bytes.Below(2));
  filter->SetCroppingPercent(Real(bytes, 60.0));
  filter->SetRemeshingMethod(bytes.Below(3));
  filter->SetRemeshingPercent(100.0 * bytes.Share());
  filter->SetIsosurfaceResolution(bytes.Below(32));
  filter->SetAxisScaleFactors(Real(bytes, 2.0), Real(bytes, 2.0), Real(bytes, 2.0));
  filter->SetOutputPointsPrecision(bytes.Below(3));
  return filter;
}

vtkSmartPointer<vtkPolyDataAlgorithm> Distortion(Bytes& bytes)
{
  auto filter = vtkSmartPointer<vtkMeshDistortion>::New();
  filter->SetComputeSurfaceDistances(bytes.Below(4) == 0); // a hundred times slower than the rest
  filter->SetComputePerceptualDistances(bytes.Flag());
  return filter;
}

void SetWatermark(vtkSpectralWatermarkAlgorithm* filter, Bytes& bytes)
{
  filter->SetScheme(bytes.Below(8) == 0 ? bytes.Below(4) - 1 : bytes.Below(2));
  filter->SetSlotDivision(bytes.Below(2));
  filter->SetFirstComponent(Count(bytes, 12));
  filter->SetSlotSize(Count(bytes, 12));
  // Mostly inside the slot: else hardly anything is ever embedded.
  const int position = Count(bytes, 12);
  const bool usual = position > 1 && position <= 12;
  filter->SetCarrierPosition(usual ? 2 + position % (filter->GetSlotSize() - 2) : position);
  filter->SetBitEmbedding(bytes.Below(2));
  filter->SetTurbulenceFactor(Real(bytes, 1.0));
  // Long messages are read for minutes in an instrumented build, where nothing fits them.
  const int bits = Count(bytes, 24);
  filter->SetNumberOfBits(bits > 24 && bits <= 1024 ? 24 : bits);
  if (bytes.Flag())
  {
    filter->SetSecretKey("a secret of the fuzzer");
  }
}

vtkSmartPointer<vtkPolyDataAlgorithm> Detect(Bytes& bytes)
{
  auto filter = vtkSmartPointer<vtkSpectralWatermarkDetect>::New();
  SetWatermark(filter, bytes);
  if (bytes.Flag())
  {
    filter->SetExpectedMessage(bytes.Below(16) == 0 ? "maybe" : bytes.Bits(24).c_str());
  }
  filter->SetUseDerivedMessage(bytes.Flag());
  filter->SetDetector(bytes.Below(2));
  filter->SetFalsePositiveRate(Real(bytes, 0.1));
  return filter;
}

vtkSmartPointer<vtkPolyDataAlgorithm> Embed(Bytes& bytes)
{
  auto filter = vtkSmartPointer<vtkSpectralWatermarkEmbed>::New();
  SetWatermark(filter, bytes);
  if (bytes.Flag())
  {
    filter->SetMessage(bytes.Below(16) == 0 ? "01x" : bytes.Bits(12).c_str());
  }
  filter->SetRequiredBits(Count(bytes, 12));
  filter->SetMaximumNumberOfIterations(1 + bytes.Below(4));
  filter->SetMaximumDistortion(bytes.Flag() ? 0.07 : Real(bytes, 2.0));
  filter->SetReportCapacity(bytes.Below(16) == 0);
  filter->SetOutputPointsPrecision(bytes.Below(3));
  return filter;
}

vtkSmartPointer<vtkPolyDataAlgorithm> Filter(const std::string& name, Bytes& bytes)
{
  using Maker = vtkSmartPointer<vtkPolyDataAlgorithm> (*)(Bytes&);
  static const std::map<std::string, Maker> makers{ { FilterNames[0], Harmonics },
    { FilterNames[1], Reconstruction }, { FilterNames[2], Similarity }, { FilterNames[3], Attack },
    { FilterNames[4], Distortion }, { FilterNames[5], Detect }, { FilterNames[6], Embed } };
  return makers.at(name)(bytes);
}

// What takes long, in an instrumented build, is done on meshes of so few.
constexpr vtkIdType FewPoints = 100;

// What embeds again and again, or solves again and again for most of a spectrum, for half a minute.
void KeepShort(vtkPolyDataAlgorithm* filter, vtkPolyData* mesh)
{
  auto* embed = vtkSpectralWatermarkEmbed::SafeDownCast(filter);
  if (embed != nullptr && mesh->GetNumberOfPoints() > FewPoints)
  {
    embed->ReportCapacityOff();
    embed->SetMaximumNumberOfIterations(1);
  }
}

// --- What must hold ------------------------------------------------------------------------------

bool SameArray(vtkDataArray* a, vtkDataArray* b)
{
  if (a->GetNumberOfTuples() != b->GetNumberOfTuples() ||
    a->GetNumberOfComponents() != b->GetNumberOfComponents())
  {
    return false;
  }
  for (vtkIdType i = 0; i < a->GetNumberOfTuples(); ++i)
  {
    for (int c = 0; c < a->GetNumberOfComponents(); ++c)
    {
      const double x = a->GetComponent(i, c);
      const double y = b->GetComponent(i, c);
      if (!(x == y || (std::isnan(x) && std::isnan(y))))
      {
        return false;
      }
    }
  }
  return true;
}

bool SameCells(vtkPolyData* a, vtkPolyData* b)
{
  for (const auto get : { &vtkPolyData::GetVerts, &vtkPolyData::GetLines, &vtkPolyData::GetPolys,
         &vtkPolyData::GetStrips })
  {
    vtkCellArray* ofA = (a->*get)();
    vtkCellArray* ofB = (b->*get)();
    if (ofA->GetNumberOfCells() != ofB->GetNumberOfCells() ||
      !SameArray(ofA->GetConnectivityArray(), ofB->GetConnectivityArray()) ||
      !SameArray(ofA->GetOffsetsArray(), ofB->GetOffsetsArray()))
    {
      return false;
    }
  }
  return true;
}

// Every array of one is in the other, as it was.
void RequireArrays(vtkFieldData* before, vtkFieldData* now)
{
  for (int k = 0; k < before->GetNumberOfArrays(); ++k)
  {
    vtkDataArray* array = now->GetArray(before->GetArrayName(k));
    Require(array != nullptr && SameArray(array, before->GetArray(k)),
      std::string("lost or changed: ") + before->GetArrayName(k));
  }
}

void RequireUnchanged(vtkPolyData* before, vtkPolyData* now)
{
  Require(SameArray(before->GetPoints()->GetData(), now->GetPoints()->GetData()),
    "the input's points were changed");
  Require(SameCells(before, now), "the input's cells were changed");
  for (const int kind : { vtkDataObject::POINT, vtkDataObject::CELL, vtkDataObject::FIELD })
  {
    vtkFieldData* arrays = now->GetAttributesAsFieldData(kind);
    RequireArrays(before->GetAttributesAsFieldData(kind), arrays);
    Require(arrays->GetNumberOfArrays() ==
        before->GetAttributesAsFieldData(kind)->GetNumberOfArrays(),
      "the input was given an array");
  }
}

bool IsEmpty(vtkDataObject* output)
{
  if (auto* table = vtkTable::SafeDownCast(output))
  {
    return table->GetNumberOfColumns() == 0;
  }
  auto* mesh = vtkPolyData::SafeDownCast(output);
  return mesh != nullptr && mesh->GetNumberOfPoints() == 0 && mesh->GetNumberOfCells() == 0;
}

void RequireFinite(vtkFieldData* data, const std::string& where)
{
  for (int k = 0; k < data->GetNumberOfArrays(); ++k)
  {
    vtkDataArray* array = data->GetArray(k);
    if (array == nullptr)
    {
      continue; // text
    }
    const std::string name = array->GetName() == nullptr ? "?" : array->GetName();
    for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
    {
      for (int c = 0; c < array->GetNumberOfComponents(); ++c)
      {
        Require(std::isfinite(array->GetComponent(i, c)),
          where + ' ' + name + " holds what is not finite");
      }
    }
  }
}

// Points of the surface; others, also those of polygons of two corners, may be anything, and stay so.
void RequireFinitePoints(vtkPolyData* mesh)
{
  vtkNew<vtkIdList> corners;
  for (vtkCellArray* cells : { mesh->GetPolys(), mesh->GetStrips() })
  {
    for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell)
    {
      cells->GetCellAtId(cell, corners);
      for (const vtkIdType id : *corners)
      {
        Require(id >= 0 && id < mesh->GetNumberOfPoints(),
          "a polygon of a point that does not exist");
        double p[3];
        mesh->GetPoint(id, p);
        Require(corners->GetNumberOfIds() < 3 ||
            (std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2])),
          "a point is not finite");
      }
    }
  }
}

bool KeepsCells(vtkPolyDataAlgorithm* filter)
{
  auto* attack = vtkMeshAttack::SafeDownCast(filter);
  if (attack == nullptr)
  {
    return true;
  }
  switch (attack->GetAttack())
  {
    case vtkMeshAttack::Simplification:
    case vtkMeshAttack::Subdivision:
    case vtkMeshAttack::VertexReordering:
    case vtkMeshAttack::Cropping:
    case vtkMeshAttack::Remeshing:
      return false;
    default:
      return true;
  }
}

void RequireSameMesh(vtkPolyData* input, vtkPolyData* output)
{
  Require(output->GetNumberOfPoints() == input->GetNumberOfPoints(),
    "the number of points changed");
  Require(SameCells(input, output), "the cells changed");
  RequireArrays(input->GetPointData(), output->GetPointData());
  RequireArrays(input->GetCellData(), output->GetCellData());
}

// For what the filter embedded.
vtkSmartPointer<vtkSpectralWatermarkDetect> DetectorOf(vtkSpectralWatermarkEmbed* embed)
{
  auto detect = vtkSmartPointer<vtkSpectralWatermarkDetect>::New();
  detect->SetInputData(embed->GetOutput());
  detect->SetScheme(embed->GetScheme());
  detect->SetSlotDivision(embed->GetSlotDivision());
  detect->SetFirstComponent(embed->GetFirstComponent());
  detect->SetSlotSize(embed->GetSlotSize());
  detect->SetCarrierPosition(embed->GetCarrierPosition());
  detect->SetNumberOfBits(static_cast<int>(std::string(embed->GetExtractedMessage()).size()));
  if (embed->GetHasSecretKey() != 0)
  {
    detect->SetSecretKey("a secret of the fuzzer");
  }
  return detect;
}

// Whether the mesh alone decides its first harmonics: where eigenvalues repeat, rounding does.
bool HasClearHarmonics(vtkPolyData* mesh, int count)
{
  constexpr double clearGap = 1e-4;
  vtkNew<vtkManifoldHarmonics> harmonics;
  harmonics->SetInputData(mesh);
  harmonics->SetNumberOfHarmonics(count + 1); // the last one's gap is to the next
  Listener listener(harmonics);
  harmonics->Update();
  vtkDataArray* values = filtertesting::FieldArray(harmonics->GetOutput(), "Eigenvalues");
  for (vtkIdType k = 1; values != nullptr && k < values->GetNumberOfTuples(); ++k)
  {
    // The zeros of several components may repeat: no slot is there.
    if (values->GetTuple1(k) - values->GetTuple1(k - 1) < clearGap * values->GetTuple1(k))
    {
      return false;
    }
  }
  return values != nullptr;
}

// The paper's bits, but those that rounding decides: on which side of an average next to it a magnitude is.
void RequireSameSlots(vtkSpectralWatermarkEmbed* embed, vtkSpectralWatermarkDetect* detect)
{
  const std::string embedded = embed->GetExtractedMessage();
  const std::string read = detect->GetExtractedMessage();
  Require(read.size() == embedded.size(), "a detector reads another number of bits");
  if (!HasClearHarmonics(embed->GetOutput(),
        embed->GetFirstComponent() + detect->GetNumberOfBits() * embed->GetSlotSize() - 1))
  {
    return;
  }
  const double clear =
    1e-6 * std::pow(embed->GetOutput()->GetLength(), 2); // magnitudes are in length^2
  auto* table = vtkTable::SafeDownCast(detect->GetOutputDataObject(1));
  for (std::size_t slot = 0; slot < read.size(); ++slot)
  {
    const auto row = static_cast<vtkIdType>(slot);
    const double distance = table->GetValueByName(row, "Magnitude").ToDouble() -
      table->GetValueByName(row, "Average").ToDouble();
    Require(read[slot] == embedded[slot] || !(std::abs(distance) > clear),
      "a detector reads another bit in slot " + std::to_string(slot + 1));
  }
}

void RequireReadBack(vtkSpectralWatermarkEmbed* embed)
{
  const bool isRobust = embed->GetScheme() == vtkSpectralWatermarkEmbed::Robust;
  if (isRobust ? embed->GetConverged() == 0 : embed->GetOutput()->GetNumberOfPoints() > FewPoints)
  {
    return;
  }
  const auto detect = DetectorOf(embed);
  Listener listener(detect);
  detect->Update();
  Require(listener.Errors.empty(), "a marked mesh cannot be read: " + listener.Errors);
  if (!isRobust)
  {
    RequireSameSlots(embed, detect);
    return;
  }
  Require(std::string(detect->GetExtractedMessage()) == embed->GetExtractedMessage() &&
      detect->GetMessageIsValid() != 0,
    "a detector reads something else than embedding said");
  Require(embed->GetDistortion() <= embed->GetMaximumDistortion() * (1.0 + 1e-9),
    "embedding went beyond MaximumDistortion");
}

void RequireVerdict(vtkSpectralWatermarkDetect* detect)
{
  Require(detect->GetPValue() >= 0.0 && detect->GetPValue() <= 1.0,
    "the p-value is no probability");
  const double rate = detect->GetBitErrorRate();
  Require(rate == -1.0 || (rate >= 0.0 && rate <= 1.0), "the bit error rate is no rate");
  Require(std::isfinite(detect->GetCorrelation()) && std::isfinite(detect->GetLogLikelihoodRatio()),
    "a statistic is not finite");
  Require(detect->GetDetected() == 0 || detect->GetPValue() <= detect->GetFalsePositiveRate(),
    "detected at a p-value above the rate");
}

void RequireSpectrum(vtkPolyData* output)
{
  vtkDataArray* values = output->GetFieldData()->GetArray("Eigenvalues");
  Require(values != nullptr && values->GetNumberOfTuples() > 0, "no eigenvalues");
  for (vtkIdType i = 1; i < values->GetNumberOfTuples(); ++i)
  {
    Require(values->GetTuple1(i) >= values->GetTuple1(i - 1),
      "eigenvalues are not in order: " + std::to_string(values->GetTuple1(i - 1)) + ", " +
        std::to_string(values->GetTuple1(i)));
  }
}

void RequireSound(vtkPolyDataAlgorithm* filter, vtkPolyData* input)
{
  vtkPolyData* output = filter->GetOutput();
  if (KeepsCells(filter))
  {
    RequireSameMesh(input, output);
  }
  RequireFinitePoints(output);
  RequireFinite(output->GetPointData(), "the point array");
  RequireFinite(output->GetFieldData(), "the field array");
  for (int port = 1; port < filter->GetNumberOfOutputPorts(); ++port)
  {
    auto* table = vtkTable::SafeDownCast(filter->GetOutputDataObject(port));
    Require(table != nullptr, "no table");
    RequireFinite(table->GetRowData(), "the column");
  }
  if (filter->IsA("vtkManifoldHarmonics"))
  {
    RequireSpectrum(output);
  }
  if (auto* embed = vtkSpectralWatermarkEmbed::SafeDownCast(filter))
  {
    RequireReadBack(embed);
  }
  if (auto* detect = vtkSpectralWatermarkDetect::SafeDownCast(filter))
  {
    RequireVerdict(detect);
  }
}

void RequireRefusal(vtkPolyDataAlgorithm* filter, const std::string& errors)
{
  Require(!errors.empty(), "an error code without a text");
  for (int port = 0; port < filter->GetNumberOfOutputPorts(); ++port)
  {
    Require(IsEmpty(filter->GetOutputDataObject(port)), "an error, and an output");
  }
}

} // namespace

Outcome RunFilterCase(const std::string& name, Bytes& bytes)
{
  const auto filter = Filter(name, bytes);
  std::vector<vtkSmartPointer<vtkPolyData>> inputs{ RandomMesh(bytes) };
  if (filter->GetNumberOfInputPorts() > 1)
  {
    inputs.push_back(Sibling(inputs[0], bytes));
  }
  std::vector<vtkSmartPointer<vtkPolyData>> copies; // outputs share arrays with the inputs
  for (std::size_t port = 0; port < inputs.size(); ++port)
  {
    copies.push_back(vtkSmartPointer<vtkPolyData>::New());
    copies.back()->DeepCopy(inputs[port]);
    filter->SetInputData(static_cast<int>(port), inputs[port]);
  }
  KeepShort(filter, inputs[0]);
  Listener listener(filter);
  filter->Update();
  Outcome outcome;
  outcome.Error = listener.Errors;
  try
  {
    for (std::size_t port = 0; port < inputs.size(); ++port)
    {
      RequireUnchanged(copies[port], inputs[port]);
    }
    if (filter->GetErrorCode() != vtkErrorCode::NoError)
    {
      RequireRefusal(filter, listener.Errors);
    }
    else
    {
      Require(listener.Errors.empty(), "an error without its code: " + listener.Errors);
      // A distortion is shown on the second.
      RequireSound(filter, name == "MeshDistortion" ? copies[1] : copies[0]);
    }
  }
  catch (const Violation& violation)
  {
    std::ostringstream state;
    filter->Print(state);
    outcome.Wrong = "vtk" + name + ": " + violation.what() + '\n' + state.str();
  }
  return outcome;
}

} // namespace fuzzing

// SPDX-License-Identifier: BSD-3-Clause
#include "vtkManifoldHarmonics.h"

#include "Core/Harmonics/LaplaceOperator.h"
#include "Core/Harmonics/ManifoldHarmonics.h"
#include "Private/FilterExecution.h"
#include "Private/HarmonicsArrays.h"
#include "Private/PolyDataMesh.h"
#include "Private/Tables.h"

#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkTable.h>

namespace sw = spectralwatermark;

vtkStandardNewMacro(vtkManifoldHarmonics);

vtkManifoldHarmonics::vtkManifoldHarmonics()
{
  this->SetNumberOfOutputPorts(2);
}

vtkManifoldHarmonics::~vtkManifoldHarmonics() = default;

const char* vtkManifoldHarmonics::GetMassMatrixAsString() const
{
  return this->MassMatrix == Lumped ? "Lumped" : "Consistent";
}

const char* vtkManifoldHarmonics::GetSolverAsString() const
{
  constexpr const char* names[] = { "Automatic", "BlockLanczos", "Spectra", "Dense" };
  return names[this->Solver];
}

void vtkManifoldHarmonics::SetArrayName(const char* name)
{
  const std::string wanted = name != nullptr && *name != '\0' ? name : sw::DefaultBasisName;
  if (wanted != this->ArrayName)
  {
    this->ArrayName = wanted;
    this->Modified();
  }
}

void vtkManifoldHarmonics::ResetResults()
{
  this->SpectrumIsComplete = false;
}

int vtkManifoldHarmonics::RequestData(vtkInformation*, vtkInformationVector** inputs,
  vtkInformationVector* outputs)
{
  return this->Run(outputs,
    [&]()
    {
      vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
      vtkPolyData* output = vtkPolyData::GetData(outputs);
      sw::CheckFinite("Tolerance", this->Tolerance);
      const sw::PolyDataMesh mesh = sw::ToMesh(input);

      sw::HarmonicsOptions options;
      options.Count = this->NumberOfHarmonics;
      options.Mass = static_cast<sw::MassMatrix>(this->MassMatrix);
      options.BandSize = this->BandSize;
      options.Tolerance = this->Tolerance;
      options.Threads = sw::ThreadsOfVtk();
      options.Solver = static_cast<sw::SolverChoice>(this->Solver);
      const sw::ManifoldHarmonics harmonics =
        sw::ComputeManifoldHarmonics(mesh.Mesh, options, sw::ProgressOf(this));

      this->SpectrumIsComplete = harmonics.Complete;
      output->ShallowCopy(input);
      sw::AttachHarmonics(output, this->GetArrayName(), mesh, harmonics);
      sw::FillSpectrumTable(vtkTable::GetData(outputs, 1), harmonics, mesh);
    });
}

void vtkManifoldHarmonics::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfHarmonics: " << this->NumberOfHarmonics << "\n";
  os << indent << "MassMatrix: " << this->GetMassMatrixAsString() << "\n";
  os << indent << "BandSize: " << this->BandSize << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "Solver: " << this->GetSolverAsString() << "\n";
  os << indent << "SpectrumIsComplete: " << (this->SpectrumIsComplete ? "true" : "false") << "\n";
  os << indent << "ArrayName: " << this->ArrayName << "\n";
}

// SPDX-License-Identifier: BSD-3-Clause
#include "vtkManifoldHarmonicsReconstruction.h"

#include "Core/Harmonics/ManifoldHarmonics.h"
#include "Core/Harmonics/Transform.h"
#include "Core/Support/Errors.h"
#include "Private/FilterExecution.h"
#include "Private/HarmonicsArrays.h"
#include "Private/PolyDataMesh.h"

#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

#include <cmath>

namespace sw = spectralwatermark;

vtkStandardNewMacro(vtkManifoldHarmonicsReconstruction);

vtkManifoldHarmonicsReconstruction::vtkManifoldHarmonicsReconstruction() = default;
vtkManifoldHarmonicsReconstruction::~vtkManifoldHarmonicsReconstruction() = default;

namespace
{

Eigen::VectorXd GainVector(const std::map<int, double>& gains, sw::Index count)
{
  Eigen::VectorXd vector = Eigen::VectorXd::Ones(count);
  for (const auto& [component, gain] : gains)
  {
    if (component < 1 || component > count || !std::isfinite(gain))
    {
      throw sw::InvalidInput("Gain",
        "the gain " + std::to_string(gain) + " of component " + std::to_string(component) +
          " cannot be applied",
        "choose components from 1 to " + std::to_string(count) + " and finite gains");
    }
    vector[component - 1] = gain;
  }
  return vector;
}

} // namespace

void vtkManifoldHarmonicsReconstruction::SetGain(int component, double gain)
{
  if (this->GetGain(component) != gain)
  {
    this->Gains[component] = gain;
    this->Modified();
  }
}

double vtkManifoldHarmonicsReconstruction::GetGain(int component) const
{
  const auto entry = this->Gains.find(component);
  return entry == this->Gains.end() ? 1.0 : entry->second;
}

void vtkManifoldHarmonicsReconstruction::RemoveAllGains()
{
  if (!this->Gains.empty())
  {
    this->Gains.clear();
    this->Modified();
  }
}

void vtkManifoldHarmonicsReconstruction::SetArrayName(const char* name)
{
  const std::string wanted = name != nullptr && *name != '\0' ? name : sw::DefaultBasisName;
  if (wanted != this->ArrayName)
  {
    this->ArrayName = wanted;
    this->Modified();
  }
}

void vtkManifoldHarmonicsReconstruction::ResetResults()
{
  this->NumberOfEigensolves = 0;
}

int vtkManifoldHarmonicsReconstruction::RequestData(vtkInformation*, vtkInformationVector** inputs,
  vtkInformationVector* outputs)
{
  return this->Run(outputs,
    [&]()
    {
      vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
      vtkPolyData* output = vtkPolyData::GetData(outputs);
      const sw::PolyDataMesh mesh = sw::ToMesh(input);
      const sw::ManifoldHarmonics harmonics =
        sw::FindAnyOrComputeHarmonics(input, this->GetArrayName(), mesh, this->NumberOfHarmonics,
          sw::ProgressOf(this), this->NumberOfEigensolves);

      const sw::TriangleMesh::PointMatrix points = sw::FilterPoints(harmonics, mesh.Mesh.Points,
        GainVector(this->Gains, harmonics.Count()), this->KeepResidual);

      output->ShallowCopy(input);
      sw::DropHarmonics(output, this->GetArrayName());
      sw::SetPoints(output, input, mesh, points, this->OutputPointsPrecision);
    });
}

void vtkManifoldHarmonicsReconstruction::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfHarmonics: " << this->NumberOfHarmonics << "\n";
  os << indent << "Gains:";
  for (const auto& [component, gain] : this->Gains)
  {
    os << " " << component << ": " << gain;
  }
  os << "\n";
  os << indent << "KeepResidual: " << this->KeepResidual << "\n";
  os << indent << "ArrayName: " << this->ArrayName << "\n";
  os << indent << "OutputPointsPrecision: " << this->OutputPointsPrecision << "\n";
  os << indent << "NumberOfEigensolves: " << this->NumberOfEigensolves << "\n";
}

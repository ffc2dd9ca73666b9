// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMeshAttack.h"

#include "Core/Errors.h"
#include "Core/ManifoldHarmonics.h"
#include "Core/Noise.h"
#include "Private/FilterRun.h"
#include "Private/HarmonicsArrays.h"
#include "Private/PolyDataMesh.h"

#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkQuadricDecimation.h>
#include <vtkTransform.h>
#include <vtkTransformPolyDataFilter.h>

#include <cmath>
#include <string>

namespace sw = spectralwatermark;

vtkStandardNewMacro(vtkMeshAttack);

vtkMeshAttack::vtkMeshAttack() = default;
vtkMeshAttack::~vtkMeshAttack() = default;

namespace
{

void CheckFinite(const char* name, double value)
{
  if (!std::isfinite(value))
  {
    throw sw::InvalidInput(std::string(name) + " must be finite");
  }
}

} // namespace

const char* vtkMeshAttack::GetAttackAsString() const
{
  switch (this->Attack)
  {
    case Rotation:
      return "Rotation";
    case UniformScaling:
      return "UniformScaling";
    case Translation:
      return "Translation";
    case NoiseAlongNormals:
      return "NoiseAlongNormals";
    case SpectralSmoothing:
      return "SpectralSmoothing";
    case Simplification:
      return "Simplification";
    default:
      return "Unknown";
  }
}

int vtkMeshAttack::RequestData(vtkInformation*, vtkInformationVector** inputs,
  vtkInformationVector* outputs)
{
  this->NumberOfEigensolves = 0;
  return sw::RunFilter(this, this->ErrorCode, outputs,
    [&]()
    {
      vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
      vtkPolyData* output = vtkPolyData::GetData(outputs);
      switch (this->Attack)
      {
        case Rotation:
        case UniformScaling:
        case Translation:
          this->Transform(input, output);
          break;
        case NoiseAlongNormals:
          this->AddNoise(input, output);
          break;
        case SpectralSmoothing:
          this->Smooth(input, output);
          break;
        case Simplification:
          this->Simplify(input, output);
          break;
        default:
          throw sw::InvalidInput("attack " + std::to_string(this->Attack) +
            " is unknown: see vtkMeshAttack::AttackType");
      }
      sw::DropHarmonics(output);
    });
}

void vtkMeshAttack::Transform(vtkPolyData* input, vtkPolyData* output)
{
  sw::ToMesh(input); // for its checks
  vtkNew<vtkTransform> transform;
  if (this->Attack == Rotation)
  {
    const double* axis = this->RotationAxis;
    const double length = std::hypot(axis[0], axis[1], axis[2]);
    CheckFinite("RotationAxis", length);
    CheckFinite("RotationAngle", this->RotationAngle);
    if (length == 0.0)
    {
      throw sw::InvalidInput("RotationAxis has length 0: give it a direction");
    }
    transform->RotateWXYZ(this->RotationAngle, axis);
  }
  else if (this->Attack == UniformScaling)
  {
    CheckFinite("ScaleFactor", this->ScaleFactor);
    transform->Scale(this->ScaleFactor, this->ScaleFactor, this->ScaleFactor);
  }
  else
  {
    for (const double component : this->TranslationVector)
    {
      CheckFinite("TranslationVector", component);
    }
    transform->Translate(this->TranslationVector);
  }
  vtkNew<vtkTransformPolyDataFilter> move;
  move->SetInputData(input);
  move->SetTransform(transform);
  move->SetOutputPointsPrecision(this->OutputPointsPrecision);
  sw::UpdateInside(move, this, 0.1, 1.0);
  output->ShallowCopy(move->GetOutput());
}

void vtkMeshAttack::AddNoise(vtkPolyData* input, vtkPolyData* output)
{
  CheckFinite("NoiseFactor", this->NoiseFactor);
  const sw::PolyDataMesh mesh = sw::ToMesh(input);
  const sw::Progress progress = sw::ProgressOf(this);
  progress.Report(0.3);
  const sw::TriangleMesh::PointMatrix points =
    sw::NoiseAlongNormals(mesh.Mesh, this->NoiseFactor, static_cast<std::uint64_t>(this->Seed));
  progress.Report(0.9);
  output->ShallowCopy(input);
  sw::SetPoints(output, input, mesh, points, this->OutputPointsPrecision);
}

void vtkMeshAttack::Smooth(vtkPolyData* input, vtkPolyData* output)
{
  CheckFinite("SmoothingGain", this->SmoothingGain);
  const sw::PolyDataMesh mesh = sw::ToMesh(input);
  const sw::ManifoldHarmonics harmonics = sw::FindOrComputeHarmonics(input, mesh,
    this->NumberOfHarmonics, sw::ProgressOf(this), this->NumberOfEigensolves);
  Eigen::VectorXd gains = Eigen::VectorXd::Ones(harmonics.Count());
  gains.tail(std::max<sw::Index>(0, harmonics.Count() - this->CutoffComponent))
    .setConstant(this->SmoothingGain);
  output->ShallowCopy(input);
  sw::SetPoints(output, input, mesh,
    sw::FilterPoints(harmonics, mesh.Mesh.Points, gains, this->KeepResidual),
    this->OutputPointsPrecision);
}

void vtkMeshAttack::Simplify(vtkPolyData* input, vtkPolyData* output)
{
  // The merged mesh, so that seams do not tear.
  const sw::PolyDataMesh mesh = sw::ToMesh(input);
  const bool storesFloat = sw::StoresFloat(input, this->OutputPointsPrecision);
  vtkNew<vtkQuadricDecimation> decimate;
  decimate->SetInputData(sw::ToPolyData(mesh.Mesh, false));
  decimate->SetTargetReduction(this->SimplificationPercent / 100.0);
  sw::UpdateInside(decimate, this, 0.1, 1.0);
  if (decimate->GetOutput()->GetNumberOfPolys() == 0)
  {
    throw sw::InvalidInput("no triangle is left: lower SimplificationPercent");
  }
  output->ShallowCopy(sw::ToPolyData(sw::ToMesh(decimate->GetOutput()).Mesh, storesFloat));
}

void vtkMeshAttack::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Attack: " << this->GetAttackAsString() << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
  os << indent << "RotationAxis: " << this->RotationAxis[0] << " " << this->RotationAxis[1] << " "
     << this->RotationAxis[2] << "\n";
  os << indent << "RotationAngle: " << this->RotationAngle << "\n";
  os << indent << "ScaleFactor: " << this->ScaleFactor << "\n";
  os << indent << "TranslationVector: " << this->TranslationVector[0] << " "
     << this->TranslationVector[1] << " " << this->TranslationVector[2] << "\n";
  os << indent << "NoiseFactor: " << this->NoiseFactor << "\n";
  os << indent << "NumberOfHarmonics: " << this->NumberOfHarmonics << "\n";
  os << indent << "CutoffComponent: " << this->CutoffComponent << "\n";
  os << indent << "SmoothingGain: " << this->SmoothingGain << "\n";
  os << indent << "KeepResidual: " << this->KeepResidual << "\n";
  os << indent << "SimplificationPercent: " << this->SimplificationPercent << "\n";
  os << indent << "OutputPointsPrecision: " << this->OutputPointsPrecision << "\n";
  os << indent << "NumberOfEigensolves: " << this->NumberOfEigensolves << "\n";
}

// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMeshAttack.h"

#include "Core/Attacks/Attacks.h"
#include "Core/Attacks/Sqrt3Subdivision.h"
#include "Core/Harmonics/ManifoldHarmonics.h"
#include "Core/Harmonics/Transform.h"
#include "Core/Support/Errors.h"
#include "Core/Support/MemoryBudget.h"
#include "Core/Support/Progress.h"
#include "Core/Support/Random.h"
#include "Private/FilterExecution.h"
#include "Private/HarmonicsArrays.h"
#include "Private/PolyDataMesh.h"
#include "Private/Reordering.h"
#include "Private/Resampling.h"

#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkQuadricDecimation.h>
#include <vtkTransform.h>
#include <vtkTransformPolyDataFilter.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace sw = spectralwatermark;

vtkStandardNewMacro(vtkMeshAttack);

vtkMeshAttack::vtkMeshAttack() = default;
vtkMeshAttack::~vtkMeshAttack() = default;

namespace
{

void CheckScaleFactors(const double* factors)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    sw::CheckFinite("AxisScaleFactors", factors[axis]);
    if (factors[axis] == 0.0)
    {
      throw sw::InvalidInput("AxisScaleFactors has a 0, which flattens the mesh: give each axis "
                             "another factor");
    }
  }
}

using HomogeneousMatrix = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>; // as VTK stores it

HomogeneousMatrix MatrixOf(const sw::SimilarityTransform& similarity)
{
  HomogeneousMatrix matrix = HomogeneousMatrix::Identity();
  matrix.topLeftCorner<3, 3>() = similarity.Scale * similarity.Rotation;
  matrix.topRightCorner<3, 1>() = similarity.Translation;
  return matrix;
}

std::vector<vtkIdType> Shuffled(vtkIdType count, int seed, int stream)
{
  const std::vector<sw::Index> order = sw::RandomOrder(count,
    2 * static_cast<std::uint64_t>(seed) + static_cast<std::uint64_t>(stream));
  return { order.begin(), order.end() };
}

template <std::size_t Count>
const char* NameOf(const std::array<const char*, Count>& names, int value)
{
  const auto k = static_cast<std::size_t>(value);
  return value >= 0 && k < Count ? names[k] : "Unknown";
}

void Rotate(vtkTransform* transform, vtkMeshAttack* attack)
{
  const double* axis = attack->GetRotationAxis();
  const double length = std::hypot(axis[0], axis[1], axis[2]);
  sw::CheckFinite("RotationAxis", length);
  sw::CheckFinite("RotationAngle", attack->GetRotationAngle());
  if (length == 0.0)
  {
    throw sw::InvalidInput("RotationAxis has length 0: give it a direction");
  }
  transform->RotateWXYZ(attack->GetRotationAngle(), axis);
}

void RequireMemoryToSubdivide(sw::Index triangles, vtkMeshAttack* attack)
{
  constexpr double bytesOfTriangle = 165.0; // at the peak: 128 to 161 were measured
  const double parts = attack->GetSubdivisionType() == vtkMeshAttack::Sqrt3 ? 3.0 : 4.0;
  const double count =
    static_cast<double>(triangles) * std::pow(parts, attack->GetNumberOfSubdivisions());
  sw::RequireMemoryForTriangles(static_cast<sw::Index>(count), bytesOfTriangle,
    "lower NumberOfSubdivisions, or simplify the mesh first");
}

sw::TriangleMesh Subdivided(const sw::TriangleMesh& mesh, vtkMeshAttack* attack)
{
  RequireMemoryToSubdivide(mesh.NumberOfTriangles(), attack);
  switch (attack->GetSubdivisionType())
  {
    case vtkMeshAttack::Midpoint:
      return sw::Subdivide(mesh, sw::Subdivision::Midpoint, attack->GetNumberOfSubdivisions(),
        attack);
    case vtkMeshAttack::Loop:
      return sw::Subdivide(mesh, sw::Subdivision::Loop, attack->GetNumberOfSubdivisions(), attack);
    case vtkMeshAttack::Sqrt3:
      return sw::SubdivideSqrt3(mesh, attack->GetNumberOfSubdivisions(), sw::ProgressOf(attack));
    default:
      throw sw::InvalidInput("subdivision type " + std::to_string(attack->GetSubdivisionType()) +
        " is unknown: see vtkMeshAttack::SubdivisionTypes");
  }
}

sw::TriangleMesh Remeshed(const sw::TriangleMesh& mesh, vtkMeshAttack* attack)
{
  switch (attack->GetRemeshingMethod())
  {
    case vtkMeshAttack::Uniform:
    {
      sw::CheckFinite("RemeshingPercent", attack->GetRemeshingPercent());
      const double vertices = static_cast<double>(mesh.NumberOfVertices());
      const auto count = static_cast<sw::Index>(vertices * attack->GetRemeshingPercent() / 100.0);
      return sw::ResampleUniformly(mesh, std::max<sw::Index>(4, count), attack);
    }
    case vtkMeshAttack::Isosurface:
      return sw::ResampleByIsosurface(mesh, attack->GetIsosurfaceResolution(), attack);
    default:
      throw sw::InvalidInput("remeshing method " + std::to_string(attack->GetRemeshingMethod()) +
        " is unknown: see vtkMeshAttack::RemeshingMethods");
  }
}

} // namespace

const char* vtkMeshAttack::GetAttackAsString() const
{
  constexpr std::array names = { "Rotation", "UniformScaling", "Translation", "Similarity",
    "NoiseAlongNormals", "NoiseUniform", "SpectralSmoothing", "LaplacianSmoothing", "Quantization",
    "Simplification", "Subdivision", "VertexReordering", "Cropping", "Remeshing",
    "NonUniformScaling" };
  return NameOf(names, this->Attack);
}

const char* vtkMeshAttack::GetSubdivisionTypeAsString() const
{
  return NameOf(std::array{ "Midpoint", "Loop", "Sqrt3" }, this->SubdivisionType);
}

const char* vtkMeshAttack::GetRemeshingMethodAsString() const
{
  return NameOf(std::array{ "Uniform", "Isosurface" }, this->RemeshingMethod);
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
        case Similarity:
        case NonUniformScaling:
          this->Transform(input, output);
          break;
        case NoiseAlongNormals:
        case NoiseUniform:
        case LaplacianSmoothing:
        case Quantization:
          this->MovePoints(input, output);
          break;
        case SpectralSmoothing:
          this->Smooth(input, output);
          break;
        case Simplification:
          this->Simplify(input, output);
          break;
        case Subdivision:
        case Remeshing:
          this->Resample(input, output);
          break;
        case VertexReordering:
          this->Shuffle(input, output);
          break;
        case Cropping:
          this->Crop(input, output);
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
  const sw::PolyDataMesh mesh = sw::ToMesh(input);
  vtkNew<vtkTransform> transform;
  switch (this->Attack)
  {
    case Rotation:
      Rotate(transform, this);
      break;
    case UniformScaling:
      sw::CheckFinite("ScaleFactor", this->ScaleFactor);
      transform->Scale(this->ScaleFactor, this->ScaleFactor, this->ScaleFactor);
      break;
    case NonUniformScaling:
      CheckScaleFactors(this->AxisScaleFactors);
      transform->Scale(this->AxisScaleFactors);
      break;
    case Translation:
      std::for_each_n(this->TranslationVector, 3,
        [](double component) { sw::CheckFinite("TranslationVector", component); });
      transform->Translate(this->TranslationVector);
      break;
    default:
      transform->SetMatrix(
        MatrixOf(sw::RandomSimilarity(mesh.Mesh, static_cast<std::uint64_t>(this->Seed))).data());
  }
  vtkNew<vtkTransformPolyDataFilter> move;
  move->SetInputData(input);
  move->SetTransform(transform);
  move->SetOutputPointsPrecision(this->OutputPointsPrecision);
  sw::RunInternalFilter(move, this, 0.1, 1.0);
  sw::CheckStorable(sw::PointsOf(move->GetOutput(), mesh.PointOfVertex),
    sw::StoresFloat(input, this->OutputPointsPrecision));
  output->ShallowCopy(move->GetOutput());
}

void vtkMeshAttack::MovePoints(vtkPolyData* input, vtkPolyData* output)
{
  sw::CheckFinite("NoiseFactor", this->NoiseFactor);
  sw::CheckFinite("NoisePercent", this->NoisePercent);
  sw::CheckFinite("SmoothingFactor", this->SmoothingFactor);
  const sw::PolyDataMesh mesh = sw::ToMesh(input);
  constexpr double bytesOfTriangle = 225.0; // at the peak, as measured of smoothing
  sw::RequireMemoryForTriangles(mesh.Mesh.NumberOfTriangles(), bytesOfTriangle);
  const sw::Progress progress = sw::ProgressOf(this);
  const auto seed = static_cast<std::uint64_t>(this->Seed);
  progress.Report(0.3);
  sw::TriangleMesh::PointMatrix points;
  switch (this->Attack)
  {
    case NoiseAlongNormals:
      points = sw::NoiseAlongNormals(mesh.Mesh, this->NoiseFactor, seed);
      break;
    case NoiseUniform:
      points = sw::NoiseUniform(mesh.Mesh, this->NoisePercent / 100.0, seed);
      break;
    case LaplacianSmoothing:
      points = sw::LaplacianSmoothing(mesh.Mesh, this->SmoothingFactor, this->SmoothingIterations,
        progress.Part(0.3, 0.9));
      break;
    default:
      points = sw::Quantize(mesh.Mesh, this->QuantizationBits);
  }
  progress.Report(0.9);
  output->ShallowCopy(input);
  sw::SetPoints(output, input, mesh, points, this->OutputPointsPrecision);
}

void vtkMeshAttack::Smooth(vtkPolyData* input, vtkPolyData* output)
{
  sw::CheckFinite("SmoothingGain", this->SmoothingGain);
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
  sw::CheckFinite("SimplificationPercent", this->SimplificationPercent);
  // The merged mesh, so that seams do not tear.
  const sw::PolyDataMesh mesh = sw::ToMesh(input);
  constexpr double bytesOfTriangle = 565.0; // at the peak, as measured
  sw::RequireMemoryForTriangles(mesh.Mesh.NumberOfTriangles(), bytesOfTriangle);
  const bool storesFloat = sw::StoresFloat(input, this->OutputPointsPrecision);
  vtkNew<vtkQuadricDecimation> decimate;
  decimate->SetInputData(sw::ToPolyData(mesh.Mesh, false));
  decimate->SetTargetReduction(this->SimplificationPercent / 100.0);
  sw::RunInternalFilter(decimate, this, 0.1, 1.0);
  if (decimate->GetOutput()->GetNumberOfPolys() == 0)
  {
    throw sw::InvalidInput("no triangle is left: lower SimplificationPercent");
  }
  output->ShallowCopy(sw::ToPolyData(sw::ToMesh(decimate->GetOutput()).Mesh, storesFloat));
}

// On the merged mesh, so that seams do not tear.
void vtkMeshAttack::Resample(vtkPolyData* input, vtkPolyData* output)
{
  const sw::PolyDataMesh mesh = sw::ToMesh(input);
  const bool storesFloat = sw::StoresFloat(input, this->OutputPointsPrecision);
  const sw::TriangleMesh result =
    this->Attack == Subdivision ? Subdivided(mesh.Mesh, this) : Remeshed(mesh.Mesh, this);
  output->ShallowCopy(sw::ToPolyData(result, storesFloat));
}

void vtkMeshAttack::Shuffle(vtkPolyData* input, vtkPolyData* output)
{
  sw::ToMesh(input); // for its checks
  sw::ProgressOf(this).Report(0.3);
  output->ShallowCopy(sw::ExtractPoints(input, Shuffled(input->GetNumberOfPoints(), this->Seed, 0),
    Shuffled(input->GetNumberOfPolys(), this->Seed, 1)));
}

void vtkMeshAttack::Crop(vtkPolyData* input, vtkPolyData* output)
{
  sw::CheckFinite("CroppingPercent", this->CroppingPercent);
  sw::ToMesh(input); // for its checks
  sw::ProgressOf(this).Report(0.3);
  const auto seed = static_cast<std::uint64_t>(this->Seed);
  const Eigen::Vector3d direction(sw::NormalRandom(seed, 0), sw::NormalRandom(seed, 1),
    sw::NormalRandom(seed, 2));
  const vtkIdType count = input->GetNumberOfPoints();
  std::vector<std::pair<double, vtkIdType>> heights;
  for (vtkIdType i = 0; i < count; ++i)
  {
    Eigen::Vector3d point;
    input->GetPoint(i, point.data());
    // Points of no polygon may be anything; nothing is sorted by what is not a number.
    const double height = direction.dot(point);
    heights.emplace_back(std::isnan(height) ? 0.0 : height, i);
  }
  std::sort(heights.begin(), heights.end());
  const auto kept = static_cast<std::size_t>(
    std::ceil(static_cast<double>(count) * (1.0 - this->CroppingPercent / 100.0)));
  std::vector<vtkIdType> points;
  for (std::size_t k = 0; k < kept; ++k)
  {
    points.push_back(heights[k].second);
  }
  std::sort(points.begin(), points.end());
  const auto cropped =
    sw::ExtractPoints(input, points, sw::IdentityOrder(input->GetNumberOfPolys()));
  if (cropped->GetNumberOfPolys() + cropped->GetNumberOfStrips() == 0)
  {
    throw sw::InvalidInput("no polygon is left: lower CroppingPercent");
  }
  output->ShallowCopy(cropped);
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
  os << indent << "NoisePercent: " << this->NoisePercent << "\n";
  os << indent << "SmoothingFactor: " << this->SmoothingFactor << "\n";
  os << indent << "SmoothingIterations: " << this->SmoothingIterations << "\n";
  os << indent << "QuantizationBits: " << this->QuantizationBits << "\n";
  os << indent << "SubdivisionType: " << this->GetSubdivisionTypeAsString() << "\n";
  os << indent << "NumberOfSubdivisions: " << this->NumberOfSubdivisions << "\n";
  os << indent << "CroppingPercent: " << this->CroppingPercent << "\n";
  os << indent << "RemeshingMethod: " << this->GetRemeshingMethodAsString() << "\n";
  os << indent << "RemeshingPercent: " << this->RemeshingPercent << "\n";
  os << indent << "IsosurfaceResolution: " << this->IsosurfaceResolution << "\n";
  os << indent << "AxisScaleFactors: " << this->AxisScaleFactors[0] << " "
     << this->AxisScaleFactors[1] << " " << this->AxisScaleFactors[2] << "\n";
  os << indent << "OutputPointsPrecision: " << this->OutputPointsPrecision << "\n";
  os << indent << "NumberOfEigensolves: " << this->NumberOfEigensolves << "\n";
}

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
#include <iterator>
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
      throw sw::InvalidInput("AxisScaleFactors", "a factor of 0 flattens the mesh",
        "give each axis another factor");
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

void RequireMemoryToSubdivide(sw::Index triangles, vtkMeshAttack* attack)
{
  // The peak memory per triangle of the result. Testing/Benchmark/memory measures it.
  constexpr double subdivisionBytesPerTriangle = 165.0;
  const double parts = attack->GetSubdivisionType() == vtkMeshAttack::Sqrt3 ? 3.0 : 4.0;
  const double count =
    static_cast<double>(triangles) * std::pow(parts, attack->GetNumberOfSubdivisions());
  sw::RequireMemoryForTriangles(static_cast<sw::Index>(count), subdivisionBytesPerTriangle,
    "lower it, or simplify the mesh first", "NumberOfSubdivisions");
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
      throw sw::InvalidInput("SubdivisionType",
        std::to_string(attack->GetSubdivisionType()) + " is unknown",
        "see vtkMeshAttack::SubdivisionTypes");
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
      throw sw::InvalidInput("RemeshingMethod",
        std::to_string(attack->GetRemeshingMethod()) + " is unknown",
        "see vtkMeshAttack::RemeshingMethods");
  }
}

} // namespace

const vtkMeshAttack::Entry* vtkMeshAttack::Find(int attack)
{
  static constexpr Entry entries[] = {
    { Rotation, "Rotation", &vtkMeshAttack::Rotate },
    { UniformScaling, "UniformScaling", &vtkMeshAttack::ScaleUniformly },
    { Translation, "Translation", &vtkMeshAttack::Translate },
    { Similarity, "Similarity", &vtkMeshAttack::TransformAtRandom },
    { NoiseAlongNormals, "NoiseAlongNormals", &vtkMeshAttack::AddNoiseAlongNormals },
    { NoiseUniform, "NoiseUniform", &vtkMeshAttack::AddUniformNoise },
    { SpectralSmoothing, "SpectralSmoothing", &vtkMeshAttack::SmoothSpectrally },
    { LaplacianSmoothing, "LaplacianSmoothing", &vtkMeshAttack::SmoothByUmbrella },
    { Quantization, "Quantization", &vtkMeshAttack::Quantize },
    { Simplification, "Simplification", &vtkMeshAttack::Simplify },
    { Subdivision, "Subdivision", &vtkMeshAttack::Subdivide },
    { VertexReordering, "VertexReordering", &vtkMeshAttack::Shuffle },
    { Cropping, "Cropping", &vtkMeshAttack::Crop },
    { Remeshing, "Remeshing", &vtkMeshAttack::Remesh },
    { NonUniformScaling, "NonUniformScaling", &vtkMeshAttack::ScaleAxes },
  };
  const auto* found = std::find_if(std::begin(entries), std::end(entries),
    [attack](const Entry& entry) { return entry.Type == attack; });
  return found != std::end(entries) ? found : nullptr;
}

const char* vtkMeshAttack::GetAttackAsString() const
{
  const Entry* entry = Find(this->Attack);
  return entry != nullptr ? entry->Name : "Unknown";
}

const char* vtkMeshAttack::GetSubdivisionTypeAsString() const
{
  return NameOf(std::array{ "Midpoint", "Loop", "Sqrt3" }, this->SubdivisionType);
}

const char* vtkMeshAttack::GetRemeshingMethodAsString() const
{
  return NameOf(std::array{ "Uniform", "Isosurface" }, this->RemeshingMethod);
}

void vtkMeshAttack::ResetResults()
{
  this->NumberOfEigensolves = 0;
}

int vtkMeshAttack::RequestData(vtkInformation*, vtkInformationVector** inputs,
  vtkInformationVector* outputs)
{
  return this->Run(outputs,
    [&]()
    {
      const Entry* entry = Find(this->Attack);
      if (entry == nullptr)
      {
        throw sw::InvalidInput("Attack", std::to_string(this->Attack) + " is unknown",
          "see vtkMeshAttack::AttackType");
      }
      vtkPolyData* output = vtkPolyData::GetData(outputs);
      (this->*entry->Apply)(vtkPolyData::GetData(inputs[0]), output);
      sw::DropHarmonics(output);
    });
}

namespace
{

// Applies the transform that configure(transform, mesh) sets.
template <typename Configure>
void ApplyTransform(vtkMeshAttack* attack, vtkPolyData* input, vtkPolyData* output,
  const Configure& configure)
{
  const sw::PolyDataMesh mesh = sw::ToMesh(input);
  vtkNew<vtkTransform> transform;
  configure(transform.GetPointer(), mesh.Mesh);
  vtkNew<vtkTransformPolyDataFilter> move;
  move->SetInputData(input);
  move->SetTransform(transform);
  move->SetOutputPointsPrecision(attack->GetOutputPointsPrecision());
  sw::RunInternalFilter(move, attack, 0.1, 1.0);
  sw::CheckStorable(sw::PointsOf(move->GetOutput(), mesh.PointOfVertex),
    sw::StoresFloat(input, attack->GetOutputPointsPrecision()));
  output->ShallowCopy(move->GetOutput());
}

// Moves the points to those that move(mesh, progress) returns.
template <typename Move>
void MovePoints(vtkMeshAttack* attack, vtkPolyData* input, vtkPolyData* output, const Move& move)
{
  const sw::PolyDataMesh mesh = sw::ToMesh(input);
  // The peak memory of smoothing, which needs the most. Testing/Benchmark/memory measures it.
  constexpr double smoothingBytesPerTriangle = 225.0;
  sw::RequireMemoryForTriangles(mesh.Mesh.NumberOfTriangles(), smoothingBytesPerTriangle);
  const sw::Progress progress = sw::ProgressOf(attack);
  progress.Report(0.3);
  const sw::TriangleMesh::PointMatrix points = move(mesh.Mesh, progress.Part(0.3, 0.9));
  progress.Report(0.9);
  output->ShallowCopy(input);
  sw::SetPoints(output, input, mesh, points, attack->GetOutputPointsPrecision());
}

// Replaces the mesh by the one that resample(mesh) returns. The merged mesh is resampled, so that
// seams do not tear.
template <typename Resample>
void ReplaceMesh(vtkMeshAttack* attack, vtkPolyData* input, vtkPolyData* output,
  const Resample& resample)
{
  const sw::PolyDataMesh mesh = sw::ToMesh(input);
  const bool storesFloat = sw::StoresFloat(input, attack->GetOutputPointsPrecision());
  output->ShallowCopy(sw::ToPolyData(resample(mesh.Mesh), storesFloat));
}

} // namespace

void vtkMeshAttack::Rotate(vtkPolyData* input, vtkPolyData* output)
{
  ApplyTransform(this, input, output,
    [this](vtkTransform* transform, const sw::TriangleMesh&)
    {
      const double* axis = this->RotationAxis;
      const double length = std::hypot(axis[0], axis[1], axis[2]);
      sw::CheckFinite("RotationAxis", length);
      sw::CheckFinite("RotationAngle", this->RotationAngle);
      if (length == 0.0)
      {
        throw sw::InvalidInput("RotationAxis", "the axis has length 0", "give it a direction");
      }
      transform->RotateWXYZ(this->RotationAngle, axis);
    });
}

void vtkMeshAttack::ScaleUniformly(vtkPolyData* input, vtkPolyData* output)
{
  ApplyTransform(this, input, output,
    [this](vtkTransform* transform, const sw::TriangleMesh&)
    {
      sw::CheckFinite("ScaleFactor", this->ScaleFactor);
      transform->Scale(this->ScaleFactor, this->ScaleFactor, this->ScaleFactor);
    });
}

void vtkMeshAttack::Translate(vtkPolyData* input, vtkPolyData* output)
{
  ApplyTransform(this, input, output,
    [this](vtkTransform* transform, const sw::TriangleMesh&)
    {
      std::for_each_n(this->TranslationVector, 3,
        [](double component) { sw::CheckFinite("TranslationVector", component); });
      transform->Translate(this->TranslationVector);
    });
}

void vtkMeshAttack::TransformAtRandom(vtkPolyData* input, vtkPolyData* output)
{
  ApplyTransform(this, input, output,
    [this](vtkTransform* transform, const sw::TriangleMesh& mesh)
    {
      const auto seed = static_cast<std::uint64_t>(this->Seed);
      transform->SetMatrix(MatrixOf(sw::RandomSimilarity(mesh, seed)).data());
    });
}

void vtkMeshAttack::ScaleAxes(vtkPolyData* input, vtkPolyData* output)
{
  ApplyTransform(this, input, output,
    [this](vtkTransform* transform, const sw::TriangleMesh&)
    {
      CheckScaleFactors(this->AxisScaleFactors);
      transform->Scale(this->AxisScaleFactors);
    });
}

void vtkMeshAttack::AddNoiseAlongNormals(vtkPolyData* input, vtkPolyData* output)
{
  sw::CheckFinite("NoiseFactor", this->NoiseFactor);
  MovePoints(this, input, output,
    [this](const sw::TriangleMesh& mesh, const sw::Progress&) {
      return sw::NoiseAlongNormals(mesh, this->NoiseFactor, static_cast<std::uint64_t>(this->Seed));
    });
}

void vtkMeshAttack::AddUniformNoise(vtkPolyData* input, vtkPolyData* output)
{
  sw::CheckFinite("NoisePercent", this->NoisePercent);
  MovePoints(this, input, output,
    [this](const sw::TriangleMesh& mesh, const sw::Progress&)
    {
      return sw::NoiseUniform(mesh, this->NoisePercent / 100.0,
        static_cast<std::uint64_t>(this->Seed));
    });
}

void vtkMeshAttack::SmoothByUmbrella(vtkPolyData* input, vtkPolyData* output)
{
  sw::CheckFinite("SmoothingFactor", this->SmoothingFactor);
  MovePoints(this, input, output,
    [this](const sw::TriangleMesh& mesh, const sw::Progress& progress)
    {
      return sw::LaplacianSmoothing(mesh, this->SmoothingFactor, this->SmoothingIterations,
        progress);
    });
}

void vtkMeshAttack::Quantize(vtkPolyData* input, vtkPolyData* output)
{
  MovePoints(this, input, output,
    [this](const sw::TriangleMesh& mesh, const sw::Progress&)
    { return sw::Quantize(mesh, this->QuantizationBits); });
}

void vtkMeshAttack::Subdivide(vtkPolyData* input, vtkPolyData* output)
{
  ReplaceMesh(this, input, output,
    [this](const sw::TriangleMesh& mesh) { return Subdivided(mesh, this); });
}

void vtkMeshAttack::Remesh(vtkPolyData* input, vtkPolyData* output)
{
  ReplaceMesh(this, input, output,
    [this](const sw::TriangleMesh& mesh) { return Remeshed(mesh, this); });
}

void vtkMeshAttack::SmoothSpectrally(vtkPolyData* input, vtkPolyData* output)
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
  // The peak memory of simplification. Testing/Benchmark/memory measures it.
  constexpr double simplificationBytesPerTriangle = 565.0;
  sw::RequireMemoryForTriangles(mesh.Mesh.NumberOfTriangles(), simplificationBytesPerTriangle);
  const bool storesFloat = sw::StoresFloat(input, this->OutputPointsPrecision);
  vtkNew<vtkQuadricDecimation> decimate;
  decimate->SetInputData(sw::ToPolyData(mesh.Mesh, false));
  decimate->SetTargetReduction(this->SimplificationPercent / 100.0);
  sw::RunInternalFilter(decimate, this, 0.1, 1.0);
  if (decimate->GetOutput()->GetNumberOfPolys() == 0)
  {
    throw sw::InvalidInput("SimplificationPercent", "no triangle is left", "lower it");
  }
  output->ShallowCopy(sw::ToPolyData(sw::ToMesh(decimate->GetOutput()).Mesh, storesFloat));
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
    throw sw::InvalidInput("CroppingPercent", "no polygon is left", "lower it");
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

// SPDX-License-Identifier: BSD-3-Clause
#include "Private/HarmonicsArrays.h"

#include "Core/Harmonics/Transform.h"
#include "Private/FilterExecution.h"

#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <string>

namespace spectralwatermark
{

const char* const DefaultBasisName = "ManifoldHarmonics";

namespace
{

constexpr const char* VertexMassName = "VertexMass";
constexpr const char* EigenvaluesName = "Eigenvalues";
constexpr const char* ResidualsName = "Residuals";
constexpr const char* SpectrumName = "Spectrum";
constexpr const char* SpectrumMagnitudeName = "SpectrumMagnitude";

vtkSmartPointer<vtkDoubleArray> ToArray(const char* name, const Eigen::MatrixXd& values)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(static_cast<int>(values.cols()));
  array->SetNumberOfTuples(values.rows());
  for (Index row = 0; row < values.rows(); ++row)
  {
    for (Index column = 0; column < values.cols(); ++column)
    {
      array->SetComponent(row, static_cast<int>(column), values(row, column));
    }
  }
  return array;
}

void AddFieldArray(vtkPolyData* output, const char* name, const Eigen::MatrixXd& values)
{
  output->GetFieldData()->AddArray(ToArray(name, values));
}

// The rows of a point array that belong to the vertices.
Eigen::MatrixXd VertexRows(vtkDataArray* array, const PolyDataMesh& mesh, Index columns)
{
  Eigen::MatrixXd values(mesh.PointOfVertex.size(), columns);
  for (Index vertex = 0; vertex < values.rows(); ++vertex)
  {
    const vtkIdType point = mesh.PointOfVertex[vertex];
    for (Index column = 0; column < columns; ++column)
    {
      values(vertex, column) = array->GetComponent(point, static_cast<int>(column));
    }
  }
  return values;
}

} // namespace

void AttachHarmonics(vtkPolyData* output, const char* basisName, const PolyDataMesh& mesh,
  const ManifoldHarmonics& harmonics)
{
  const Spectrum spectrum = ForwardTransform(harmonics, mesh.Mesh.Points);
  output->GetPointData()->AddArray(ToPointArray(basisName, mesh, harmonics.Basis));
  output->GetPointData()->AddArray(ToPointArray(VertexMassName, mesh, harmonics.VertexMass));
  AddFieldArray(output, EigenvaluesName, harmonics.Eigenvalues);
  AddFieldArray(output, SpectrumName, spectrum);
  AddFieldArray(output, SpectrumMagnitudeName, Magnitudes(spectrum));
  AddFieldArray(output, ResidualsName, harmonics.Residuals);
}

std::optional<ManifoldHarmonics> FindHarmonics(vtkPolyData* input, const char* basisName,
  const PolyDataMesh& mesh, MassMatrix mass, Index count)
{
  vtkDataArray* basis = input->GetPointData()->GetArray(basisName);
  vtkDataArray* vertexMass = input->GetPointData()->GetArray(VertexMassName);
  vtkDataArray* eigenvalues = input->GetFieldData()->GetArray(EigenvaluesName);
  if (basis == nullptr || vertexMass == nullptr || eigenvalues == nullptr ||
    vertexMass->GetNumberOfComponents() != 1 || eigenvalues->GetNumberOfComponents() != 1 ||
    eigenvalues->GetNumberOfTuples() != basis->GetNumberOfComponents())
  {
    return std::nullopt;
  }
  const Index available = basis->GetNumberOfComponents();
  if (count > available)
  {
    return std::nullopt;
  }
  const Index wanted = count > 0 ? count : available;
  RequireMemoryToAdopt(mesh.Mesh.NumberOfVertices(), wanted);
  Eigen::VectorXd values(wanted);
  for (Index k = 0; k < wanted; ++k)
  {
    values[k] = eigenvalues->GetComponent(k, 0);
  }
  return AdoptManifoldHarmonics(mesh.Mesh, mass, values, VertexRows(basis, mesh, wanted),
    VertexRows(vertexMass, mesh, 1));
}

ManifoldHarmonics FindOrComputeHarmonics(vtkPolyData* input, const PolyDataMesh& mesh, Index count,
  const Progress& progress, int& eigensolves)
{
  std::optional<ManifoldHarmonics> found =
    FindHarmonics(input, DefaultBasisName, mesh, MassMatrix::Lumped, count);
  if (found)
  {
    return *std::move(found);
  }
  ++eigensolves;
  HarmonicsOptions options;
  options.Count = count;
  options.Threads = ThreadsOfVtk();
  return ComputeManifoldHarmonics(mesh.Mesh, options, progress);
}

ManifoldHarmonics FindAnyOrComputeHarmonics(vtkPolyData* input, const char* basisName,
  const PolyDataMesh& mesh, Index count, const Progress& progress, int& eigensolves)
{
  for (const MassMatrix mass : { MassMatrix::Lumped, MassMatrix::Consistent })
  {
    std::optional<ManifoldHarmonics> found = FindHarmonics(input, basisName, mesh, mass, count);
    if (found)
    {
      return *std::move(found);
    }
  }
  if (count == 0)
  {
    throw InvalidInput("NumberOfHarmonics",
      std::string("the input carries no basis \"") + basisName + "\" that fits its geometry",
      "put vtkManifoldHarmonics before this filter, or ask for one or more to be computed");
  }
  return FindOrComputeHarmonics(input, mesh, count, progress, eigensolves);
}

void DropHarmonics(vtkPolyData* output, const char* basisName)
{
  for (const char* name : { basisName, VertexMassName })
  {
    output->GetPointData()->RemoveArray(name);
  }
  for (const char* name : { EigenvaluesName, ResidualsName, SpectrumName, SpectrumMagnitudeName })
  {
    output->GetFieldData()->RemoveArray(name);
  }
}

} // namespace spectralwatermark

// SPDX-License-Identifier: BSD-3-Clause
#include "vtkManifoldHarmonicsSimilarity.h"

#include "Core/Harmonics/BasisSimilarity.h"
#include "Core/Harmonics/ManifoldHarmonics.h"
#include "Core/Support/Progress.h"
#include "Private/ClosestPoints.h"
#include "Private/FilterExecution.h"
#include "Private/HarmonicsArrays.h"
#include "Private/PolyDataMesh.h"
#include "Private/Tables.h"

#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkTable.h>

namespace sw = spectralwatermark;

vtkStandardNewMacro(vtkManifoldHarmonicsSimilarity);

vtkManifoldHarmonicsSimilarity::vtkManifoldHarmonicsSimilarity()
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(2);
}

vtkManifoldHarmonicsSimilarity::~vtkManifoldHarmonicsSimilarity() = default;

namespace
{

vtkSmartPointer<vtkDoubleArray> ColumnOf(const char* name, const Eigen::VectorXd& values)
{
  return sw::Column<vtkDoubleArray>(name, values.size(), [&](sw::Index k) { return values[k]; });
}

void FillTable(vtkTable* table, const Eigen::VectorXd& eigenvalues,
  const Eigen::VectorXd& otherEigenvalues, const Eigen::VectorXd& similarity)
{
  const sw::Index count = similarity.size();
  table->AddColumn(sw::Column<vtkIntArray>("Component", count,
    [](sw::Index k) { return static_cast<int>(k + 1); }));
  table->AddColumn(ColumnOf("Eigenvalue", eigenvalues.head(count)));
  table->AddColumn(ColumnOf("OtherEigenvalue", otherEigenvalues.head(count)));
  table->AddColumn(ColumnOf("Similarity", similarity));
}

} // namespace

void vtkManifoldHarmonicsSimilarity::ResetResults()
{
  this->MeanSimilarity = -1.0;
  this->NumberOfEigensolves = 0;
}

int vtkManifoldHarmonicsSimilarity::RequestData(vtkInformation*, vtkInformationVector** inputs,
  vtkInformationVector* outputs)
{
  return this->Run(outputs,
    [&]()
    {
      vtkPolyData* referenceInput = vtkPolyData::GetData(inputs[0]);
      vtkPolyData* otherInput = vtkPolyData::GetData(inputs[1]);
      sw::CheckFinite("ClusterTolerance", this->ClusterTolerance);
      const sw::PolyDataMesh reference = sw::ToMesh(referenceInput);
      const sw::PolyDataMesh other = sw::ToMesh(otherInput);
      const sw::Progress progress = sw::ProgressOf(this);
      const sw::ManifoldHarmonics basis =
        sw::FindAnyOrComputeHarmonics(referenceInput, sw::DefaultBasisName, reference,
          this->NumberOfHarmonics, progress.Part(0.0, 0.45), this->NumberOfEigensolves);
      const sw::ManifoldHarmonics otherBasis =
        sw::FindAnyOrComputeHarmonics(otherInput, sw::DefaultBasisName, other,
          this->NumberOfHarmonics, progress.Part(0.45, 0.9), this->NumberOfEigensolves);
      progress.Report(0.9);

      const Eigen::VectorXd similarity = sw::BasisSimilarity(basis,
        sw::TransferToVertices(other.Mesh, otherBasis.Basis, reference.Mesh),
        this->ClusterTolerance);
      progress.Report(1.0);

      vtkPolyData* output = vtkPolyData::GetData(outputs, 0);
      output->ShallowCopy(referenceInput);
      output->GetFieldData()->AddArray(ColumnOf("Similarity", similarity));
      FillTable(vtkTable::GetData(outputs, 1), basis.Eigenvalues, otherBasis.Eigenvalues,
        similarity);
      this->MeanSimilarity = similarity.mean();
    });
}

void vtkManifoldHarmonicsSimilarity::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfHarmonics: " << this->NumberOfHarmonics << "\n";
  os << indent << "ClusterTolerance: " << this->ClusterTolerance << "\n";
  os << indent << "MeanSimilarity: " << this->MeanSimilarity << "\n";
  os << indent << "NumberOfEigensolves: " << this->NumberOfEigensolves << "\n";
}

// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMeshDistortion.h"

#include "Core/Distortion/BallNeighbourhood.h"
#include "Core/Distortion/PointDifferences.h"
#include "Core/Distortion/StructuralDistortion.h"
#include "Core/Mesh/EdgeTopology.h"
#include "Core/Mesh/Measures.h"
#include "Core/Support/MemoryBudget.h"
#include "Core/Support/Progress.h"
#include "Private/FilterExecution.h"
#include "Private/PolyDataMesh.h"
#include "Private/Results.h"
#include "Private/SurfaceComparison.h"

#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkDoubleArray.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <utility>

namespace sw = spectralwatermark;

vtkStandardNewMacro(vtkMeshDistortion);

vtkMeshDistortion::vtkMeshDistortion()
{
  this->SetNumberOfInputPorts(2);
}

vtkMeshDistortion::~vtkMeshDistortion() = default;

namespace
{

constexpr double NotMeasured = -1.0;

bool SameCells(vtkCellArray* a, vtkCellArray* b)
{
  if (a->GetNumberOfCells() != b->GetNumberOfCells() ||
    a->GetNumberOfConnectivityIds() != b->GetNumberOfConnectivityIds())
  {
    return false;
  }
  const auto left = vtk::TakeSmartPointer(a->NewIterator());
  const auto right = vtk::TakeSmartPointer(b->NewIterator());
  right->GoToFirstCell();
  for (left->GoToFirstCell(); !left->IsDoneWithTraversal(); left->GoToNextCell())
  {
    vtkIdType sizes[2];
    const vtkIdType* points[2];
    left->GetCurrentCell(sizes[0], points[0]);
    right->GetCurrentCell(sizes[1], points[1]);
    if (!std::equal(points[0], points[0] + sizes[0], points[1], points[1] + sizes[1]))
    {
      return false;
    }
    right->GoToNextCell();
  }
  return true;
}

// Whether each point has its counterpart.
bool Correspond(vtkPolyData* a, vtkPolyData* b)
{
  return a->GetNumberOfPoints() == b->GetNumberOfPoints() &&
    SameCells(a->GetPolys(), b->GetPolys()) && SameCells(a->GetStrips(), b->GetStrips());
}

} // namespace

struct vtkMeshDistortion::Surfaces
{
  Surfaces(sw::PolyDataMesh reference, sw::PolyDataMesh distorted)
    : Before(std::move(reference))
    , After(std::move(distorted))
    , OnBefore(this->Before.Mesh)
    , OnAfter(this->After.Mesh)
  {
  }

  static Surfaces Of(vtkPolyData* reference, vtkPolyData* distorted)
  {
    sw::PolyDataMesh before = sw::ToMesh(reference);
    sw::PolyDataMesh after = sw::ToMesh(distorted);
    // The peak memory of the comparison. Testing/Benchmark/memory measures it.
    constexpr double comparisonBytesPerTriangle = 320.0;
    sw::RequireMemoryForTriangles(before.Mesh.NumberOfTriangles() + after.Mesh.NumberOfTriangles(),
      comparisonBytesPerTriangle);
    return Surfaces(std::move(before), std::move(after));
  }

  // Of a distorted mesh whose points correspond.
  double Msdm(vtkPolyData* distorted) const
  {
    sw::TriangleMesh moved = this->Before.Mesh;
    moved.Points = sw::CheckedPoints(distorted, this->Before.PointOfVertex);
    return sw::CubicMean(sw::LocalMsdm(sw::BallNeighbourhood(this->Before.Mesh),
      sw::BallNeighbourhood(moved), sw::LongestSide(this->Before.Mesh.Points), sw::ThreadsOfVtk()));
  }

  sw::PolyDataMesh Before;
  sw::PolyDataMesh After;
  sw::ClosestPoints OnBefore;
  sw::ClosestPoints OnAfter;
};

int vtkMeshDistortion::RequestData(vtkInformation*, vtkInformationVector** inputs,
  vtkInformationVector* outputs)
{
  return this->Run(outputs,
    [&]()
    {
      vtkPolyData* reference = vtkPolyData::GetData(inputs[0]);
      vtkPolyData* distorted = vtkPolyData::GetData(inputs[1]);
      vtkPolyData* output = vtkPolyData::GetData(outputs);
      output->ShallowCopy(distorted);
      const bool correspond = Correspond(reference, distorted);
      if (correspond)
      {
        this->ComparePoints(reference, distorted, output);
      }
      else
      {
        sw::ToMesh(reference); // for its checks
        sw::ToMesh(distorted);
      }
      sw::ProgressOf(this).Report(0.1);
      if (this->ComputeSurfaceDistances || this->ComputePerceptualDistances)
      {
        const Surfaces surfaces = Surfaces::Of(reference, distorted);
        if (this->ComputeSurfaceDistances)
        {
          this->CompareSurfaces(surfaces, output);
        }
        if (this->ComputePerceptualDistances)
        {
          this->CompareAppearance(surfaces, output);
          if (correspond)
          {
            this->MSDM = surfaces.Msdm(distorted);
          }
        }
      }
      sw::AddResults(output,
        { { "GeomDiff", this->GeomDiff }, { "CurvDiff", this->CurvDiff }, { "MRMS", this->MRMS },
          { "Hausdorff", this->Hausdorff }, { "MSDM", this->MSDM }, { "MSDM2", this->MSDM2 } });
    });
}

void vtkMeshDistortion::ResetResults()
{
  for (double* figure :
    { &this->GeomDiff, &this->CurvDiff, &this->MRMS, &this->Hausdorff, &this->MSDM, &this->MSDM2 })
  {
    *figure = NotMeasured;
  }
}

void vtkMeshDistortion::ComparePoints(vtkPolyData* reference, vtkPolyData* distorted,
  vtkPolyData* output)
{
  const sw::PolyDataMesh mesh = sw::ToMesh(reference, sw::CoincidentPoints::Keep);
  const sw::TriangleMesh::PointMatrix moved = sw::CheckedPoints(distorted, mesh.PointOfVertex);
  const double diagonal = sw::BoundingBoxDiagonal(mesh.Mesh.Points);
  const Eigen::VectorXd geometric = sw::GeometricDifference(mesh.Mesh.Points, moved) / diagonal;
  const Eigen::VectorXd curvature =
    sw::CurvatureDifference(sw::UniqueEdges(mesh.Mesh), mesh.Mesh.Points, moved) / diagonal;
  output->GetPointData()->AddArray(sw::ToPointArray("GeometricDifference", mesh, geometric));
  output->GetPointData()->AddArray(sw::ToPointArray("CurvatureDifference", mesh, curvature));
  this->GeomDiff = geometric.mean();
  this->CurvDiff = curvature.mean();
}

void vtkMeshDistortion::CompareSurfaces(const Surfaces& surfaces, vtkPolyData* output)
{
  const sw::Progress progress = sw::ProgressOf(this);
  const int threads = sw::ThreadsOfVtk();
  const sw::SurfaceDistance there =
    sw::DistanceTo(surfaces.OnAfter, surfaces.Before.Mesh, threads, progress.Part(0.1, 0.25));
  const sw::SurfaceDistance back =
    sw::DistanceTo(surfaces.OnBefore, surfaces.After.Mesh, threads, progress.Part(0.25, 0.4));
  const double diagonal = sw::BoundingBoxDiagonal(surfaces.Before.Mesh.Points);
  output->GetPointData()->AddArray(
    sw::ToPointArray("SurfaceDistance", surfaces.After, back.AtVertices / diagonal));
  this->MRMS = std::max(there.RootMeanSquare, back.RootMeanSquare) / diagonal;
  this->Hausdorff = std::max(there.Largest, back.Largest) / diagonal;
}

void vtkMeshDistortion::CompareAppearance(const Surfaces& surfaces, vtkPolyData* output)
{
  const sw::PerceptualDistance distance = sw::Msdm2(surfaces.OnBefore, surfaces.OnAfter,
    sw::ThreadsOfVtk(), sw::ProgressOf(this).Part(0.4, 0.9));
  output->GetPointData()->AddArray(
    sw::ToPointArray("LocalMSDM2", surfaces.After, distance.AtVertices));
  this->MSDM2 = distance.Symmetric;
}

void vtkMeshDistortion::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "GeomDiff: " << this->GeomDiff << "\n";
  os << indent << "CurvDiff: " << this->CurvDiff << "\n";
  os << indent << "MRMS: " << this->MRMS << "\n";
  os << indent << "Hausdorff: " << this->Hausdorff << "\n";
  os << indent << "MSDM: " << this->MSDM << "\n";
  os << indent << "MSDM2: " << this->MSDM2 << "\n";
  os << indent << "ComputeSurfaceDistances: " << this->ComputeSurfaceDistances << "\n";
  os << indent << "ComputePerceptualDistances: " << this->ComputePerceptualDistances << "\n";
}

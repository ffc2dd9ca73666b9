// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMeshDistortion.h"

#include "Core/Distortion.h"
#include "Core/StructuralDistortion.h"
#include "Private/FilterRun.h"
#include "Private/PerceptualDistance.h"
#include "Private/PolyDataMesh.h"
#include "Private/SurfaceDistance.h"

#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkDoubleArray.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <algorithm>

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

int vtkMeshDistortion::RequestData(vtkInformation*, vtkInformationVector** inputs,
  vtkInformationVector* outputs)
{
  for (double* figure :
    { &this->GeomDiff, &this->CurvDiff, &this->MRMS, &this->Hausdorff, &this->MSDM, &this->MSDM2 })
  {
    *figure = NotMeasured;
  }
  return sw::RunFilter(this, this->ErrorCode, outputs,
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
      const sw::Progress progress = sw::ProgressOf(this);
      progress.Report(0.1);
      if (this->ComputeSurfaceDistances)
      {
        this->CompareSurfaces(reference, distorted, output);
      }
      progress.Report(0.4);
      if (this->ComputePerceptualDistances)
      {
        this->CompareAppearance(reference, distorted, correspond, output);
      }
    });
}

void vtkMeshDistortion::ComparePoints(vtkPolyData* reference, vtkPolyData* distorted,
  vtkPolyData* output)
{
  const sw::PolyDataMesh mesh = sw::ToMesh(reference, sw::CoincidentPoints::Keep);
  const sw::TriangleMesh::PointMatrix moved = sw::PointsAt(distorted, mesh.PointOfVertex);
  const double diagonal = sw::BoundingBoxDiagonal(mesh.Mesh.Points);
  const Eigen::VectorXd geometric = sw::GeometricDifference(mesh.Mesh.Points, moved) / diagonal;
  const Eigen::VectorXd curvature =
    sw::CurvatureDifference(sw::UniqueEdges(mesh.Mesh), mesh.Mesh.Points, moved) / diagonal;
  output->GetPointData()->AddArray(sw::ToPointArray("GeometricDifference", mesh, geometric));
  output->GetPointData()->AddArray(sw::ToPointArray("CurvatureDifference", mesh, curvature));
  this->GeomDiff = geometric.mean();
  this->CurvDiff = curvature.mean();
}

void vtkMeshDistortion::CompareSurfaces(vtkPolyData* reference, vtkPolyData* distorted,
  vtkPolyData* output)
{
  const sw::PolyDataMesh before = sw::ToMesh(reference);
  const sw::PolyDataMesh after = sw::ToMesh(distorted);
  const double diagonal = sw::BoundingBoxDiagonal(before.Mesh.Points);
  const sw::Progress progress = sw::ProgressOf(this);
  const sw::SurfaceDistance there = sw::DistanceTo(sw::ClosestPoints(after.Mesh), before.Mesh,
    sw::ThreadsOfVtk(), progress.Part(0.1, 0.25));
  const sw::SurfaceDistance back = sw::DistanceTo(sw::ClosestPoints(before.Mesh), after.Mesh,
    sw::ThreadsOfVtk(), progress.Part(0.25, 0.4));
  output->GetPointData()->AddArray(
    sw::ToPointArray("SurfaceDistance", after, back.AtVertices / diagonal));
  this->MRMS = std::max(there.RootMeanSquare, back.RootMeanSquare) / diagonal;
  this->Hausdorff = std::max(there.Largest, back.Largest) / diagonal;
}

void vtkMeshDistortion::CompareAppearance(vtkPolyData* reference, vtkPolyData* distorted,
  bool correspond, vtkPolyData* output)
{
  const sw::PolyDataMesh before = sw::ToMesh(reference);
  const int threads = sw::ThreadsOfVtk();
  const sw::Progress progress = sw::ProgressOf(this);
  if (correspond)
  {
    sw::TriangleMesh moved = before.Mesh;
    moved.Points = sw::PointsAt(distorted, before.PointOfVertex);
    this->MSDM = sw::CubicMean(sw::LocalMsdm(sw::EdgesInBalls(before.Mesh), sw::EdgesInBalls(moved),
      sw::LongestSide(before.Mesh.Points), threads));
  }
  progress.Report(0.5);
  const sw::PolyDataMesh after = sw::ToMesh(distorted);
  const sw::PerceptualDistance distance =
    sw::Msdm2(before.Mesh, after.Mesh, threads, progress.Part(0.5, 1.0));
  output->GetPointData()->AddArray(sw::ToPointArray("LocalMSDM2", after, distance.AtVertices));
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

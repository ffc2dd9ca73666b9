// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMeshDistortion.h"

#include "Core/Distortion.h"
#include "Core/Errors.h"
#include "Private/FilterRun.h"
#include "Private/PolyDataMesh.h"

#include <vtkDoubleArray.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <string>

namespace sw = spectralwatermark;

vtkStandardNewMacro(vtkMeshDistortion);

vtkMeshDistortion::vtkMeshDistortion()
{
  this->SetNumberOfInputPorts(2);
}

vtkMeshDistortion::~vtkMeshDistortion() = default;

int vtkMeshDistortion::RequestData(vtkInformation*, vtkInformationVector** inputs,
  vtkInformationVector* outputs)
{
  this->GeomDiff = -1.0;
  this->CurvDiff = -1.0;
  return sw::RunFilter(this, this->ErrorCode, outputs,
    [&]()
    {
      vtkPolyData* reference = vtkPolyData::GetData(inputs[0]);
      vtkPolyData* distorted = vtkPolyData::GetData(inputs[1]);
      vtkPolyData* output = vtkPolyData::GetData(outputs);
      const sw::Progress progress = sw::ProgressOf(this);

      const sw::PolyDataMesh mesh = sw::ToMesh(reference, sw::CoincidentPoints::Keep);
      if (distorted->GetNumberOfPoints() != reference->GetNumberOfPoints())
      {
        throw sw::InvalidInput("the meshes have " + std::to_string(reference->GetNumberOfPoints()) +
          " and " + std::to_string(distorted->GetNumberOfPoints()) +
          " points: point-by-point distances need the same points in the same order");
      }
      const sw::TriangleMesh::PointMatrix moved = sw::PointsAt(distorted, mesh.PointOfVertex);
      const double diagonal = sw::BoundingBoxDiagonal(mesh.Mesh.Points);
      progress.Report(0.4);

      const Eigen::VectorXd geometric = sw::GeometricDifference(mesh.Mesh.Points, moved) / diagonal;
      const Eigen::VectorXd curvature =
        sw::CurvatureDifference(sw::UniqueEdges(mesh.Mesh), mesh.Mesh.Points, moved) / diagonal;
      progress.Report(0.9);

      output->ShallowCopy(distorted);
      output->GetPointData()->AddArray(sw::ToPointArray("GeometricDifference", mesh, geometric));
      output->GetPointData()->AddArray(sw::ToPointArray("CurvatureDifference", mesh, curvature));
      this->GeomDiff = geometric.mean();
      this->CurvDiff = curvature.mean();
    });
}

void vtkMeshDistortion::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "GeomDiff: " << this->GeomDiff << "\n";
  os << indent << "CurvDiff: " << this->CurvDiff << "\n";
}

// SPDX-License-Identifier: BSD-3-Clause
#ifndef SpectralWatermark_Benchmark_BenchmarkMesh_h
#define SpectralWatermark_Benchmark_BenchmarkMesh_h

#include "Core/Mesh/TriangleMesh.h"

#include <vtkCellArray.h>
#include <vtkLinearSubdivisionFilter.h>
#include <vtkNew.h>
#include <vtkPLYReader.h>
#include <vtkPolyData.h>

#include <string>

namespace spectralwatermark::benchmark
{

/// A PLY file, each triangle divided into four so many times.
inline TriangleMesh ReadMesh(const std::string& path, int subdivisions)
{
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName(path.c_str());
  vtkNew<vtkLinearSubdivisionFilter> subdivision;
  subdivision->SetInputConnection(reader->GetOutputPort());
  subdivision->SetNumberOfSubdivisions(subdivisions);
  vtkAlgorithm* last = reader;
  if (subdivisions > 0)
  {
    last = subdivision;
  }
  last->Update();
  auto* data = vtkPolyData::SafeDownCast(last->GetOutputDataObject(0));
  TriangleMesh mesh;
  mesh.Points.resize(data->GetNumberOfPoints(), 3);
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    mesh.Points.row(i) = Eigen::Map<const Eigen::RowVector3d>(data->GetPoint(i));
  }
  mesh.Triangles.resize(data->GetNumberOfPolys(), 3);
  vtkIdType size = 0;
  const vtkIdType* corners = nullptr;
  vtkIdType triangle = 0;
  for (data->GetPolys()->InitTraversal(); data->GetPolys()->GetNextCell(size, corners);)
  {
    mesh.Triangles.row(triangle++) << corners[0], corners[1], corners[2];
  }
  return mesh;
}

} // namespace spectralwatermark::benchmark

#endif

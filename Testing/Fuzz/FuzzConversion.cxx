// SPDX-License-Identifier: BSD-3-Clause
// Any vtkPolyData into a mesh of the Core, and back.
#include "Core/Mesh/TriangleMesh.h"
#include "Core/Support/Errors.h"
#include "Fuzz/Require.h"
#include "Private/PolyDataMesh.h"
#include "Support/RandomMesh.h"

#include <vtkOutputWindow.h>
#include <vtkPolyData.h>

#include <array>
#include <set>

namespace sw = spectralwatermark;
using fuzzing::Require;

namespace
{

void Check(const sw::PolyDataMesh& mesh, vtkPolyData* input)
{
  const sw::Index vertices = mesh.Mesh.NumberOfVertices();
  Require(mesh.Mesh.Points.allFinite(), "a point is not finite");
  Require(mesh.Mesh.NumberOfTriangles() > 0, "no triangles");
  Require(mesh.Mesh.Triangles.minCoeff() >= 0 && mesh.Mesh.Triangles.maxCoeff() < vertices,
    "a triangle of a vertex that does not exist");
  for (sw::Index t = 0; t < mesh.Mesh.NumberOfTriangles(); ++t)
  {
    const auto corners = mesh.Mesh.Triangles.row(t);
    Require(corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0],
      "a triangle with the same vertex twice");
  }
  Require(mesh.VertexOfPoint.size() == static_cast<std::size_t>(input->GetNumberOfPoints()),
    "not a vertex for every point");
  Require(mesh.PointOfVertex.size() == static_cast<std::size_t>(vertices),
    "not a point for every vertex");
  for (std::size_t v = 0; v < mesh.PointOfVertex.size(); ++v)
  {
    const auto point = static_cast<std::size_t>(mesh.PointOfVertex[v]);
    Require(mesh.VertexOfPoint[point] == static_cast<sw::Index>(v),
      "a vertex that is not its point's");
  }
}

// Points of a vertex are where it is, and no two vertices are at the same place.
void CheckMerged(const sw::PolyDataMesh& mesh, vtkPolyData* input)
{
  for (std::size_t point = 0; point < mesh.VertexOfPoint.size(); ++point)
  {
    const sw::Index vertex = mesh.VertexOfPoint[point];
    if (vertex >= 0)
    {
      double p[3];
      input->GetPoint(static_cast<vtkIdType>(point), p);
      Require(mesh.Mesh.Points.row(vertex) == Eigen::RowVector3d(p[0], p[1], p[2]),
        "a point was moved to another vertex");
    }
  }
  std::set<std::array<double, 3>> places;
  for (const auto& p : mesh.Mesh.Points.rowwise())
  {
    Require(places.insert({ p[0], p[1], p[2] }).second, "two vertices at the same place");
  }
}

void CheckThereAndBack(const sw::PolyDataMesh& mesh)
{
  const auto polyData = sw::ToPolyData(mesh.Mesh, false);
  const sw::PolyDataMesh again = sw::ToMesh(polyData, sw::CoincidentPoints::Keep);
  Require(sw::SameTriangles(again.Mesh, mesh.Mesh) ||
      again.Mesh.NumberOfVertices() < mesh.Mesh.NumberOfVertices(),
    "there and back, other triangles");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  vtkOutputWindow::GetInstance()->SetDisplayModeToNever();
  fuzzing::Bytes bytes(data, size);
  const auto input = fuzzing::RandomMesh(bytes);
  for (const auto coincident : { sw::CoincidentPoints::Merge, sw::CoincidentPoints::Keep })
  {
    try
    {
      const sw::PolyDataMesh mesh = sw::ToMesh(input, coincident);
      Check(mesh, input);
      if (coincident == sw::CoincidentPoints::Merge)
      {
        CheckMerged(mesh, input);
        CheckThereAndBack(mesh);
      }
    }
    catch (const sw::InvalidInput& error)
    {
      Require(error.what()[0] != '\0', "an error without a text");
    }
  }
  return 0;
}

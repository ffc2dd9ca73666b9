// SPDX-License-Identifier: BSD-3-Clause
#include "Private/PolyDataMesh.h"

#include "Core/Support/Errors.h"
#include "Core/Support/MemoryBudget.h"
#include "Core/Support/Text.h"
#include "Private/Reordering.h"

#include <vtkAlgorithm.h>
#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStaticPointLocator.h>
#include <vtkTriangleFilter.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>

namespace spectralwatermark
{

namespace
{

using Triangle = std::array<vtkIdType, 3>;

void CheckNotEmpty(vtkPolyData* input)
{
  if (input == nullptr || input->GetNumberOfPoints() == 0)
  {
    throw InvalidInput("", "the input has no points",
      "connect a mesh, and check that its file was read");
  }
  if (input->GetNumberOfPolys() + input->GetNumberOfStrips() == 0)
  {
    throw InvalidInput("",
      "the input has points but no polygons or triangle strips, and a surface is needed",
      "reconstruct one first if this is a point cloud");
  }
}

[[noreturn]] void RefuseNoSurface()
{
  throw InvalidInput("", "no polygon has three distinct points: there is no surface",
    "repair the mesh");
}

// The smallest size of a mesh. The sixth power of a length must not underflow.
constexpr double SmallestSize = 1e-50;

// The largest absolute value of a coordinate. The sixth power of a length must not overflow.
constexpr double LargestCoordinate = 1e50;

// Calls visit(size, corners) for each cell.
template <typename Visit>
void ForEachCell(vtkCellArray* cells, const Visit& visit)
{
  const auto iterator = vtk::TakeSmartPointer(cells->NewIterator());
  for (iterator->GoToFirstCell(); !iterator->IsDoneWithTraversal(); iterator->GoToNextCell())
  {
    vtkIdType size = 0;
    const vtkIdType* corners = nullptr;
    iterator->GetCurrentCell(size, corners);
    visit(size, corners);
  }
}

// Throws if a cell uses a point that does not exist. This must come before any VTK code that trusts
// the ids.
void CheckCorners(vtkCellArray* cells, vtkIdType pointCount)
{
  ForEachCell(cells,
    [pointCount](vtkIdType size, const vtkIdType* corners)
    {
      for (vtkIdType i = 0; i < size; ++i)
      {
        if (corners[i] < 0 || corners[i] >= pointCount)
        {
          throw InvalidInput("",
            "a cell uses point " + std::to_string(corners[i]) + ", but there are " +
              std::to_string(pointCount) + " points",
            "repair the mesh: it is damaged");
        }
      }
    });
}

std::string Rounded(double value)
{
  return TextOf(value);
}

void CheckPoint(vtkIdType id, const Eigen::Vector3d& point)
{
  if (!point.allFinite())
  {
    throw InvalidInput("", "point " + std::to_string(id) + " has a coordinate that is not finite",
      "remove it and its polygons, or repair the file");
  }
  if (point.cwiseAbs().maxCoeff() > LargestCoordinate)
  {
    throw InvalidInput("",
      "point " + std::to_string(id) + " has a coordinate beyond " + Rounded(LargestCoordinate),
      "repair the file, or choose larger units");
  }
}

// The cells with at least three corners; vtkTriangleFilter crashes on others. Throws for points
// that are not finite, because vtkTriangleFilter would leave out their polygons without an error.
vtkSmartPointer<vtkCellArray> WithThreeCorners(vtkPoints* points, vtkCellArray* cells)
{
  auto kept = vtkSmartPointer<vtkCellArray>::New();
  ForEachCell(cells,
    [points, &kept](vtkIdType size, const vtkIdType* corners)
    {
      if (size < 3)
      {
        return;
      }
      kept->InsertNextCell(size, corners);
      for (vtkIdType i = 0; i < size; ++i)
      {
        Eigen::Vector3d point;
        points->GetPoint(corners[i], point.data());
        CheckPoint(corners[i], point);
      }
    });
  return kept;
}

// The polygons and strips of the input, divided into triangles of the same points.
vtkSmartPointer<vtkCellArray> Triangulated(vtkPolyData* input)
{
  const bool onlyTriangles =
    input->GetNumberOfStrips() == 0 && input->GetPolys()->IsHomogeneous() == 3;
  if (onlyTriangles)
  {
    return input->GetPolys();
  }
  vtkNew<vtkPolyData> surface;
  surface->SetPoints(input->GetPoints());
  surface->SetPolys(WithThreeCorners(input->GetPoints(), input->GetPolys()));
  surface->SetStrips(WithThreeCorners(input->GetPoints(), input->GetStrips()));
  vtkNew<vtkTriangleFilter> triangulate;
  triangulate->SetInputData(surface);
  triangulate->PassVertsOff();
  triangulate->PassLinesOff();
  triangulate->Update();
  return triangulate->GetOutput()->GetPolys();
}

std::vector<Triangle> TrianglesOf(vtkCellArray* cells)
{
  std::vector<Triangle> triangles;
  triangles.reserve(cells->GetNumberOfCells());
  ForEachCell(cells,
    [&triangles](vtkIdType size, const vtkIdType* corners)
    {
      if (size == 3)
      {
        triangles.push_back({ corners[0], corners[1], corners[2] });
      }
    });
  return triangles;
}

// The points that triangles use, in ascending order.
std::vector<vtkIdType> UsedPoints(const std::vector<Triangle>& triangles, vtkIdType pointCount)
{
  std::vector<char> isUsed(pointCount, 0);
  for (const Triangle& triangle : triangles)
  {
    for (const vtkIdType point : triangle)
    {
      isUsed[point] = 1;
    }
  }
  std::vector<vtkIdType> used;
  for (vtkIdType point = 0; point < pointCount; ++point)
  {
    if (isUsed[point] != 0)
    {
      used.push_back(point);
    }
  }
  return used;
}

// For each row, the row that represents all rows with exactly the same coordinates. Which of them
// it is depends on the number of threads.
std::vector<vtkIdType> RepresentativeRows(const TriangleMesh::PointMatrix& points)
{
  vtkNew<vtkPoints> coordinates;
  coordinates->SetDataTypeToDouble();
  coordinates->SetNumberOfPoints(points.rows());
  for (Index i = 0; i < points.rows(); ++i)
  {
    coordinates->SetPoint(i, points(i, 0), points(i, 1), points(i, 2));
  }
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(coordinates);
  vtkNew<vtkStaticPointLocator> locator;
  locator->SetDataSet(cloud);
  locator->BuildLocator();
  std::vector<vtkIdType> representatives(points.rows());
  locator->MergePoints(0.0, representatives.data());
  return representatives;
}

// The triangles in terms of vertices, without those that have lost a corner.
TriangleMesh::TriangleMatrix ProperTriangles(const std::vector<Triangle>& triangles,
  const std::vector<Index>& vertexOfPoint)
{
  TriangleMesh::TriangleMatrix proper(triangles.size(), 3);
  Index kept = 0;
  for (const Triangle& triangle : triangles)
  {
    const Index a = vertexOfPoint[triangle[0]];
    const Index b = vertexOfPoint[triangle[1]];
    const Index c = vertexOfPoint[triangle[2]];
    if (a != b && b != c && c != a)
    {
      proper.row(kept++) << a, b, c;
    }
  }
  if (kept == 0)
  {
    RefuseNoSurface();
  }
  proper.conservativeResize(kept, 3);
  return proper;
}

void CheckSize(const TriangleMesh::PointMatrix& points)
{
  const double size = (points.colwise().maxCoeff() - points.colwise().minCoeff()).maxCoeff();
  if (!(size > SmallestSize))
  {
    throw InvalidInput("", "the mesh is only " + Rounded(size) + " large",
      "choose smaller units, so that its size is about 1");
  }
}

} // namespace

PolyDataMesh ToMesh(vtkPolyData* input, CoincidentPoints coincident)
{
  CheckNotEmpty(input);
  const vtkIdType pointCount = input->GetNumberOfPoints();
  for (vtkCellArray* cells :
    { input->GetVerts(), input->GetLines(), input->GetPolys(), input->GetStrips() })
  {
    CheckCorners(cells, pointCount);
  }
  // The peak memory of the conversion. Testing/Benchmark/memory measures it for triangles.
  constexpr double conversionBytesPerPolygon = 85.0;
  RequireMemoryForTriangles(input->GetNumberOfPolys(), conversionBytesPerPolygon);
  const std::vector<Triangle> triangles = TrianglesOf(Triangulated(input));
  if (triangles.empty())
  {
    RefuseNoSurface();
  }
  const std::vector<vtkIdType> used = UsedPoints(triangles, pointCount);

  PolyDataMesh result;
  result.VertexOfPoint.assign(pointCount, -1);
  const std::vector<vtkIdType> representative = coincident == CoincidentPoints::Merge
    ? RepresentativeRows(CheckedPoints(input, used))
    : IdentityOrder(static_cast<vtkIdType>(used.size()));
  // Vertices are numbered in the order of their lowest points, no matter which point represents
  // them.
  std::vector<Index> vertexOfRow(used.size(), -1);
  for (std::size_t i = 0; i < used.size(); ++i)
  {
    Index& vertex = vertexOfRow[representative[i]];
    if (vertex < 0)
    {
      vertex = static_cast<Index>(result.PointOfVertex.size());
      result.PointOfVertex.push_back(used[i]);
    }
    result.VertexOfPoint[used[i]] = vertex;
  }
  result.Mesh.Points = CheckedPoints(input, result.PointOfVertex);
  result.Mesh.Triangles = ProperTriangles(triangles, result.VertexOfPoint);
  CheckSize(result.Mesh.Points);
  return result;
}

TriangleMesh::PointMatrix PointsOf(vtkPolyData* mesh, const std::vector<vtkIdType>& ids)
{
  TriangleMesh::PointMatrix points(ids.size(), 3);
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    double p[3];
    mesh->GetPoint(ids[i], p);
    points.row(i) << p[0], p[1], p[2];
  }
  return points;
}

TriangleMesh::PointMatrix CheckedPoints(vtkPolyData* input, const std::vector<vtkIdType>& ids)
{
  TriangleMesh::PointMatrix points = PointsOf(input, ids);
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    CheckPoint(ids[i], points.row(i));
  }
  return points;
}

void CheckStorable(const TriangleMesh::PointMatrix& points, bool storesFloat)
{
  const double largest = storesFloat ? static_cast<double>(std::numeric_limits<float>::max())
                                     : std::numeric_limits<double>::max();
  if (!points.allFinite() || points.cwiseAbs().maxCoeff() > largest)
  {
    throw InvalidInput(storesFloat ? "OutputPointsPrecision" : "",
      std::string("the result has coordinates beyond what ") + (storesFloat ? "float" : "double") +
        " holds",
      storesFloat ? "store double points, or scale the mesh"
                  : "scale the mesh, or choose smaller values");
  }
}

vtkSmartPointer<vtkPolyData> ToPolyData(const TriangleMesh& mesh, bool storesFloat)
{
  CheckStorable(mesh.Points, storesFloat);
  return ToUncheckedPolyData(mesh, storesFloat);
}

vtkSmartPointer<vtkPolyData> ToUncheckedPolyData(const TriangleMesh& mesh, bool storesFloat)
{
  vtkNew<vtkPoints> points;
  points->SetDataType(storesFloat ? VTK_FLOAT : VTK_DOUBLE);
  points->SetNumberOfPoints(mesh.NumberOfVertices());
  for (Index v = 0; v < mesh.NumberOfVertices(); ++v)
  {
    points->SetPoint(v, mesh.Points(v, 0), mesh.Points(v, 1), mesh.Points(v, 2));
  }
  vtkNew<vtkCellArray> cells;
  for (Index t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    const auto corners = mesh.Triangles.row(t);
    cells->InsertNextCell({ corners[0], corners[1], corners[2] });
  }
  auto output = vtkSmartPointer<vtkPolyData>::New();
  output->SetPoints(points);
  output->SetPolys(cells);
  return output;
}

vtkSmartPointer<vtkDoubleArray> ToPointArray(const char* name, const PolyDataMesh& mesh,
  const Eigen::MatrixXd& values)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(static_cast<int>(values.cols()));
  array->SetNumberOfTuples(static_cast<vtkIdType>(mesh.VertexOfPoint.size()));
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Eigen::Map<RowMajor> tuples(array->GetPointer(0), static_cast<Index>(mesh.VertexOfPoint.size()),
    values.cols());
  for (std::size_t point = 0; point < mesh.VertexOfPoint.size(); ++point)
  {
    const Index vertex = mesh.VertexOfPoint[point];
    if (vertex >= 0)
    {
      tuples.row(point) = values.row(vertex);
    }
    else
    {
      tuples.row(point).setZero();
    }
  }
  return array;
}

bool StoresFloat(vtkPolyData* input, int outputPointsPrecision)
{
  if (outputPointsPrecision == vtkAlgorithm::DEFAULT_PRECISION)
  {
    return input->GetPoints()->GetDataType() != VTK_DOUBLE;
  }
  return outputPointsPrecision == vtkAlgorithm::SINGLE_PRECISION;
}

void SetPoints(vtkPolyData* output, vtkPolyData* input, const PolyDataMesh& mesh,
  const TriangleMesh::PointMatrix& points, int outputPointsPrecision)
{
  const bool storesFloat = StoresFloat(input, outputPointsPrecision);
  CheckStorable(points, storesFloat);
  vtkNew<vtkPoints> moved;
  moved->SetDataType(storesFloat ? VTK_FLOAT : VTK_DOUBLE);
  moved->SetNumberOfPoints(input->GetNumberOfPoints());
  for (vtkIdType point = 0; point < input->GetNumberOfPoints(); ++point)
  {
    const Index vertex = mesh.VertexOfPoint[point];
    if (vertex >= 0)
    {
      moved->SetPoint(point, points(vertex, 0), points(vertex, 1), points(vertex, 2));
    }
    else
    {
      moved->SetPoint(point, input->GetPoint(point));
    }
  }
  output->SetPoints(moved);
}

} // namespace spectralwatermark

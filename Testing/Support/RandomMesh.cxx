// SPDX-License-Identifier: BSD-3-Clause
#include "Support/RandomMesh.h"

#include "Support/FilterTesting.h"
#include "Support/Shapes.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <array>
#include <cmath>
#include <limits>

namespace fuzzing
{

namespace
{

constexpr int MostLoosePoints = 40;
constexpr int MostLoosePolygons = 60;
constexpr int MostDamages = 8;

double Coordinate(Bytes& bytes)
{
  using Limits = std::numeric_limits<double>;
  constexpr std::array<double, 18> special{ 0.0, -0.0, 1.0, -1.0, 0.5, 1e-30, 1e30, -1e30,
    Limits::denorm_min(), -Limits::min(), Limits::max(), Limits::lowest(), 1e154, 3.5e38, 1.2e-38,
    Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity() };
  switch (bytes.Below(8))
  {
    case 0:
      return special[static_cast<std::size_t>(bytes.Below(static_cast<int>(special.size())))];
    case 1:
      return bytes.Raw<double>();
    case 2:
      return bytes.Below(5); // so that some coincide
    default:
      return 2.0 * bytes.Share() - 1.0;
  }
}

vtkIdType PointId(Bytes& bytes, vtkIdType count)
{
  constexpr int seldom = 250;
  const int choice = bytes.Byte();
  if (choice > seldom)
  {
    return choice % 2 == 0 ? bytes.Raw<vtkIdType>() : count + choice - seldom - 2;
  }
  return count > 0 ? choice % count : 0;
}

void AddCells(vtkCellArray* cells, int cellCount, int mostCorners, vtkIdType pointCount,
  Bytes& bytes)
{
  vtkNew<vtkIdList> corners;
  for (int cell = 0; cell < cellCount && !bytes.AtEnd(); ++cell)
  {
    corners->Reset();
    // Mostly triangles, where more corners are possible.
    const int kind = bytes.Below(8);
    const int size = kind < 6 ? std::min(3, mostCorners) : bytes.Below(mostCorners + 1);
    for (int corner = 0; corner < size; ++corner)
    {
      corners->InsertNextId(PointId(bytes, pointCount));
    }
    cells->InsertNextCell(corners);
  }
}

vtkSmartPointer<vtkPolyData> LoosePolygons(Bytes& bytes)
{
  constexpr std::array<int, 4> types{ VTK_FLOAT, VTK_DOUBLE, VTK_INT, VTK_FLOAT };
  vtkNew<vtkPoints> points;
  points->SetDataType(types[static_cast<std::size_t>(bytes.Below(4))]);
  const int pointCount = bytes.Below(MostLoosePoints + 1);
  for (int i = 0; i < pointCount; ++i)
  {
    double p[3];
    for (double& coordinate : p)
    {
      coordinate = Coordinate(bytes);
      if (points->GetDataType() == VTK_INT)
      {
        coordinate = std::isfinite(coordinate) ? std::fmod(100.0 * coordinate, 1e6) : 0.0;
      }
    }
    points->InsertNextPoint(p);
  }
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(points);
  vtkNew<vtkCellArray> polygons;
  AddCells(polygons, bytes.Below(MostLoosePolygons + 1), 7, pointCount, bytes);
  mesh->SetPolys(polygons);
  const int others = bytes.Below(16);
  if ((others & 1) != 0)
  {
    vtkNew<vtkCellArray> strips;
    AddCells(strips, bytes.Below(4), 9, pointCount, bytes);
    mesh->SetStrips(strips);
  }
  if ((others & 2) != 0)
  {
    vtkNew<vtkCellArray> lines;
    AddCells(lines, bytes.Below(4), 3, pointCount, bytes);
    mesh->SetLines(lines);
  }
  if ((others & 4) != 0)
  {
    vtkNew<vtkCellArray> vertices;
    AddCells(vertices, bytes.Below(4), 2, pointCount, bytes);
    mesh->SetVerts(vertices);
  }
  return mesh;
}

shapes::TriangleMesh KnownShape(Bytes& bytes)
{
  static const std::array<shapes::TriangleMesh, 3> bumpy{ shapes::Bumpy(1), shapes::Bumpy(2),
    shapes::Bumpy(3) };
  switch (bytes.Below(6))
  {
    case 0:
      return shapes::Icosphere(bytes.Below(3));
    case 1:
      return shapes::Rectangle(1 + bytes.Below(9), 1 + bytes.Below(9), 1.0, 1.0 + bytes.Share());
    case 2:
      return shapes::Union({ shapes::Icosphere(1), shapes::Bumpy(1) }, 4.0 * bytes.Share());
    default:
      return bumpy[static_cast<std::size_t>(bytes.Below(3))];
  }
}

void Scale(shapes::TriangleMesh& mesh, Bytes& bytes)
{
  mesh.Points *= std::pow(10.0, bytes.Below(61) - 30);
}

// One damage, to a mesh that is still one of triangles.
void Damage(shapes::TriangleMesh& mesh, Bytes& bytes)
{
  const auto vertex = [&] { return bytes.Below(static_cast<int>(mesh.NumberOfVertices())); };
  const auto triangle = [&] { return bytes.Below(static_cast<int>(mesh.NumberOfTriangles())); };
  const auto corner = [&] { return bytes.Below(3); };
  switch (bytes.Below(11))
  {
    case 0:
      Scale(mesh, bytes);
      break;
    case 1: // far from the origin
      mesh.Points.rowwise() +=
        Eigen::RowVector3d(Coordinate(bytes), Coordinate(bytes), Coordinate(bytes));
      break;
    case 2:
      mesh.Points(vertex(), corner()) = Coordinate(bytes);
      break;
    case 3: // two points at the same place
      mesh.Points.row(vertex()) = mesh.Points.row(vertex());
      break;
    case 4: // turned over
      mesh.Triangles.row(triangle()).reverseInPlace();
      break;
    case 5: // any corner
      mesh.Triangles(triangle(), corner()) = vertex();
      break;
    case 6: // twice the same
      mesh.Triangles.row(triangle()) = mesh.Triangles.row(triangle());
      break;
    case 7: // holes
      mesh.Triangles.conservativeResize(1 + triangle(), 3);
      break;
    case 8: // flat
      mesh.Points.col(corner()) *= bytes.Flag() ? 0.0 : 1e-12;
      break;
    case 9: // noise
      for (shapes::Index v = 0; v < mesh.NumberOfVertices(); ++v)
      {
        mesh.Points.row(v) *= 1.0 + 0.2 * (bytes.Share() - 0.5);
      }
      break;
    default: // everywhere at once: all in one point
      mesh.Points.bottomRows(vertex()).rowwise() = mesh.Points.row(vertex()).eval();
  }
}

vtkSmartPointer<vtkPolyData> DamagedShape(Bytes& bytes)
{
  shapes::TriangleMesh mesh = KnownShape(bytes);
  const int damages = bytes.Below(MostDamages + 1);
  for (int k = 0; k < damages && !bytes.AtEnd(); ++k)
  {
    Damage(mesh, bytes);
  }
  return bytes.Flag() ? filtertesting::Soup(mesh) : filtertesting::PolyData(mesh, bytes.Flag());
}

void AddData(vtkPolyData* mesh)
{
  vtkNew<vtkDoubleArray> ofPoints;
  ofPoints->SetName("OfPoints");
  ofPoints->SetNumberOfTuples(mesh->GetNumberOfPoints());
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    ofPoints->SetValue(i, 0.5 * static_cast<double>(i));
  }
  mesh->GetPointData()->AddArray(ofPoints);
  vtkNew<vtkIntArray> ofCells;
  ofCells->SetName("OfCells");
  ofCells->SetNumberOfTuples(mesh->GetNumberOfCells());
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
  {
    ofCells->SetValue(i, static_cast<int>(i));
  }
  mesh->GetCellData()->AddArray(ofCells);
  vtkNew<vtkIntArray> ofMesh;
  ofMesh->SetName("OfMesh");
  ofMesh->InsertNextValue(7);
  mesh->GetFieldData()->AddArray(ofMesh);
}

} // namespace

vtkSmartPointer<vtkPolyData> RandomMesh(Bytes& bytes)
{
  const auto mesh = bytes.Below(4) == 0 ? LoosePolygons(bytes) : DamagedShape(bytes);
  if (bytes.Flag())
  {
    AddData(mesh);
  }
  return mesh;
}

vtkSmartPointer<vtkPolyData> Sibling(vtkPolyData* mesh, Bytes& bytes)
{
  if (bytes.Below(4) == 0)
  {
    return RandomMesh(bytes);
  }
  auto copy = vtkSmartPointer<vtkPolyData>::New();
  copy->DeepCopy(mesh);
  const double size = copy->GetNumberOfPoints() > 0 ? copy->GetLength() : 0.0;
  for (vtkIdType i = 0; i < copy->GetNumberOfPoints() && !bytes.AtEnd(); ++i)
  {
    double p[3];
    copy->GetPoint(i, p);
    p[bytes.Below(3)] += 0.01 * size * (bytes.Share() - 0.5);
    copy->GetPoints()->SetPoint(i, p);
  }
  return copy;
}

} // namespace fuzzing

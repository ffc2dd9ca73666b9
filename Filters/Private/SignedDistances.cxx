// SPDX-License-Identifier: BSD-3-Clause
#include "Private/SignedDistances.h"

#include "Core/Mesh/Measures.h"

#include "Private/ClosestPoints.h"
#include "Private/PolyDataMesh.h"

#include <vtkGenericCell.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkStaticCellLocator.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace spectralwatermark
{

namespace
{

// The number of grid steps on each side of the surface's bounding box.
constexpr int Margin = 3;

// The number of steps around every triangle within which distances are computed: enough for the
// zero level.
constexpr int Band = 2;

using Point = Eigen::RowVector3d;

// A place where a line along x crosses the surface.
struct Crossing
{
  double X;
  int Turns; // 1 where the line enters the solid, -1 where it leaves it
};

// The grid of distances, which are computed first and negated inside the solid afterwards.
class Grid
{
public:
  Grid(const TriangleMesh& mesh, int resolution)
    : Mesh(mesh)
  {
    const Point lowest = mesh.Points.colwise().minCoeff();
    const Point size = mesh.Points.colwise().maxCoeff() - lowest;
    this->Step = size.maxCoeff() / resolution;
    this->Origin = lowest.array() - Margin * this->Step;
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Size[axis] = static_cast<int>(std::ceil(size[axis] / this->Step)) + 1 + 2 * Margin;
    }
    this->Image->SetDimensions(this->Size.data());
    this->Image->SetOrigin(this->Origin.data());
    this->Image->SetSpacing(this->Step, this->Step, this->Step);
    this->Image->AllocateScalars(VTK_FLOAT, 1);
    this->Values = static_cast<float*>(this->Image->GetScalarPointer());
    // All points are far away until a distance is computed.
    std::fill_n(this->Values, this->Image->GetNumberOfPoints(),
      static_cast<float>(Band * this->Step));
  }

  void ComputeDistances(const Progress& progress);
  void TurnInsideNegative();

  vtkSmartPointer<vtkImageData> GetImage() const { return this->Image; }

private:
  Point At(int x, int y, int z) const { return this->Origin + this->Step * Point(x, y, z); }
  std::size_t Number(int x, int y, int z) const { return x + this->Size[0] * this->Row(y, z); }
  std::size_t Row(int y, int z) const { return y + static_cast<std::size_t>(this->Size[1]) * z; }
  Point Corner(Index triangle, int corner) const
  {
    return this->Mesh.Points.row(this->Mesh.Triangles(triangle, corner));
  }

  // The first and the last grid point of a box along each axis.
  struct Box
  {
    std::array<int, 3> First;
    std::array<int, 3> Last;
  };
  // The grid points within `steps` of the triangle's bounding box.
  Box Around(Index triangle, int steps) const;

  double DistanceFrom(const Point& point);
  void ComputeAround(Index triangle);
  int TurnsAbout(Index triangle, double y, double z) const;
  std::vector<std::vector<Crossing>> Crossings() const;

  const TriangleMesh& Mesh;
  vtkNew<vtkImageData> Image;
  float* Values = nullptr;
  std::vector<bool> Known;
  vtkNew<vtkStaticCellLocator> Locator;
  vtkNew<vtkGenericCell> Cell; // the workspace of the locator
  std::array<int, 3> Size = {};
  Point Origin;
  double Step = 1.0;
};

Grid::Box Grid::Around(Index triangle, int steps) const
{
  Point lowest = this->Corner(triangle, 0);
  Point highest = lowest;
  for (int corner = 1; corner < 3; ++corner)
  {
    lowest = lowest.cwiseMin(this->Corner(triangle, corner));
    highest = highest.cwiseMax(this->Corner(triangle, corner));
  }
  Box box{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto i = static_cast<Index>(axis);
    const double first = std::floor((lowest[i] - this->Origin[i]) / this->Step);
    const double last = std::ceil((highest[i] - this->Origin[i]) / this->Step);
    box.First[axis] = std::max(0, static_cast<int>(first) - steps);
    box.Last[axis] = std::min(this->Size[axis] - 1, static_cast<int>(last) + steps);
  }
  return box;
}

// The distance of a point from the surface; far away if no triangle has an area.
double Grid::DistanceFrom(const Point& point)
{
  const NearestPoint nearest = FindNearest(this->Locator, this->Cell, point);
  return nearest.Triangle < 0 ? Band * this->Step : nearest.Distance;
}

void Grid::ComputeAround(Index triangle)
{
  const Box box = this->Around(triangle, Band - 1);
  const Point corner = this->Corner(triangle, 0);
  // A triangle without area has the normal 0, for which every point counts as near.
  const Point normal = AreaVector(this->Mesh, triangle).normalized();
  for (int z = box.First[2]; z <= box.Last[2]; ++z)
  {
    for (int y = box.First[1]; y <= box.Last[1]; ++y)
    {
      for (int x = box.First[0]; x <= box.Last[0]; ++x)
      {
        const std::size_t number = this->Number(x, y, z);
        const Point point = this->At(x, y, z);
        // A large triangle fills a small part of its box, so points far from its plane are skipped.
        if (!this->Known[number] && std::abs(normal.dot(point - corner)) <= 2.0 * Band * this->Step)
        {
          this->Known[number] = true;
          this->Values[number] = static_cast<float>(this->DistanceFrom(point));
        }
      }
    }
  }
}

void Grid::ComputeDistances(const Progress& progress)
{
  this->Known.assign(this->Image->GetNumberOfPoints(), false);
  this->Locator->SetDataSet(ToPolyData(this->Mesh, false));
  this->Locator->BuildLocator();
  const Index triangles = this->Mesh.NumberOfTriangles();
  for (Index t = 0; t < triangles; ++t)
  {
    this->ComputeAround(t);
    if (t % 256 == 0)
    {
      progress.Report(static_cast<double>(t) / static_cast<double>(triangles));
    }
  }
}

// How often the boundary of the triangle, seen along x, winds around the point (y, z). Of two
// triangles with a common edge, exactly one counts a point on it: intervals are half open, and both
// triangles compute the same place on the edge.
int Grid::TurnsAbout(Index triangle, double y, double z) const
{
  int turns = 0;
  for (int corner = 0; corner < 3; ++corner)
  {
    Index from = this->Mesh.Triangles(triangle, corner);
    Index to = this->Mesh.Triangles(triangle, (corner + 1) % 3);
    const int upwards = this->Mesh.Points(from, 2) <= z ? 1 : -1;
    if ((this->Mesh.Points(from, 2) <= z) == (this->Mesh.Points(to, 2) <= z))
    {
      continue;
    }
    if (to < from)
    {
      std::swap(from, to);
    }
    const Point a = this->Mesh.Points.row(from);
    const Point b = this->Mesh.Points.row(to);
    const double meets = a[1] + (z - a[2]) / (b[2] - a[2]) * (b[1] - a[1]);
    turns += meets > y ? upwards : 0;
  }
  return turns;
}

std::vector<std::vector<Crossing>> Grid::Crossings() const
{
  std::vector<std::vector<Crossing>> rows(this->Row(0, this->Size[2]));
  for (Index t = 0; t < this->Mesh.NumberOfTriangles(); ++t)
  {
    const Box box = this->Around(t, 0);
    const Point normal = AreaVector(this->Mesh, t);
    const Point corner = this->Corner(t, 0);
    for (int z = box.First[2]; z <= box.Last[2]; ++z)
    {
      for (int y = box.First[1]; y <= box.Last[1]; ++y)
      {
        const Point line = this->At(0, y, z);
        const int turns = this->TurnsAbout(t, line[1], line[2]);
        if (turns != 0)
        {
          const double rise = normal[1] * (line[1] - corner[1]) + normal[2] * (line[2] - corner[2]);
          rows[this->Row(y, z)].push_back({ corner[0] - rise / normal[0], -turns });
        }
      }
    }
  }
  return rows;
}

void Grid::TurnInsideNegative()
{
  std::vector<std::vector<Crossing>> rows = this->Crossings();
  for (int z = 0; z < this->Size[2]; ++z)
  {
    for (int y = 0; y < this->Size[1]; ++y)
    {
      std::vector<Crossing>& row = rows[this->Row(y, z)];
      std::sort(row.begin(), row.end(),
        [](const Crossing& a, const Crossing& b) { return a.X < b.X; });
      auto next = row.begin();
      int winding = 0;
      for (int x = 0; x < this->Size[0]; ++x)
      {
        for (; next != row.end() && next->X < this->At(x, y, z)[0]; ++next)
        {
          winding += next->Turns;
        }
        if (winding != 0)
        {
          this->Values[this->Number(x, y, z)] *= -1.0F;
        }
      }
    }
  }
}

} // namespace

vtkSmartPointer<vtkImageData> SignedDistances(const TriangleMesh& oriented, int resolution,
  const Progress& progress)
{
  Grid grid(oriented, resolution);
  grid.ComputeDistances(progress);
  grid.TurnInsideNegative();
  return grid.GetImage();
}

} // namespace spectralwatermark

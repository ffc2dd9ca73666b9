// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceResampling.h"

#include "Core/Errors.h"
#include "Core/Solid.h"
#include "FilterRun.h"
#include "PolyDataMesh.h"

#include <Eigen/Geometry>

#include <vtkAdaptiveSubdivisionFilter.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkImplicitPolyDataDistance.h>
#include <vtkLinearSubdivisionFilter.h>
#include <vtkLoopSubdivisionFilter.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkQuadricClustering.h>
#include <vtkSmartPointer.h>
#include <vtkSubdivisionFilter.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

namespace spectralwatermark
{

namespace
{

// Of the grid around a surface, in steps.
constexpr int Margin = 3;

// Distances are computed so many steps around every triangle: enough for the zero level and for
// the sign of what is farther away to be known.
constexpr int Band = 2;

bool IsClosed(const TriangleMesh& mesh)
{
  const std::map<Edge, std::vector<Index>> triangles = TrianglesOfEdges(mesh);
  return std::all_of(triangles.begin(), triangles.end(),
    [](const auto& edge) { return edge.second.size() == 2; });
}

vtkSmartPointer<vtkPolyData> Cluster(vtkPolyData* fine, double step)
{
  double bounds[6];
  fine->GetBounds(bounds);
  std::array<int, 3> divisions{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double size = bounds[2 * axis + 1] - bounds[2 * axis];
    divisions[axis] = std::max(1, static_cast<int>(std::ceil(size / step)));
  }
  vtkNew<vtkQuadricClustering> cluster;
  cluster->SetInputData(fine);
  cluster->AutoAdjustNumberOfDivisionsOff();
  cluster->SetNumberOfDivisions(divisions.data());
  cluster->CopyCellDataOff();
  cluster->Update();
  return cluster->GetOutput();
}

// Signed distances around a surface, on a regular grid.
class DistanceGrid
{
public:
  DistanceGrid(const TriangleMesh& mesh, int resolution)
    : Mesh(mesh)
  {
    const Eigen::RowVector3d lowest = mesh.Points.colwise().minCoeff();
    const Eigen::RowVector3d size = mesh.Points.colwise().maxCoeff() - lowest;
    this->Step = size.maxCoeff() / resolution;
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Size[axis] = static_cast<int>(std::ceil(size[axis] / this->Step)) + 1 + 2 * Margin;
      this->Origin[axis] = lowest[axis] - Margin * this->Step;
    }
    this->Image->SetDimensions(this->Size);
    this->Image->SetOrigin(this->Origin);
    this->Image->SetSpacing(this->Step, this->Step, this->Step);
    this->Image->AllocateScalars(VTK_FLOAT, 1);
    this->Values = static_cast<float*>(this->Image->GetScalarPointer());
    std::fill_n(this->Values, this->Image->GetNumberOfPoints(), Unknown());
  }

  void Compute(const Progress& progress)
  {
    vtkNew<vtkImplicitPolyDataDistance> distance;
    distance->SetInput(ToPolyData(this->Mesh, false));
    const Index triangles = this->Mesh.NumberOfTriangles();
    for (Index t = 0; t < triangles; ++t)
    {
      this->ComputeAround(t, distance);
      if (t % 256 == 0)
      {
        progress.Report(static_cast<double>(t) / static_cast<double>(triangles));
      }
    }
    this->FillRest();
  }

  vtkImageData* GetImage() { return this->Image; }

private:
  static float Unknown() { return std::numeric_limits<float>::quiet_NaN(); }

  void ComputeAround(Index t, vtkImplicitPolyDataDistance* distance)
  {
    int first[3];
    int last[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      double lowest = std::numeric_limits<double>::max();
      double highest = std::numeric_limits<double>::lowest();
      for (int corner = 0; corner < 3; ++corner)
      {
        const double x = this->Mesh.Points(this->Mesh.Triangles(t, corner), axis);
        lowest = std::min(lowest, x);
        highest = std::max(highest, x);
      }
      const double origin = this->Origin[axis];
      first[axis] = static_cast<int>(std::floor((lowest - origin) / this->Step)) - Band + 1;
      last[axis] = static_cast<int>(std::ceil((highest - origin) / this->Step)) + Band - 1;
    }
    const Eigen::RowVector3d corner = this->Mesh.Points.row(this->Mesh.Triangles(t, 0));
    const Eigen::RowVector3d normal =
      (this->Mesh.Points.row(this->Mesh.Triangles(t, 1)) - corner)
        .cross(this->Mesh.Points.row(this->Mesh.Triangles(t, 2)) - corner)
        .normalized(); // 0 for a triangle without area, which is not left out anywhere
    for (int z = first[2]; z <= last[2]; ++z)
    {
      for (int y = first[1]; y <= last[1]; ++y)
      {
        for (int x = first[0]; x <= last[0]; ++x)
        {
          const std::size_t k = static_cast<std::size_t>(x) +
            static_cast<std::size_t>(this->Size[0]) *
              (static_cast<std::size_t>(y) +
                static_cast<std::size_t>(this->Size[1]) * static_cast<std::size_t>(z));
          const Eigen::RowVector3d point(this->Origin[0] + this->Step * x,
            this->Origin[1] + this->Step * y, this->Origin[2] + this->Step * z);
          // Large triangles fill a small part of their boxes.
          if (std::isnan(this->Values[k]) &&
            std::abs(normal.dot(point - corner)) <= 2.0 * Band * this->Step)
          {
            this->Values[k] =
              static_cast<float>(distance->EvaluateFunction(point[0], point[1], point[2]));
          }
        }
      }
    }
  }

  // Every row of the grid begins outside, and its side changes only where distances are known.
  void FillRest()
  {
    const auto far = static_cast<float>(Band * this->Step);
    const vtkIdType points = this->Image->GetNumberOfPoints();
    float side = far;
    for (vtkIdType k = 0; k < points; ++k)
    {
      if (k % this->Size[0] == 0)
      {
        side = far;
      }
      if (std::isnan(this->Values[k]))
      {
        this->Values[k] = side;
      }
      else
      {
        side = this->Values[k] < 0.0F ? -far : far;
      }
    }
  }

  const TriangleMesh& Mesh;
  vtkNew<vtkImageData> Image;
  float* Values = nullptr;
  int Size[3] = {};
  double Origin[3] = {};
  double Step = 1.0;
};

} // namespace

TriangleMesh Subdivide(const TriangleMesh& mesh, Subdivision kind, int times, vtkAlgorithm* filter)
{
  vtkSmartPointer<vtkSubdivisionFilter> subdivide;
  if (kind == Subdivision::Loop)
  {
    subdivide = vtkSmartPointer<vtkLoopSubdivisionFilter>::New();
  }
  else
  {
    subdivide = vtkSmartPointer<vtkLinearSubdivisionFilter>::New();
  }
  subdivide->SetInputData(ToPolyData(mesh, false));
  subdivide->SetNumberOfSubdivisions(times);
  UpdateInside(subdivide, filter, 0.1, 0.9);
  if (subdivide->GetOutput()->GetNumberOfPolys() == 0)
  {
    throw InvalidInput("the surface cannot be subdivided: Loop's rule needs edges with one or two "
                       "triangles that are oriented alike");
  }
  return ToMesh(subdivide->GetOutput(), CoincidentPoints::Keep).Mesh;
}

TriangleMesh ResampleUniformly(const TriangleMesh& mesh, Index count, vtkAlgorithm* filter)
{
  // A surface passes through about so many cells per area of a cell's side.
  double step = std::sqrt(1.5 * VertexAreas(mesh).sum() / static_cast<double>(count));
  vtkNew<vtkAdaptiveSubdivisionFilter> split;
  split->SetInputData(ToPolyData(mesh, false));
  split->SetMaximumEdgeLength(0.5 * step);
  split->SetMaximumTriangleArea(step * step);
  UpdateInside(split, filter, 0.1, 0.7);
  vtkSmartPointer<vtkPolyData> clustered;
  const Progress progress = ProgressOf(filter);
  for (int pass = 0; pass < 4; ++pass)
  {
    clustered = Cluster(split->GetOutput(), step);
    progress.Report(0.7 + 0.07 * (pass + 1));
    const auto points = static_cast<double>(std::max<vtkIdType>(1, clustered->GetNumberOfPoints()));
    const double ratio = points / static_cast<double>(count);
    if (std::abs(ratio - 1.0) < 0.02)
    {
      break;
    }
    step *= std::sqrt(ratio);
  }
  if (clustered->GetNumberOfPolys() == 0)
  {
    throw InvalidInput("no triangle is left: raise RemeshingPercent");
  }
  return ToMesh(clustered).Mesh;
}

TriangleMesh ResampleByIsosurface(const TriangleMesh& mesh, int resolution, vtkAlgorithm* filter)
{
  if (!IsClosed(mesh))
  {
    throw InvalidInput(
      "an isosurface of the distance needs a closed surface, with an inside: close "
      "the holes (vtkFillHolesFilter), or use the uniform remeshing");
  }
  DistanceGrid grid(mesh, resolution);
  grid.Compute(ProgressOf(filter).Part(0.1, 0.9));
  vtkNew<vtkFlyingEdges3D> contour;
  contour->SetInputData(grid.GetImage());
  contour->SetValue(0, 0.0);
  contour->ComputeNormalsOff();
  contour->ComputeScalarsOff();
  contour->Update();
  return ToMesh(contour->GetOutput()).Mesh;
}

} // namespace spectralwatermark

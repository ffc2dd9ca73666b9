// SPDX-License-Identifier: BSD-3-Clause
#include "Private/Resampling.h"

#include "Core/Mesh/EdgeTopology.h"
#include "Core/Mesh/Measures.h"
#include "Core/Mesh/Orientation.h"
#include "Core/Support/Errors.h"
#include "Core/Support/MemoryBudget.h"
#include "Core/Support/Progress.h"
#include "Private/FilterExecution.h"
#include "Private/PolyDataMesh.h"
#include "Private/SignedDistances.h"

#include <vtkAdaptiveSubdivisionFilter.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkIncrementalOctreePointLocator.h>
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
#include <map>

namespace spectralwatermark
{

namespace
{

// Of uniform remeshing at its peak, for each triangle that it splits the surface into: 190 to 470 were
// measured.
constexpr double BytesOfPiece = 400.0;

// vtkQuadricClustering keeps 88 for each cell of its grid, also for the empty ones.
constexpr double BytesOfCell = 100.0;

// Around a sphere there are about a tenth of N^1.5 cells for N vertices; this is a thousand times that.
constexpr double MostCells = 100.0;

// An ordinary surface is split into some 20 triangles for each vertex, one of needles 1000 times as long
// as wide into 900.
constexpr double MostPieces = 1000.0;

bool IsClosed(const TriangleMesh& mesh)
{
  bool isClosed = true;
  EdgeTopology(mesh).ForEachEdge([&isClosed](const Edge& /*edge*/, const EdgeTopology::Sides& sides)
    { isClosed = isClosed && sides.size() == 2; });
  return isClosed;
}

// Of the grid and of the triangles, of which there are about two and a half for each square of its
// steps.
double MemoryOfIsosurface(const TriangleMesh& mesh, int resolution)
{
  constexpr double bytesOfNode = 6.0;
  constexpr double bytesOfSquare = 1000.0;
  const Eigen::Array3d size = mesh.Points.colwise().maxCoeff() - mesh.Points.colwise().minCoeff();
  const double step = size.maxCoeff() / resolution;
  return bytesOfNode * (size / step + 7.0).prod() +
    bytesOfSquare * VertexAreas(mesh).sum() / (step * step);
}

// The grid of cells with about this side.
std::array<double, 3> Grid(vtkPolyData* mesh, double side)
{
  double bounds[6];
  mesh->GetBounds(bounds);
  std::array<double, 3> divisions{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double size = bounds[2 * axis + 1] - bounds[2 * axis];
    divisions[axis] = std::max(1.0, std::ceil(size / side));
  }
  return divisions;
}

vtkSmartPointer<vtkPolyData> Cluster(vtkPolyData* fine, const std::array<double, 3>& grid)
{
  vtkNew<vtkQuadricClustering> cluster;
  cluster->SetInputData(fine);
  cluster->AutoAdjustNumberOfDivisionsOff();
  cluster->SetNumberOfXDivisions(static_cast<int>(grid[0]));
  cluster->SetNumberOfYDivisions(static_cast<int>(grid[1]));
  cluster->SetNumberOfZDivisions(static_cast<int>(grid[2]));
  cluster->CopyCellDataOff();
  cluster->Update();
  return cluster->GetOutput();
}

double LongestEdge(const TriangleMesh& mesh, Index triangle)
{
  double longest = 0.0;
  for (int k = 0; k < 3; ++k)
  {
    const auto a = mesh.Points.row(mesh.Triangles(triangle, k));
    const auto b = mesh.Points.row(mesh.Triangles(triangle, (k + 1) % 3));
    longest = std::max(longest, (b - a).norm());
  }
  return longest;
}

// About so many triangles come in addition when edges are halved until none is longer than this. Each
// halving leaves four of a triangle; where one edge is short already, three, of which two are as thin.
double NumberOfNewPieces(const TriangleMesh& mesh, double edge)
{
  double pieces = 0.0;
  for (Index t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    const double ofArea = 4.0 * AreaVector(mesh, t).norm() / (edge * edge);
    const double ofLength = std::pow(LongestEdge(mesh, t) / edge, std::log2(3.0));
    pieces += std::max({ 1.0, ofArea, ofLength }) - 1.0;
  }
  return pieces;
}

[[noreturn]] void RefuseAsTooThin()
{
  throw InvalidInput("", "the surface is too thin for its extent to be remeshed uniformly",
    "simplify or subdivide it instead");
}

void RequireMemoryToRemesh(double bytes, Index count)
{
  RequireMemory(bytes, std::to_string(count) + " vertices", "lower it", "RemeshingPercent");
}

// Of the pieces. Throws also where there would be no end of them.
double MemoryOfSplitting(const TriangleMesh& mesh, double edge, Index count)
{
  const double pieces = NumberOfNewPieces(mesh, edge);
  if (pieces > MostPieces * static_cast<double>(count))
  {
    RefuseAsTooThin();
  }
  return BytesOfPiece * pieces;
}

// Of the grid. Throws also where there would be no end of its cells.
double MemoryOfClustering(const std::array<double, 3>& grid, Index count)
{
  const double cells = grid[0] * grid[1] * grid[2];
  if (cells > MostCells * std::pow(static_cast<double>(count), 1.5))
  {
    RefuseAsTooThin();
  }
  return BytesOfCell * cells;
}

// No edge longer than this; what meets stays together.
vtkSmartPointer<vtkPolyData> Split(vtkPolyData* coarse, double edge, vtkAlgorithm* filter)
{
  // The filter's own locator has cells for the points that come in, and would search long lists of those
  // that it adds.
  vtkNew<vtkIncrementalOctreePointLocator> locator;
  locator->SetTolerance(0.0);
  vtkNew<vtkAdaptiveSubdivisionFilter> split;
  split->SetInputData(coarse);
  split->SetLocator(locator);
  split->SetMaximumEdgeLength(edge);
  split->SetMaximumTriangleArea(4.0 * edge * edge);
  RunInternalFilter(split, filter, 0.1, 0.7);
  return split->GetOutput();
}

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
  RunInternalFilter(subdivide, filter, 0.1, 0.9);
  if (subdivide->GetOutput()->GetNumberOfPolys() == 0)
  {
    throw InvalidInput("",
      "the surface cannot be subdivided: an edge has more than two triangles, or its triangles are "
      "oriented against each other",
      "repair the mesh");
  }
  return ToMesh(subdivide->GetOutput(), CoincidentPoints::Keep).Mesh;
}

TriangleMesh ResampleUniformly(const TriangleMesh& mesh, Index count, vtkAlgorithm* filter)
{
  // A surface passes through about so many cells per area of a cell's side.
  double step = std::sqrt(1.5 * VertexAreas(mesh).sum() / static_cast<double>(count));
  const auto coarse = ToPolyData(mesh, false);
  const double edge = 0.5 * step;
  RequireMemoryToRemesh(
    MemoryOfSplitting(mesh, edge, count) + MemoryOfClustering(Grid(coarse, step), count), count);
  const vtkSmartPointer<vtkPolyData> fine = Split(coarse, edge, filter);
  vtkSmartPointer<vtkPolyData> clustered;
  const Progress progress = ProgressOf(filter);
  for (int pass = 0; pass < 4; ++pass)
  {
    const std::array<double, 3> grid = Grid(coarse, step);
    RequireMemoryToRemesh(MemoryOfClustering(grid, count), count); // the pieces are there
    clustered = Cluster(fine, grid);
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
    throw InvalidInput("RemeshingPercent", "no triangle is left", "raise it");
  }
  return ToMesh(clustered).Mesh;
}

TriangleMesh ResampleByIsosurface(const TriangleMesh& mesh, int resolution, vtkAlgorithm* filter)
{
  if (!IsClosed(mesh))
  {
    throw InvalidInput("RemeshingMethod",
      "an isosurface of the distance needs a closed surface, with an inside",
      "close the holes, or remesh uniformly");
  }
  RequireMemory(MemoryOfIsosurface(mesh, resolution),
    std::to_string(resolution) + " steps along the longest side", "lower it",
    "IsosurfaceResolution");
  const vtkSmartPointer<vtkImageData> distances =
    SignedDistances(Oriented(mesh), resolution, ProgressOf(filter).Part(0.1, 0.9));
  constexpr double nearly = 1e-3; // of a step: around such a node there is next to no surface
  if (distances->GetScalarRange()[0] > -nearly * distances->GetSpacing()[0])
  {
    throw InvalidInput("IsosurfaceResolution", "the solid is thinner than a step of the grid",
      "raise it");
  }
  vtkNew<vtkFlyingEdges3D> contour;
  contour->SetInputData(distances);
  contour->SetValue(0, 0.0);
  contour->ComputeNormalsOff();
  contour->ComputeScalarsOff();
  contour->Update();
  return Oriented(ToMesh(contour->GetOutput()).Mesh);
}

} // namespace spectralwatermark

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

// The peak memory of uniform remeshing per triangle that it adds when it splits the surface. It
// depends on the shape, and Testing/Benchmark/memory measures it for needles.
constexpr double BytesPerPiece = 400.0;

// The memory of vtkQuadricClustering per cell of its grid, in bytes. It keeps 88 per cell, for
// empty cells as well. Testing/Benchmark/memory measures it.
constexpr double BytesPerCell = 100.0;

// The largest number of grid cells for N vertices, divided by N^1.5. A sphere takes about a tenth;
// the limit is a thousand times that.
constexpr double MostCells = 100.0;

// The largest number of triangles, per vertex of the result, into which a surface may be split. An
// ordinary surface takes about 20, one of needles 1000 times as long as wide takes 900.
constexpr double MostPieces = 1000.0;

bool IsClosed(const TriangleMesh& mesh)
{
  bool isClosed = true;
  EdgeTopology(mesh).ForEachEdge([&isClosed](const Edge& /*edge*/, const EdgeTopology::Sides& sides)
    { isClosed = isClosed && sides.size() == 2; });
  return isClosed;
}

// The memory of the grid and of the isosurface's triangles, in bytes. A square of the surface with
// a grid step as its side takes about two and a half triangles.
double MemoryOfIsosurface(const TriangleMesh& mesh, int resolution)
{
  // The memory per node of the grid, and per such square, in bytes. Testing/Benchmark/memory
  // measures them.
  constexpr double bytesPerNode = 6.0;
  constexpr double bytesPerSquare = 1000.0;
  const Eigen::Array3d size = mesh.Points.colwise().maxCoeff() - mesh.Points.colwise().minCoeff();
  const double step = size.maxCoeff() / resolution;
  return bytesPerNode * (size / step + 7.0).prod() +
    bytesPerSquare * VertexAreas(mesh).sum() / (step * step);
}

// The number of cells along each axis of a grid over the bounding box whose cells have about this
// side.
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

// A fine surface with the vertices in each cell of the grid merged into one.
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

// An estimate of the number of triangles that are added when edges are halved until none is longer
// than `edge`. Halving makes four triangles of one, or three if one edge is short already; two of
// these three are as thin as the one before.
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

// The memory of the split surface, in bytes. Throws if it would have far too many triangles.
double MemoryOfSplitting(const TriangleMesh& mesh, double edge, Index count)
{
  const double pieces = NumberOfNewPieces(mesh, edge);
  if (pieces > MostPieces * static_cast<double>(count))
  {
    RefuseAsTooThin();
  }
  return BytesPerPiece * pieces;
}

// The memory of the clustering grid, in bytes. Throws if it would have far too many cells.
double MemoryOfClustering(const std::array<double, 3>& grid, Index count)
{
  const double cells = grid[0] * grid[1] * grid[2];
  if (cells > MostCells * std::pow(static_cast<double>(count), 1.5))
  {
    RefuseAsTooThin();
  }
  return BytesPerCell * cells;
}

// Splits the surface until no edge is longer than `edge`, without opening gaps between triangles.
vtkSmartPointer<vtkPolyData> Split(vtkPolyData* coarse, double edge, vtkAlgorithm* filter)
{
  // The filter's own locator has bins for the incoming points only, and would search long lists of
  // the points that are added.
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
  // A surface passes through about 1.5 grid cells per area of a cell's side.
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
    // The split surface exists already, so only the grid needs memory.
    RequireMemoryToRemesh(MemoryOfClustering(grid, count), count);
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
  // The depth of the deepest node, in steps, below which the isosurface would be almost empty.
  constexpr double smallestDepth = 1e-3;
  if (distances->GetScalarRange()[0] > -smallestDepth * distances->GetSpacing()[0])
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

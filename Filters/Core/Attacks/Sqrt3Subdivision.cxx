// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Attacks/Sqrt3Subdivision.h"

#include "Core/Mesh/EdgeTopology.h"
#include "Core/Mesh/UmbrellaSmoothing.h"

#include <array>
#include <cmath>
#include <vector>

namespace spectralwatermark
{

namespace
{

TriangleMesh SubdivideOnce(const TriangleMesh& mesh)
{
  const EdgeTopology topology(mesh);
  const Index n = mesh.NumberOfVertices();
  TriangleMesh fine;
  fine.Points.resize(n + mesh.NumberOfTriangles(), 3);
  fine.Points.topRows(n) =
    UmbrellaSmoothing(topology, n)
      .Apply(mesh.Points,
        [](double valence) { return (4.0 - 2.0 * std::cos(2.0 * Pi / valence)) / 9.0; });
  std::vector<std::array<Index, 3>> triangles;
  for (Index t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    const auto corners = mesh.Triangles.row(t);
    const Index middle = n + t;
    fine.Points.row(middle) =
      (mesh.Points.row(corners[0]) + mesh.Points.row(corners[1]) + mesh.Points.row(corners[2])) /
      3.0;
    for (int corner = 0; corner < 3; ++corner)
    {
      const Index a = corners[corner];
      const Index b = corners[(corner + 1) % 3];
      const EdgeTopology::Sides both = topology.TrianglesBetween(a, b);
      if (both.size() != 2)
      {
        triangles.push_back({ a, b, middle });
        continue;
      }
      // The two triangles across the flipped edge are added once, by the first of its two sides.
      if (both[0] == t)
      {
        triangles.push_back({ a, n + both[1], middle });
        triangles.push_back({ n + both[1], b, middle });
      }
    }
  }
  fine.Triangles = ToTriangleMatrix(triangles);
  return fine;
}

} // namespace

TriangleMesh SubdivideSqrt3(const TriangleMesh& mesh, int times, const Progress& progress)
{
  TriangleMesh fine = mesh;
  for (int k = 0; k < times; ++k)
  {
    fine = SubdivideOnce(fine);
    progress.Report(static_cast<double>(k + 1) / times);
  }
  return fine;
}

} // namespace spectralwatermark

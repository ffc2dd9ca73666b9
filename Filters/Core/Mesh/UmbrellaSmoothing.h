// SPDX-License-Identifier: BSD-3-Clause
/// Laplacian smoothing of a mesh.
#ifndef SpectralWatermark_Core_Mesh_UmbrellaSmoothing_h
#define SpectralWatermark_Core_Mesh_UmbrellaSmoothing_h

#include "Core/Mesh/EdgeTopology.h"

#include <functional>
#include <vector>

namespace spectralwatermark
{

/// Smoothing by the umbrella operator, which moves each vertex v to
/// v + factor * (mean of v's neighbours - v), all vertices at once. Vertices of edges that do not
/// have exactly two triangles stay fixed.
class UmbrellaSmoothing
{
public:
  explicit UmbrellaSmoothing(const TriangleMesh& mesh);
  UmbrellaSmoothing(const EdgeTopology& topology, Index vertices);

  /// Smooths points, a row for each vertex, with the same factor everywhere.
  TriangleMesh::PointMatrix Apply(const TriangleMesh::PointMatrix& points, double factor) const;

  /// Smooths points with a factor that depends on the vertex's number of neighbours.
  TriangleMesh::PointMatrix Apply(const TriangleMesh::PointMatrix& points,
    const std::function<double(double valence)>& factor) const;

private:
  std::vector<std::vector<Index>> Neighbours; // empty for fixed vertices
};

} // namespace spectralwatermark

#endif

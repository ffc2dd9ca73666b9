// SPDX-License-Identifier: BSD-3-Clause
#ifndef SpectralWatermark_Core_Mesh_UmbrellaSmoothing_h
#define SpectralWatermark_Core_Mesh_UmbrellaSmoothing_h

#include "Core/Mesh/EdgeTopology.h"

#include <functional>
#include <vector>

namespace spectralwatermark
{

/// Smoothing by the umbrella operator: v + factor * (mean of v's neighbours - v), all vertices at once.
/// Vertices of edges that do not have two triangles stay where they are.
class UmbrellaSmoothing
{
public:
  explicit UmbrellaSmoothing(const TriangleMesh& mesh);
  UmbrellaSmoothing(const EdgeTopology& topology, Index vertices);

  TriangleMesh::PointMatrix Apply(const TriangleMesh::PointMatrix& points, double factor) const;

  /// The same with a factor that depends on the vertex's number of neighbours.
  TriangleMesh::PointMatrix Apply(const TriangleMesh::PointMatrix& points,
    const std::function<double(double valence)>& factor) const;

private:
  std::vector<std::vector<Index>> Neighbours; // none of vertices that stay
};

} // namespace spectralwatermark

#endif

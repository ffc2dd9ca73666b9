// SPDX-License-Identifier: BSD-3-Clause
#ifndef SpectralWatermark_Core_StoredMesh_h
#define SpectralWatermark_Core_StoredMesh_h

#include "TriangleMesh.h"

#include <functional>
#include <vector>

namespace spectralwatermark
{

/// What a reader finds once a mesh was stored with other points: these may be rounded, polygons are
/// triangulated by where their corners are by then, and vertices may have come together, or be used by no
/// triangle any more.
struct StoredMesh
{
  TriangleMesh Mesh;
  std::vector<Index> VertexOf;      ///< in Mesh, for each vertex that was stored; -1: none
  TriangleMesh::PointMatrix Points; ///< of the vertices that were stored, as stored

  /// From a row for each vertex of Mesh to one for each that was stored; 0 where there is none.
  TriangleMesh::PointMatrix ToStored(const TriangleMesh::PointMatrix& rows) const;
};

/// Stores a mesh with these points, a row for each of its vertices, and reads it again.
using Storage = std::function<StoredMesh(const TriangleMesh::PointMatrix& points)>;

/// Keeps all of the mesh but its points, which it does not round.
Storage ExactStorage(const TriangleMesh& mesh);

} // namespace spectralwatermark

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef SpectralWatermark_Core_Mesh_RoundTrip_h
#define SpectralWatermark_Core_Mesh_RoundTrip_h

#include "Core/Mesh/TriangleMesh.h"
#include "Core/Support/Errors.h"

#include <functional>
#include <string>
#include <vector>

namespace spectralwatermark
{

/// What a reader finds once a mesh was stored with other points: these may be rounded, polygons are
/// triangulated by where their corners are by then, and vertices may have come together, or be used by no
/// triangle any more. Where polygons could not be triangulated before, vertices may come in.
struct RoundTripResult
{
  TriangleMesh Mesh;
  std::vector<Index> VertexOf;      ///< in Mesh, for each vertex that was stored; -1: none
  TriangleMesh::PointMatrix Points; ///< of the vertices that were stored, as stored

  /// From a row for each vertex of Mesh to one for each that was stored; 0 where there is none.
  TriangleMesh::PointMatrix ToStored(const TriangleMesh::PointMatrix& rows) const;
};

/// Stores a mesh with these points, a row for each of its vertices, and reads it again.
using RoundTrip = std::function<RoundTripResult(const TriangleMesh::PointMatrix& points)>;

/// Keeps all of the mesh, which must outlive it, but its points, and does not round these.
RoundTrip ExactRoundTrip(const TriangleMesh& mesh);

/// Returns read(), what is read from a stored mesh. An InvalidInput by then says that storing is to blame.
template <typename Function>
auto ReadAfterRoundTrip(const Function& read)
{
  try
  {
    return read();
  }
  catch (const InvalidInput& refusal)
  {
    throw InvalidInput("",
      "once marked and rounded as its points are stored, the mesh cannot be read: " +
        refusal.Reason,
      "store double points, or move the model to the origin");
  }
}

} // namespace spectralwatermark

#endif

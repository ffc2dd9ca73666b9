// SPDX-License-Identifier: BSD-3-Clause
/// The changes that storing a mesh and reading it again make.
#ifndef SpectralWatermark_Core_Mesh_RoundTrip_h
#define SpectralWatermark_Core_Mesh_RoundTrip_h

#include "Core/Mesh/TriangleMesh.h"
#include "Core/Support/Errors.h"

#include <functional>
#include <string>
#include <vector>

namespace spectralwatermark
{

/// The mesh that is read after a mesh was stored with other points. Points may be rounded, and
/// polygons are triangulated according to the new positions of their corners. Vertices may coincide
/// and be merged, or be used by no triangle any more. Where a polygon could not be triangulated
/// before, vertices may be added.
struct RoundTripResult
{
  TriangleMesh Mesh;                ///< the mesh that is read
  std::vector<Index> VertexOf;      ///< the vertex in Mesh of each stored vertex; -1: none
  TriangleMesh::PointMatrix Points; ///< the stored vertices' points after rounding

  /// Converts a row for each vertex of Mesh to a row for each stored vertex; 0 where there is none.
  TriangleMesh::PointMatrix ToStored(const TriangleMesh::PointMatrix& rows) const;
};

/// Stores a mesh with these points, a row for each of its vertices, and reads it again. The mesh is
/// part of the function.
using RoundTrip = std::function<RoundTripResult(const TriangleMesh::PointMatrix& points)>;

/// A round trip that changes nothing but the points, and does not round them. The mesh must outlive
/// it.
RoundTrip ExactRoundTrip(const TriangleMesh& mesh);

/// Returns read(), which reads from a stored mesh. The message of an InvalidInput that it throws is
/// extended to say that storing made the mesh unreadable.
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

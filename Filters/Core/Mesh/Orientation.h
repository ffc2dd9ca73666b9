// SPDX-License-Identifier: BSD-3-Clause
/// Consistent orientation of a mesh.
#ifndef SpectralWatermark_Core_Mesh_Orientation_h
#define SpectralWatermark_Core_Mesh_Orientation_h

#include "Core/Mesh/TriangleMesh.h"

namespace spectralwatermark
{

/// Orients the triangles of every component consistently, such that the component encloses a volume
/// that is not negative. Only edges with exactly two triangles pass an orientation on. File formats
/// and tools lose orientations, and integrals over the interior need them.
TriangleMesh Oriented(const TriangleMesh& mesh);

} // namespace spectralwatermark

#endif

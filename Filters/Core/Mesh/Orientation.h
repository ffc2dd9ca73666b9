// SPDX-License-Identifier: BSD-3-Clause
#ifndef SpectralWatermark_Core_Mesh_Orientation_h
#define SpectralWatermark_Core_Mesh_Orientation_h

#include "Core/Mesh/TriangleMesh.h"

namespace spectralwatermark
{

/// Orients the triangles of every component consistently, and so that the component encloses a volume that
/// is not negative, as far as edges with two triangles determine it. Formats and tools lose orientations;
/// integrals over the inside need them.
TriangleMesh Oriented(const TriangleMesh& mesh);

} // namespace spectralwatermark

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef SpectralWatermark_Core_Attacks_Sqrt3Subdivision_h
#define SpectralWatermark_Core_Attacks_Sqrt3Subdivision_h

#include "Core/Mesh/TriangleMesh.h"
#include "Core/Support/Progress.h"

namespace spectralwatermark
{

/// Kobbelt's subdivision ("√3-Subdivision", 2000): a vertex in the middle of every triangle, old
/// edges flipped, old vertices relaxed. Boundaries keep their edges and vertices, and so do edges
/// with more than two triangles.
TriangleMesh SubdivideSqrt3(const TriangleMesh& mesh, int times, const Progress& progress);

} // namespace spectralwatermark

#endif

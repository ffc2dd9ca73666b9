// SPDX-License-Identifier: BSD-3-Clause
/// Kobbelt's √3-subdivision of a triangle mesh.
#ifndef SpectralWatermark_Core_Attacks_Sqrt3Subdivision_h
#define SpectralWatermark_Core_Attacks_Sqrt3Subdivision_h

#include "Core/Mesh/TriangleMesh.h"
#include "Core/Support/Progress.h"

namespace spectralwatermark
{

/// Subdivides a mesh `times` times by L. Kobbelt's rule ("√3-Subdivision", 2000): a new vertex in
/// the middle of every triangle, old edges flipped, old vertices relaxed. Boundaries keep their
/// edges and vertices, and so do edges with more than two triangles. Throws Aborted.
TriangleMesh SubdivideSqrt3(const TriangleMesh& mesh, int times, const Progress& progress);

} // namespace spectralwatermark

#endif

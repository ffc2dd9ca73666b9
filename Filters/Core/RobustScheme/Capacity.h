// SPDX-License-Identifier: BSD-3-Clause
/// The number of bits that a mesh can carry in the robust scheme.
#ifndef SpectralWatermark_Core_RobustScheme_Capacity_h
#define SpectralWatermark_Core_RobustScheme_Capacity_h

#include "Core/Mesh/TriangleMesh.h"
#include "Core/Payload/SecretKey.h"
#include "Core/Support/Progress.h"

namespace spectralwatermark
{

/// The largest number of code words below `tooMany` that fit an oriented mesh, a distortion limit
/// (a fraction of the bounding-box diagonal) and the available memory; WordsOf(1) - 1 if not even
/// one bit fits. Found by embedding with the smallest step. Throws InvalidInput if the surface
/// encloses no volume.
Index MostWords(const TriangleMesh& oriented, const SecretKey& key, double maximumDistortion,
  Index tooMany, int threads, const Progress& progress);

/// A lower bound on the bits that EmbedRobust() can embed, up to LargestMessage; 0 if even one may
/// not fit. The bound keeps a reserve, because the cost varies between messages. A mark of this
/// size uses the smallest step and is fragile. `maximumDistortion` is a fraction of the
/// bounding-box diagonal. Takes as long as several embeddings of up to that many bits. Throws
/// InvalidInput if the surface encloses no volume.
Index CapacityOf(const TriangleMesh& mesh, const SecretKey& key, double maximumDistortion,
  int threads, const Progress& progress);

} // namespace spectralwatermark

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef SpectralWatermark_Core_RobustScheme_Capacity_h
#define SpectralWatermark_Core_RobustScheme_Capacity_h

#include "Core/Mesh/TriangleMesh.h"
#include "Core/Payload/SecretKey.h"
#include "Core/Support/Progress.h"

namespace spectralwatermark
{

/// The number of code words, under `tooMany`, that fit an oriented mesh, a budget of distortion (parts of
/// the diagonal) and the available memory, found by embedding with the smallest step.
Index MostWords(const TriangleMesh& oriented, const SecretKey& key, double maximumDistortion,
  Index tooMany, int threads, const Progress& progress);

/// A lower bound on the bits that EmbedRobust() can embed, up to LargestMessage; 0 if even one may not fit.
/// The bound keeps a reserve, because the cost varies between messages. A mark of this size uses the
/// smallest step and is fragile. Takes as long as several embeddings of up to that many bits.
Index CapacityOf(const TriangleMesh& mesh, const SecretKey& key, double maximumDistortion,
  int threads, const Progress& progress);

} // namespace spectralwatermark

#endif

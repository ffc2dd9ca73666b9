// SPDX-License-Identifier: BSD-3-Clause
/// The paper's iterative embedding (2.3): embed, look with the new mesh's own basis, repeat.
#ifndef SpectralWatermark_Core_PaperScheme_SlotEmbedding_h
#define SpectralWatermark_Core_PaperScheme_SlotEmbedding_h

#include "Core/Harmonics/ManifoldHarmonics.h"
#include "Core/Mesh/RoundTrip.h"
#include "Core/PaperScheme/Slots.h"
#include "Core/Support/Progress.h"

#include <functional>

namespace spectralwatermark
{

struct SlotEmbeddingOptions
{
  SlotOptions Slots;
  std::string Message;    ///< bits to embed, of 0 and 1
  Index RequiredBits = 0; ///< the extraction threshold: stop with that many right; 0: all
  Index MaximumIterations = 20;
  double Tolerance = 1e-8; ///< of the harmonics
  int Threads = 1;         ///< at most; the result does not depend on it
  RoundTrip Store;         ///< what bits are read from; by default ExactRoundTrip()
};

struct SlotEmbeddingResult
{
  TriangleMesh::PointMatrix Points;              ///< the marked mesh's, as stored
  std::string ExtractedMessage;                  ///< what it reads, blind
  bool Converged = false;                        ///< at least RequiredBits bits are right
  Index Iterations = 0;                          ///< of the points returned
  Index Eigensolves = 0;                         ///< bases computed
  std::vector<std::vector<SlotReading>> History; ///< per iteration; [0]: before embedding
};

/// Embeds the message into a copy of the points. The first basis may be given; every later one
/// is computed. Not converged: the points that read the most bits right, the earliest of them.
///
/// Throws InvalidInput when the mesh cannot carry the message, SolverFailure, Aborted.
SlotEmbeddingResult EmbedMessageInSlots(const TriangleMesh& mesh,
  const SlotEmbeddingOptions& options, const std::optional<ManifoldHarmonics>& firstBasis,
  const Progress& progress = Progress());

} // namespace spectralwatermark

#endif

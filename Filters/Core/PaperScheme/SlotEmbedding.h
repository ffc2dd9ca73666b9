// SPDX-License-Identifier: BSD-3-Clause
/// The paper's iterative embedding (2.3): embed the bits, read them with the marked mesh's own
/// basis, repeat.
#ifndef SpectralWatermark_Core_PaperScheme_SlotEmbedding_h
#define SpectralWatermark_Core_PaperScheme_SlotEmbedding_h

#include "Core/Harmonics/ManifoldHarmonics.h"
#include "Core/Mesh/RoundTrip.h"
#include "Core/PaperScheme/Slots.h"
#include "Core/Support/Progress.h"

#include <functional>

namespace spectralwatermark
{

/// What EmbedMessageInSlots() embeds, and how.
struct SlotEmbeddingOptions
{
  SlotOptions Slots;

  /// The bits to embed, as characters 0 and 1.
  std::string Message;

  /// The extraction threshold: the embedding stops once this many bits are right. 0: all.
  Index RequiredBits = 0;

  /// The largest number of iterations.
  Index MaximumIterations = 20;

  /// The tolerance of the harmonics (see HarmonicsOptions).
  double Tolerance = 1e-8;

  /// The largest number of threads. The result does not depend on it.
  int Threads = 1;

  /// Stores the marked points and reads the mesh again; the bits are read from that mesh. Empty:
  /// ExactRoundTrip().
  RoundTrip Store;
};

/// What EmbedMessageInSlots() achieved.
struct SlotEmbeddingResult
{
  TriangleMesh::PointMatrix Points; ///< the points of the marked mesh, as stored
  std::string ExtractedMessage;     ///< the message that was read blind from it
  bool Converged = false;           ///< whether at least RequiredBits bits are right
  Index Iterations = 0;             ///< the number of iterations that led to Points
  Index Eigensolves = 0;            ///< the number of bases computed

  /// The readings of all slots before the embedding and after each iteration.
  std::vector<std::vector<SlotReading>> History;
};

/// Embeds a message. `firstBasis` is the basis of the unmarked mesh, if it is available; all later
/// bases are computed. Without convergence the result is the iteration that read the most bits
/// right, the earliest of several.
///
/// Throws InvalidInput if the mesh cannot carry the message or the memory does not suffice,
/// SolverFailure, Aborted.
SlotEmbeddingResult EmbedMessageInSlots(const TriangleMesh& mesh,
  const SlotEmbeddingOptions& options, const std::optional<ManifoldHarmonics>& firstBasis,
  const Progress& progress = Progress());

} // namespace spectralwatermark

#endif

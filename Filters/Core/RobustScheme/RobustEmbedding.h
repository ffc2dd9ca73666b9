// SPDX-License-Identifier: BSD-3-Clause
/// The robust scheme: bits in the Fourier transform of the solid that a mesh encloses.
///
/// A carrier is the real or imaginary part of the transform at a wave vector that the secret decides,
/// in the solid's own frame (FrameOf()). It belongs to the solid, not to its triangles: another
/// triangulation changes nothing, noise averages out over the whole surface, and moving the surface
/// along its normals by h changes it by the integral of h cos(k . x) (or sin), nearly linearly.
///
/// Bits are embedded by quantisation index modulation with a secret dither (Chen and Wornell, 2001):
/// a carrier's value is moved to the nearest point of step (Z + (bit + whitening) / 2 + dither). For
/// a mesh without the mark, or under another key, every bit that is read is therefore a fair coin
/// of the key, independent of all others, whatever the mesh.
///
/// The message is followed by a check derived from it and the secret, and both are protected by the
/// extended Golay code. RobustReader.h reads them.
#ifndef SpectralWatermark_Core_RobustScheme_RobustEmbedding_h
#define SpectralWatermark_Core_RobustScheme_RobustEmbedding_h

#include "Core/Mesh/RoundTrip.h"
#include "Core/Payload/SecretKey.h"
#include "Core/RobustScheme/SurfaceMotion.h"
#include "Core/Support/Progress.h"

#include <string>
#include <vector>

namespace spectralwatermark
{

struct RobustEmbeddingOptions
{
  std::string Message;
  double MaximumDistortion =
    0.0007; ///< root mean square of the displacement, parts of the diagonal
  int Threads = 1;
  RoundTrip Store; ///< what is verified, at the end; by default ExactRoundTrip()
};

struct RobustEmbeddingResult
{
  TriangleMesh::PointMatrix Points;         ///< as stored
  std::vector<RobustEmbeddingRound> Rounds; ///< the first is the mesh as it was
  double Distortion = 0.0;
  double Step = 0.0;
  double Margin = 0.0; ///< the least of all carriers: 1 in the middle of its cell, 0 at the border
  std::string ExtractedMessage; ///< read blind from what was stored
  bool Converged = false;       ///< and it is the message, and its check holds
};

/// Throws InvalidInput when the message does not fit the budget (it says what would) or the work does
/// not fit into memory.
RobustEmbeddingResult EmbedRobust(const TriangleMesh& mesh, const SecretKey& key,
  const RobustEmbeddingOptions& options, const Progress& progress);

} // namespace spectralwatermark

#endif

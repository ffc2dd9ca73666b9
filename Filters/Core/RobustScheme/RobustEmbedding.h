// SPDX-License-Identifier: BSD-3-Clause
/// The robust scheme, which hides bits in the Fourier transform of the solid that a mesh encloses.
///
/// A carrier is the real or imaginary part of the transform at a wave vector that the secret key
/// determines, in the solid's own frame (FrameOf()). It belongs to the solid and not to its
/// triangles: another triangulation changes nothing, and noise averages out over the whole surface.
/// Moving the surface along its normals by h changes a carrier by the integral of h cos(k . x), or
/// of h sin(k . x), nearly linearly.
///
/// Bits are embedded by quantisation index modulation with a secret dither (Chen and Wornell,
/// 2001): the value of a carrier moves to the nearest point of step (Z + (bit + whitening) / 2 +
/// dither). In a mesh without the mark, or under another key, every bit that is read is therefore a
/// fair coin of the key, independent of all others, whatever the mesh.
///
/// The message is followed by a check derived from it and the secret key, and the extended Golay
/// code protects both. RobustReader.h reads them.
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

/// What EmbedRobust() embeds, and how.
struct RobustEmbeddingOptions
{
  /// The bits to embed: 1 to LargestMessage characters 0 and 1.
  std::string Message;

  /// The largest root mean square displacement of the surface, as a fraction of the bounding-box
  /// diagonal.
  double MaximumDistortion = 0.0007;

  /// The largest number of threads. The result does not depend on it.
  int Threads = 1;

  /// Stores the marked points and reads the mesh again; that mesh is then verified. Empty:
  /// ExactRoundTrip().
  RoundTrip Store;
};

/// What EmbedRobust() achieved.
struct RobustEmbeddingResult
{
  /// The points of the marked mesh, as stored.
  TriangleMesh::PointMatrix Points;

  /// The rounds of the embedding; the first is the mesh before it.
  std::vector<RobustEmbeddingRound> Rounds;

  /// The root mean square displacement of the stored surface, as a fraction of the bounding-box
  /// diagonal.
  double Distortion = 0.0;

  /// The quantisation step, in (scale of the frame)^3.
  double Step = 0.0;

  /// The smallest margin of all carriers: 1 in the middle of its cell, 0 at the border to the other
  /// bit.
  double Margin = 0.0;

  /// The message that was read blind from the stored mesh.
  std::string ExtractedMessage;

  /// Whether the message was read back right, its check holds, and the distortion is within the
  /// limit.
  bool Converged = false;
};

/// Embeds a message with the largest step that the distortion limit allows, and reads it back from
/// the stored mesh. Throws InvalidInput if the message does not fit the limit (the error says how
/// many bits would), the work does not fit into memory, or the surface encloses no volume.
RobustEmbeddingResult EmbedRobust(const TriangleMesh& mesh, const SecretKey& key,
  const RobustEmbeddingOptions& options, const Progress& progress);

} // namespace spectralwatermark

#endif

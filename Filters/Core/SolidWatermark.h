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
/// extended Golay code. SolidReader.h reads them.
#ifndef SpectralWatermark_Core_SolidWatermark_h
#define SpectralWatermark_Core_SolidWatermark_h

#include "Progress.h"
#include "SolidCarriers.h"
#include "StoredMesh.h"

#include <string>
#include <vector>

namespace spectralwatermark
{

struct SolidEmbeddingOptions
{
  std::string Message;
  double MaximumDistortion =
    0.0007; ///< root mean square of the displacement, parts of the diagonal
  int Threads = 1;
  Storage Store; ///< what is verified, at the end; by default ExactStorage()
};

struct SolidEmbeddingRound
{
  double Distortion = 0.0;   ///< as above, so far
  double LargestError = 0.0; ///< of a carrier, in steps, not yet stored
};

struct SolidEmbeddingResult
{
  TriangleMesh::PointMatrix Points;        ///< as stored
  std::vector<SolidEmbeddingRound> Rounds; ///< the first is the mesh as it was
  double Distortion = 0.0;
  double Step = 0.0;
  double Margin = 0.0; ///< the least of all carriers: 1 in the middle of its cell, 0 at the border
  std::string ExtractedMessage; ///< read blind from what was stored
  bool Converged = false;       ///< and it is the message, and its check holds
};

/// Throws InvalidInput when the message does not fit the budget (it says what would) or the work does
/// not fit into memory.
SolidEmbeddingResult EmbedInSolid(const TriangleMesh& mesh, const SecretKey& key,
  const SolidEmbeddingOptions& options, const Progress& progress);

/// How many bits EmbedInSolid() takes at least, in the memory that there is, up to LargestMessage; 0 when
/// a message may not fit at all. Some are left for what a message costs more or less than another. So many
/// are embedded with the smallest step and survive little. Takes as long as several embeddings, of up to
/// that many bits.
Index CapacityOf(const TriangleMesh& mesh, const SecretKey& key, double maximumDistortion,
  int threads, const Progress& progress);

} // namespace spectralwatermark

#endif

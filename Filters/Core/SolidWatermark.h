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
#include "SecretKey.h"
#include "TriangleMesh.h"

#include <string>
#include <vector>

namespace spectralwatermark
{

/// What a secret and a number of bits decide.
struct Carriers
{
  Eigen::MatrixXd Waves;  ///< wave vectors, a row each, in 1 / scale of the frame
  Eigen::VectorXd Dither; ///< of each carrier, in [0, 1) steps
  std::string Whitening;  ///< of each carrier, 0 or 1
  Index MessageBits = 0;
  Index CheckBits = 0;

  Index Count() const { return this->Dither.size(); }
};

/// For messages of 1 to LargestMessage bits. Throws InvalidInput for others.
Carriers CarriersOf(const SecretKey& key, Index messageBits);
constexpr Index LargestMessage = 1024;

/// The message and its check: what the code protects.
std::string DataOf(const std::string& message, const SecretKey& key, const Carriers& carriers);

/// What the carriers hold for data, 12 bits of it a word. Bit i of word b sits in carrier i * words + b,
/// so that what happens to some waves is spread over all words.
std::string CodeOf(const std::string& data);

/// Steps that carriers are quantised with, in units of (scale of the frame)^3: a geometric series,
/// so that a reader can try them all.
constexpr int NumberOfSteps = 80;
double StepOfNumber(int number);

struct SolidEmbeddingOptions
{
  std::string Message;
  double MaximumDistortion =
    0.0007; ///< root mean square of the displacement, parts of the diagonal
  int Threads = 1;
  bool RoundToFloat = false; ///< what is verified are the points as stored
};

struct SolidEmbeddingRound
{
  double Distortion = 0.0;   ///< as above, so far
  double LargestError = 0.0; ///< of a carrier, in steps
};

struct SolidEmbeddingResult
{
  TriangleMesh::PointMatrix Points;
  std::vector<SolidEmbeddingRound> Rounds; ///< the first is the mesh as it was
  double Distortion = 0.0;
  double Step = 0.0;
  double Margin = 0.0; ///< the least of all carriers: 1 in the middle of its cell, 0 at the border
  std::string ExtractedMessage; ///< read blind from Points
  bool Converged = false;       ///< and it is the message, and its check holds
};

/// Throws InvalidInput when the message does not fit the budget; says what would.
SolidEmbeddingResult EmbedInSolid(const TriangleMesh& mesh, const SecretKey& key,
  const SolidEmbeddingOptions& options, const Progress& progress);

/// How many bits EmbedInSolid() takes at least, up to LargestMessage; 0 when a message may not fit at
/// all. Some are left for what a message costs more or less than another. So many are embedded with the
/// smallest step and survive little. Takes as long as several embeddings, of up to that many bits.
Index CapacityOf(const TriangleMesh& mesh, const SecretKey& key, double maximumDistortion,
  int threads, const Progress& progress);

} // namespace spectralwatermark

#endif

// SPDX-License-Identifier: BSD-3-Clause
/// Reads the marks of the robust scheme (RobustEmbedding.h) from the mesh and the secret key alone.
///
/// The reader does not know the quantisation step, the signs of the frame's axes where they are
/// unclear, how often the mesh was smoothed, and how attacks changed the frame. It tries
/// combinations of the first three until one fits the code clearly, and keeps the best. If none
/// fits clearly, it also aligns the frame by small changes (FrameAlignment.h).
///
/// None of this depends on the message. Inverting the whitening bits where a code word has ones
/// adds that code word to what is read, and changes nothing else. Since the whitening is a
/// keystream, the data read from an unmarked mesh (or from one marked under another key) is
/// therefore uniform over all data, whatever was tried, and the number of bits that agree with
/// expected data is exactly binomial.
#ifndef SpectralWatermark_Core_RobustScheme_RobustReader_h
#define SpectralWatermark_Core_RobustScheme_RobustReader_h

#include "Core/Mesh/TriangleMesh.h"
#include "Core/Payload/SecretKey.h"
#include "Core/RobustScheme/CarrierSet.h"
#include "Core/Support/Progress.h"

#include <string>

namespace spectralwatermark
{

/// The assumptions under which a mesh was read.
struct ReadingHypothesis
{
  int Smoothing = 0; ///< number of iterations of the benchmark's smoothing that were undone
  int Turn = 0;      ///< half-turn of the frame (see RotatedByPi())
  int Step = 0;      ///< number of the quantisation step (see StepOfNumber())
};

/// What was read from a mesh.
struct RobustReading
{
  ReadingHypothesis Hypothesis;

  /// The value of each carrier, in (scale of the frame)^3.
  Eigen::VectorXd Values;

  /// The soft bit of each carrier, from 1 (certainly 0) to -1 (certainly 1), without the whitening.
  Eigen::VectorXd Soft;

  /// How well the carriers match the nearest code words, at most 1 (every carrier on a lattice
  /// point), less the cost of the frame's alignment.
  double Fit = 0.0;

  /// The decoded data: the message and its check.
  std::string Data;

  /// The decoded message. Empty after ReadCarriers().
  std::string Message;

  /// Whether the check of the message holds. False after ReadCarriers().
  bool IsValid = false;
};

/// Reads the carriers without testing the check. Throws InvalidInput if the mesh has no frame (see
/// FrameOf()).
RobustReading ReadCarriers(const TriangleMesh& mesh, const CarrierSet& carriers, int threads,
  const Progress& progress);

/// Reads a message of this length under a key, and tests its check. Throws InvalidInput like
/// CarriersOf() and ReadCarriers().
RobustReading ReadRobust(const TriangleMesh& mesh, const SecretKey& key, Index messageBits,
  int threads, const Progress& progress);

/// The same with carriers that CarriersOf() has already made from that key.
RobustReading ReadRobust(const TriangleMesh& mesh, const SecretKey& key, const CarrierSet& carriers,
  int threads, const Progress& progress);

/// The p-value of a reading: the probability that the data of an unmarked mesh agrees with
/// `expectedData` in at least as many bits as this reading does. It is the tail of a binomial
/// distribution over the bits of message and check.
double PValueOf(const RobustReading& reading, const std::string& expectedData);

} // namespace spectralwatermark

#endif

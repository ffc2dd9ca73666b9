// SPDX-License-Identifier: BSD-3-Clause
/// Reads what RobustEmbedding.h embeds, from the mesh and the key alone.
///
/// Unknown are the step, the signs of the frame's axes where they are unclear, how often the mesh was
/// smoothed, and what attacks did to the frame. Every combination of the first three is tried, and the
/// one that fits the code best is taken; where none fits well, the frame is moved a little until one
/// does. Nothing of this knows the message: turning the whitening of a code word's carriers turns what
/// is read by that word, and changes nothing else. With a keystream for whitening, what an unmarked mesh
/// (or one marked under another key) reads is therefore uniform over all data, whatever was tried, and
/// agreement with expected data is exactly binomial.
#ifndef SpectralWatermark_Core_RobustScheme_RobustReader_h
#define SpectralWatermark_Core_RobustScheme_RobustReader_h

#include "Core/Mesh/TriangleMesh.h"
#include "Core/Payload/SecretKey.h"
#include "Core/RobustScheme/CarrierSet.h"
#include "Core/Support/Progress.h"

namespace spectralwatermark
{

/// How a mesh was read.
struct ReadingHypothesis
{
  int Smoothing = 0; ///< iterations of the benchmark's smoothing that were undone first
  int Turn = 0;      ///< of the frame
  int Step = 0;      ///< number of the step
};

struct RobustReading
{
  ReadingHypothesis Hypothesis;
  Eigen::VectorXd Values; ///< of the carriers
  Eigen::VectorXd Soft;   ///< from 1 (surely 0) to -1 (surely 1), whitening removed
  double Fit = 0.0; ///< of the code's nearest words, to 1 (every carrier on its point); less what
                    ///< the frame's alignment cost
  std::string Data; ///< what the code holds: message and check
  std::string Message;
  bool IsValid = false; ///< the check holds
};

/// Without a look at the check: of nothing but the carriers. Throws InvalidInput for a mesh that has no
/// frame.
RobustReading ReadCarriers(const TriangleMesh& mesh, const CarrierSet& carriers, int threads,
  const Progress& progress);

/// The same under a key, with the message and whether its check holds.
RobustReading ReadRobust(const TriangleMesh& mesh, const SecretKey& key, Index messageBits,
  int threads, const Progress& progress);

/// The same with the carriers of that key.
RobustReading ReadRobust(const TriangleMesh& mesh, const SecretKey& key, const CarrierSet& carriers,
  int threads, const Progress& progress);

/// The probability that data of an unmarked mesh agrees with `expected` in as many bits as this
/// reading does, or more: the tail of a binomial distribution over message and check.
double PValueOf(const RobustReading& reading, const std::string& expectedData);

} // namespace spectralwatermark

#endif

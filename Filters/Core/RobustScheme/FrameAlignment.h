// SPDX-License-Identifier: BSD-3-Clause
/// Alignment of carriers whose frame is slightly off, by the code that they hold.
#ifndef SpectralWatermark_Core_RobustScheme_FrameAlignment_h
#define SpectralWatermark_Core_RobustScheme_FrameAlignment_h

#include "Core/Mesh/TriangleMesh.h"
#include "Core/RobustScheme/CarrierSet.h"

namespace spectralwatermark
{

/// Soft bits of carriers, from 1 (surely 0) to -1 (surely 1), without the whitening.
Eigen::VectorXd SoftBits(const Eigen::VectorXd& values, const CarrierSet& carriers, double step);

/// What the code holds that fits best; `fit` becomes how well, from 0 to 1. Interleaved as in CodeOf().
std::string Decode(const Eigen::VectorXd& soft, double& fit);

/// How the carriers change when the frame does: a column for each of its seven freedoms (three
/// translations, three rotations, scale), to first order, each scaled to a root mean square of 1.
/// `values` are the carriers'.
Eigen::MatrixXd FrameResponse(const TriangleMesh& inFrame, const Eigen::VectorXd& values,
  const CarrierSet& carriers, int threads);

/// Values after a change of frame, and what that change cost, in fit: a search that is free to go far
/// finds what fits by chance.
struct Alignment
{
  Eigen::VectorXd Values;
  double Cost = 0.0;
};

/// After the change that lets the values fit the code best, its cost taken off: a pattern search from
/// no change, then least squares on the lattice points that were decided for. Changes move carriers by
/// half a step or so, no more.
Alignment Align(const Eigen::VectorXd& values, const Eigen::MatrixXd& response,
  const CarrierSet& carriers, double step);

} // namespace spectralwatermark

#endif

// SPDX-License-Identifier: BSD-3-Clause
/// Aligns carriers that were read in a slightly wrong frame, by means of the code that they hold.
#ifndef SpectralWatermark_Core_RobustScheme_FrameAlignment_h
#define SpectralWatermark_Core_RobustScheme_FrameAlignment_h

#include "Core/Mesh/TriangleMesh.h"
#include "Core/RobustScheme/CarrierSet.h"

namespace spectralwatermark
{

/// The soft bits of carriers quantised with this step, from 1 (certainly 0) to -1 (certainly 1).
/// The whitening is undone.
Eigen::VectorXd SoftBits(const Eigen::VectorXd& values, const CarrierSet& carriers, double step);

/// Decodes the best-fitting data, interleaved as in CodeOf(); sets `fit` to the quality of the
/// match, in [0, 1].
std::string Decode(const Eigen::VectorXd& soft, double& fit);

/// How the carriers change with the frame, to first order: a column for each of its seven degrees
/// of freedom (three translations, three rotations and the scale), scaled to a root mean square of
/// 1. `inFrame` is the mesh in its frame, and `values` are the carrier values there.
Eigen::MatrixXd FrameResponse(const TriangleMesh& inFrame, const Eigen::VectorXd& values,
  const CarrierSet& carriers, int threads);

/// The carrier values after a change of the frame. A change has a cost, because a search that may
/// go far finds a good fit by chance.
struct Alignment
{
  Eigen::VectorXd Values;
  double Cost = 0.0; ///< the cost of the change, to be subtracted from the fit
};

/// Changes the frame such that the carriers fit the code best, with the cost of the change taken
/// into account: a pattern search that starts from no change, then least squares on the lattice
/// points that were decided for. A change moves the carriers by about half a step at most.
Alignment Align(const Eigen::VectorXd& values, const Eigen::MatrixXd& response,
  const CarrierSet& carriers, double step);

} // namespace spectralwatermark

#endif

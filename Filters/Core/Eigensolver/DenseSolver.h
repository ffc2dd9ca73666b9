// SPDX-License-Identifier: BSD-3-Clause
/// The dense eigensolver.
#ifndef SpectralWatermark_Core_Eigensolver_DenseSolver_h
#define SpectralWatermark_Core_Eigensolver_DenseSolver_h

#include "Core/Eigensolver/Eigensolver.h"
#include "Core/Support/Progress.h"

namespace spectralwatermark
{

/// Computes the whole spectrum at once with Eigen's dense solver: for small problems, or when most
/// of the spectrum is wanted. It takes O(n^3) time and O(n^2) memory, and can only be aborted
/// before it starts and when it is done.
class DenseSolver : public Eigensolver
{
public:
  EigenPairs Solve(const EigenProblem& problem, const EigensolverOptions& options,
    const Progress& progress) const override;
};

} // namespace spectralwatermark

#endif

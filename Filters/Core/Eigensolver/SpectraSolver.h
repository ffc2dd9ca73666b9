// SPDX-License-Identifier: BSD-3-Clause
/// The eigensolver on the library Spectra.
#ifndef SpectralWatermark_Core_Eigensolver_SpectraSolver_h
#define SpectralWatermark_Core_Eigensolver_SpectraSolver_h

#include "Core/Eigensolver/Eigensolver.h"
#include "Core/Support/Progress.h"

namespace spectralwatermark
{

/// Shift-invert Lanczos with restarts, one vector at a time (Spectra), band by band, on Eigen's
/// sparse LDL^T factorisation. It is slower than BlockLanczosSolver and serves as a reference.
///
/// The result is deterministic: starting vectors are fixed, and there is one thread.
class SpectraSolver : public Eigensolver
{
public:
  EigenPairs Solve(const EigenProblem& problem, const EigensolverOptions& options,
    const Progress& progress) const override;
};

} // namespace spectralwatermark

#endif

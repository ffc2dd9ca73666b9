// SPDX-License-Identifier: BSD-3-Clause
#ifndef SpectralWatermark_Core_SpectraEigensolver_h
#define SpectralWatermark_Core_SpectraEigensolver_h

#include "Eigensolver.h"

namespace spectralwatermark
{

/// Shift-invert Lanczos (Spectra) band by band, as in Vallet and Levy, "Spectral Geometry
/// Processing with Manifold Harmonics" (2008), on Eigen's sparse LDL^T factorisation.
///
/// Bands are cut where the spectrum has a gap, and the eigenvalues of a band are counted by
/// Sylvester's law of inertia at both of its cuts, so that a multiple eigenvalue is neither lost
/// nor repeated: what a Lanczos run misses is looked for again, with all that was found
/// projected out, until the count is right.
///
/// Deterministic: fixed starting vectors, one thread.
class SpectraEigensolver : public Eigensolver
{
public:
  EigenPairs Solve(const EigenProblem& problem, const EigensolverOptions& options,
    const Progress& progress) const override;
};

} // namespace spectralwatermark

#endif

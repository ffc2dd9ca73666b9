// SPDX-License-Identifier: BSD-3-Clause
/// The block Lanczos eigensolver.
#ifndef SpectralWatermark_Core_Eigensolver_BlockLanczos_h
#define SpectralWatermark_Core_Eigensolver_BlockLanczos_h

#include "Core/Eigensolver/Eigensolver.h"
#include "Core/Support/Progress.h"

namespace spectralwatermark
{

/// Shift-invert block Lanczos without restarts, band by band.
///
/// Blocks of eight vectors (MultiVector.h) share every pass over the factors and the Krylov basis,
/// where single-vector methods spend their time. They also find multiple eigenvalues at once. New
/// blocks are reorthogonalised against all others, two at a time, in the inner product of M. Ritz
/// vectors are refined by one inverse iteration, which removes the high frequencies that rounding
/// leaves in them.
///
/// G. H. Golub and R. Underwood, "The Block Lanczos Method for Computing Eigenvalues" (1977);
/// R. G. Grimes, J. G. Lewis and H. D. Simon, "A Shifted Block Lanczos Algorithm for Solving Sparse
/// Symmetric Generalized Eigenproblems" (1994).
///
/// The result is deterministic: starting blocks are fixed, and the order of sums does not depend on
/// the number of threads.
class BlockLanczosSolver : public Eigensolver
{
public:
  EigenPairs Solve(const EigenProblem& problem, const EigensolverOptions& options,
    const Progress& progress) const override;
};

} // namespace spectralwatermark

#endif

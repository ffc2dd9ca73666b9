// SPDX-License-Identifier: BSD-3-Clause
/// The spectrum band by band, as in Vallet and Levy, "Spectral Geometry Processing with Manifold
/// Harmonics" (2008), for any shift-invert solver.
#ifndef SpectralWatermark_Core_Eigensolver_SpectrumSlicing_h
#define SpectralWatermark_Core_Eigensolver_SpectrumSlicing_h

#include "Core/Eigensolver/Eigensolver.h"
#include "Core/LinearAlgebra/MultiVector.h"
#include "Core/Support/Progress.h"

#include <limits>
#include <vector>

namespace spectralwatermark
{

/// Some eigenpairs.
struct Band
{
  std::vector<double> Values;
  MultiVector Vectors;      ///< a column for each value, in the solver's order of rows
  bool Orthonormal = false; ///< M-orthonormal to the last digit already
  /// The next eigenvalue over them, as far as it is known: where a band may be cut.
  double NextValue = std::numeric_limits<double>::quiet_NaN();
};

/// What a solver must find around the shift that it was last given.
struct BandRequest
{
  Index Below = 0;         ///< eigenpairs under the shift, the nearest ones
  Index Above = 0;         ///< and over it,
  Index Window = 0;        ///< and up to so many more, so as to end before a gap
  bool AnySide = false;    ///< rather: Below + Above of them, on whichever side they are nearest
  MultiVector Locked;      ///< M-orthonormal vectors (or zeros) to keep out of: found already
  BlockVector Start;       ///< a guess: columns near the span of what is looked for, or empty
  double Tolerance = 1e-8; ///< relative residual
  int Attempt = 0;         ///< 0, then 1, 2, ... when something is still missing
};

/// One way to find eigenpairs near a shift.
class ShiftInvertSolver
{
public:
  virtual ~ShiftInvertSolver() = default;

  /// Harmonics per band when the caller leaves it open.
  virtual Index DefaultBandSize(Index wanted) const = 0;

  /// Whether the first shift may lie inside the spectrum; else it is under it.
  virtual bool FirstShiftInside() const = 0;

  /// Moves to another shift; returns how many eigenvalues lie under it (Sylvester's law of
  /// inertia). Throws SolverFailure when the factorisation breaks down, Aborted; reports no more
  /// than where `progress` begins.
  virtual Index Factorize(double shift, const Progress& progress) = 0;

  /// Whether solves with the last factorisation are as accurate as they should be.
  virtual bool IsAccurate() const { return true; }

  /// What was asked for, or as much of it as converged; more does not harm. At the first attempt,
  /// pairs whose residuals are over the tolerance are better left out: they are looked for again.
  virtual Band FindNearest(BandRequest request, const Progress& progress) = 0;

  /// The problem's matrices, and its rows, in the solver's order: row i here is row Order()[i].
  virtual const SparseMatrix& Stiffness() const = 0;
  virtual const SparseMatrix& Mass() const = 0;
  virtual const Eigen::VectorXi& Order() const = 0;
};

/// Solves the problem with bands that are cut where the spectrum has a gap. The eigenvalues of a
/// band are counted by inertia at both of its cuts, so that a multiple eigenvalue is neither lost
/// nor repeated: what a solver misses is looked for again, with all that was found locked, until
/// the count is right, or what it finds cannot be a spectrum.
EigenPairs SolveBySlicing(const EigenProblem& problem, const EigensolverOptions& options,
  ShiftInvertSolver& solver, const Progress& progress);

} // namespace spectralwatermark

#endif

// SPDX-License-Identifier: BSD-3-Clause
/// Spectrum slicing: computes the spectrum band by band with any shift-invert solver, as in Vallet
/// and Levy, "Spectral Geometry Processing with Manifold Harmonics" (2008).
#ifndef SpectralWatermark_Core_Eigensolver_SpectrumSlicing_h
#define SpectralWatermark_Core_Eigensolver_SpectrumSlicing_h

#include "Core/Eigensolver/Eigensolver.h"
#include "Core/LinearAlgebra/MultiVector.h"
#include "Core/Support/Progress.h"

#include <limits>
#include <vector>

namespace spectralwatermark
{

/// Consecutive eigenpairs.
struct Band
{
  std::vector<double> Values; ///< eigenvalues, ascending
  MultiVector Vectors;        ///< an eigenvector for each value, in the solver's order of rows
  bool Orthonormal = false;   ///< whether the vectors are M-orthonormal to the last digit

  /// The next larger eigenvalue, or NaN where it is unknown. The band may be cut before it.
  double NextValue = std::numeric_limits<double>::quiet_NaN();
};

/// The eigenpairs that a solver is asked for, around its current shift.
struct BandRequest
{
  Index Below = 0;         ///< number of eigenpairs below the shift, the nearest ones
  Index Above = 0;         ///< number of eigenpairs above the shift, the nearest ones
  Index Window = 0;        ///< largest number of further pairs above, so as to end before a gap
  bool AnySide = false;    ///< if set, the Below + Above nearest pairs, on either side
  MultiVector Locked;      ///< M-orthonormal vectors (or zeros) that were found and are excluded
  BlockVector Start;       ///< an initial guess near the span of the wanted vectors, or empty
  double Tolerance = 1e-8; ///< largest relative residual
  int Attempt = 0;         ///< number of earlier searches for the same band
};

/// A solver that finds the eigenpairs near a shift.
class ShiftInvertSolver
{
public:
  virtual ~ShiftInvertSolver() = default;

  /// The number of eigenpairs per band when the caller does not set it.
  virtual Index DefaultBandSize(Index wanted) const = 0;

  /// Whether the first shift may lie inside the spectrum rather than below it.
  virtual bool FirstShiftInside() const = 0;

  /// Moves to another shift and returns the number of eigenvalues below it (by Sylvester's law of
  /// inertia). Throws SolverFailure when the factorisation breaks down, and Aborted. The reported
  /// fraction stays where `progress` begins.
  virtual Index Factorize(double shift, const Progress& progress) = 0;

  /// Whether solves with the last factorisation are accurate enough.
  virtual bool IsAccurate() const { return true; }

  /// Finds the requested pairs, or as many of them as converge; more do no harm. The first attempt
  /// should leave out pairs whose residuals exceed the tolerance, because they are searched for
  /// again.
  virtual Band FindNearest(BandRequest request, const Progress& progress) = 0;

  /// The problem's matrices, with their rows in the solver's order.
  virtual const SparseMatrix& Stiffness() const = 0;
  virtual const SparseMatrix& Mass() const = 0;

  /// The solver's order of rows: its row i is row Order()[i] of the problem.
  virtual const Eigen::VectorXi& Order() const = 0;
};

/// Solves the problem with bands that are cut where the spectrum has a gap. The eigenvalues of a
/// band are counted by inertia at both of its cuts, so that a multiple eigenvalue is neither lost
/// nor repeated. Missing pairs are searched for again, with all found ones locked, until the count
/// is right or the result cannot be a spectrum.
EigenPairs SolveBySlicing(const EigenProblem& problem, const EigensolverOptions& options,
  ShiftInvertSolver& solver, const Progress& progress);

} // namespace spectralwatermark

#endif

// SPDX-License-Identifier: BSD-3-Clause
/// The manifold harmonics basis of a mesh (paper, 2.1).
#ifndef SpectralWatermark_Core_Harmonics_ManifoldHarmonics_h
#define SpectralWatermark_Core_Harmonics_ManifoldHarmonics_h

#include "Core/Harmonics/LaplaceOperator.h"
#include "Core/Support/Progress.h"

#include <optional>

namespace spectralwatermark
{

/// Which eigensolver computes the harmonics.
enum class SolverChoice
{
  Automatic = 0,    ///< the fastest solver that is safe for the mesh
  BlockLanczos = 1, ///< BlockLanczosSolver
  Spectra = 2,      ///< SpectraSolver, the reference
  Dense = 3         ///< DenseSolver, for small meshes
};

struct ManifoldHarmonics;

/// The settings of ComputeManifoldHarmonics().
struct HarmonicsOptions
{
  Index Count = 100;                    ///< m, the constant harmonic included
  MassMatrix Mass = MassMatrix::Lumped; ///< the inner product
  Index BandSize = 0;                   ///< harmonics per band; 0: the solver's choice
  double Tolerance = 1e-8;              ///< largest relative residual
  int Threads = 1;                      ///< largest number; the result does not depend on it
  SolverChoice Solver = SolverChoice::Automatic; ///< the eigensolver

  /// Harmonics of a mesh with nearly the same triangles and points. They make the computation
  /// faster and change the result by no more than the tolerance.
  const ManifoldHarmonics* InitialGuess = nullptr;

  /// Whether to check the memory first; false if the caller did with RequireMemoryForHarmonics().
  bool CheckMemory = true;
};

/// The first m solutions of S h = lambda M h. Column 0 is the paper's H^1.
struct ManifoldHarmonics
{
  Eigen::VectorXd Eigenvalues; ///< m, ascending, in 1 / length^2; 0 for every component's constant
  Eigen::MatrixXd Basis;       ///< n x m, M-orthonormal, sign fixed; in 1 / length
  Eigen::VectorXd Residuals;   ///< m, see RelativeResiduals
  Eigen::VectorXd VertexMass;  ///< n, the diagonal of D, in length^2
  SparseMatrix Mass;           ///< n x n, the inner product
  Index KernelDimension = 1;   ///< number of components with area, and of eigenvalues 0
  Eigen::VectorXi Elimination; ///< order in which the solver eliminated vertices; may be empty
  bool Complete = false; ///< whether a count proves that no eigenvalue below the last is missing

  /// The number of harmonics, m.
  Index Count() const { return this->Basis.cols(); }
};

/// Throws InvalidInput when there is too little memory to compute `count` harmonics while holding
/// `otherBases` more bases of that size.
void RequireMemoryForHarmonics(Index vertices, Index count, Index otherBases);

/// Computes the basis. The sign is such that each harmonic's entry of largest magnitude is positive
/// (the first of them, when several agree to 1e-6); the constant is positive.
///
/// Throws InvalidInput when the mesh has fewer harmonics than requested, or is too large for the
/// chosen solver or the available memory. Throws SolverFailure when harmonics do not converge to
/// the tolerance or are not proved to be complete, and Aborted.
ManifoldHarmonics ComputeManifoldHarmonics(const TriangleMesh& mesh,
  const HarmonicsOptions& options, const Progress& progress = Progress());

/// Throws InvalidInput when there is too little memory to adopt `count` harmonics.
void RequireMemoryToAdopt(Index vertices, Index count);

/// Adopts a basis that was computed elsewhere if it is one of this mesh: the masses agree, every
/// residual is small and every column is a unit vector. Returns nothing otherwise, so that a stale
/// basis is never used. The check costs a few sparse products.
std::optional<ManifoldHarmonics> AdoptManifoldHarmonics(const TriangleMesh& mesh, MassMatrix mass,
  Eigen::VectorXd eigenvalues, Eigen::MatrixXd basis, const Eigen::VectorXd& vertexMass);

} // namespace spectralwatermark

#endif

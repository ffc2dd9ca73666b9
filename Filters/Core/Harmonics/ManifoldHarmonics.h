// SPDX-License-Identifier: BSD-3-Clause
/// The manifold harmonics basis of a mesh (paper, 2.1).
#ifndef SpectralWatermark_Core_Harmonics_ManifoldHarmonics_h
#define SpectralWatermark_Core_Harmonics_ManifoldHarmonics_h

#include "Core/Harmonics/LaplaceOperator.h"
#include "Core/Support/Progress.h"

#include <optional>

namespace spectralwatermark
{

enum class SolverChoice
{
  Automatic = 0,    ///< the fastest that is safe for the mesh
  BlockLanczos = 1, ///< BlockLanczosSolver
  Spectra = 2,      ///< SpectraSolver, the reference
  Dense = 3         ///< DenseSolver, for small meshes
};

struct ManifoldHarmonics;

struct HarmonicsOptions
{
  Index Count = 100;                    ///< m, the constant harmonic included
  MassMatrix Mass = MassMatrix::Lumped; ///< inner product
  Index BandSize = 0;                   ///< harmonics per band; 0: the solver's choice
  double Tolerance = 1e-8;              ///< relative residual
  int Threads = 1;                      ///< at most; the result does not depend on it
  SolverChoice Solver = SolverChoice::Automatic;
  /// Of a mesh with nearly the same triangles and points: makes it faster. The result differs by no
  /// more than the tolerance.
  const ManifoldHarmonics* InitialGuess = nullptr;
  bool CheckMemory = true; ///< false: the caller did, with RequireMemoryForHarmonics()
};

/// The first m solutions of S h = lambda M h. Column 0 is the paper's H^1.
struct ManifoldHarmonics
{
  Eigen::VectorXd Eigenvalues; ///< m, ascending, in 1 / length^2; 0 for every component's constant
  Eigen::MatrixXd Basis;       ///< n x m, M-orthonormal, sign fixed; in 1 / length
  Eigen::VectorXd Residuals;   ///< m, see RelativeResiduals
  Eigen::VectorXd VertexMass;  ///< n, diagonal of D, in length^2
  SparseMatrix Mass;           ///< n x n, the inner product
  Index KernelDimension = 1;   ///< number of components with area: that many eigenvalues are 0
  Eigen::VectorXi Elimination; ///< order in which the solver eliminated vertices; may be empty
  bool Complete = false;       ///< no eigenvalue below the last is missing: counted, not assumed

  Index Count() const { return this->Basis.cols(); }
};

/// Throws InvalidInput when there is too little memory to compute so many harmonics, beside other bases of
/// that size.
void RequireMemoryForHarmonics(Index vertices, Index count, Index otherBases);

/// Computes the basis. The sign is such that each harmonic's entry of largest magnitude is
/// positive (the first of them, when several agree to 1e-6); the constant is positive.
///
/// Throws InvalidInput when the mesh cannot carry that many harmonics, is too large for the solver asked
/// for or for the memory there is, SolverFailure when they do not converge to the tolerance or cannot be
/// shown to be complete, Aborted.
ManifoldHarmonics ComputeManifoldHarmonics(const TriangleMesh& mesh,
  const HarmonicsOptions& options, const Progress& progress = Progress());

/// Throws InvalidInput when there is too little memory to adopt so many.
void RequireMemoryToAdopt(Index vertices, Index count);

/// Takes a basis that came from elsewhere, if it is one for this mesh: the masses agree, every
/// residual is small and every column is a unit vector. Nothing otherwise: a stale basis is
/// never used. Costs a few sparse products.
std::optional<ManifoldHarmonics> AdoptManifoldHarmonics(const TriangleMesh& mesh, MassMatrix mass,
  Eigen::VectorXd eigenvalues, Eigen::MatrixXd basis, const Eigen::VectorXd& vertexMass);

} // namespace spectralwatermark

#endif

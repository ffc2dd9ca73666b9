// SPDX-License-Identifier: BSD-3-Clause
/// The interface that all eigensolvers share, so that one can replace another.
#ifndef SpectralWatermark_Core_Eigensolver_Eigensolver_h
#define SpectralWatermark_Core_Eigensolver_Eigensolver_h

#include "Core/Support/Progress.h"
#include "Core/Support/Types.h"

#include <Eigen/Cholesky>
#include <Eigen/SparseCore>

namespace spectralwatermark
{

/// The eigenproblem S h = lambda M h. S and M are positive semi-definite, and M has a total mass
/// (sum of its entries) of 1. The eigenvalues are then of the order of 4 pi k (Weyl's law) for
/// models of any size, and a solver's shifts and tolerances have no unit.
struct EigenProblem
{
  const SparseMatrix& Stiffness;
  const SparseMatrix& Mass;
  const Eigen::MatrixXd& Kernel; ///< M-orthonormal null space of S; its pairs are not computed
  Index Rank = 0;                ///< number of finite eigenvalues
};

/// The solution of a similar problem, for a mesh with the same triangles and similar points. A
/// solver starts from it.
struct WarmStart
{
  Eigen::VectorXd Values;         ///< eigenvalues, ascending, scaled to a surface of area 1
  const Eigen::MatrixXd* Vectors; ///< eigenvectors, a column each, in any scale
  Eigen::VectorXi Order;          ///< order of elimination, see EigenPairs; may be empty
};

/// The settings of a solver.
struct EigensolverOptions
{
  Index Count = 100;       ///< number of smallest eigenpairs to compute, the kernel included
  Index BandSize = 0;      ///< eigenpairs per shift-invert band; 0: the solver's choice
  double Tolerance = 1e-8; ///< largest relative residual (see RelativeResiduals)
  int Threads = 1;         ///< largest number of threads; the result does not depend on it
  const WarmStart* InitialGuess = nullptr; ///< makes the solver faster; may be null
};

/// The result of a solver.
struct EigenPairs
{
  Eigen::VectorXd Values;    ///< eigenvalues, ascending; exactly 0 for the kernel
  Eigen::MatrixXd Vectors;   ///< eigenvectors, a column each, M-orthonormal
  Eigen::VectorXd Residuals; ///< relative residuals (see RelativeResiduals)
  Eigen::VectorXi Order;     ///< order in which the rows were eliminated; empty if none was chosen
  Index Bands = 0;           ///< number of shift-invert bands
  bool Complete = false;     ///< whether all Count pairs were found, with none missing among them
};

/// Computes the smallest eigenpairs of an EigenProblem.
class Eigensolver
{
public:
  virtual ~Eigensolver() = default;

  /// Computes the pairs. Throws SolverFailure when a factorisation breaks down and Aborted when
  /// `progress` asks for a stop. Pairs that do not converge or are missing are reported in
  /// EigenPairs, not thrown.
  virtual EigenPairs Solve(const EigenProblem& problem, const EigensolverOptions& options,
    const Progress& progress) const = 0;
};

/// The Cholesky factorisation R^T R of a Gram matrix. Throws SolverFailure when the vectors are
/// linearly dependent.
Eigen::LLT<Eigen::MatrixXd> CholeskyOfGram(const Eigen::MatrixXd& gram);

/// Makes nearly M-orthonormal vectors M-orthonormal: V <- V R^-1 with V^T M V = R^T R. Keeps their
/// order.
void Orthonormalize(const SparseMatrix& mass, Eigen::MatrixXd& vectors);

} // namespace spectralwatermark

#endif

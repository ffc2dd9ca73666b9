// SPDX-License-Identifier: BSD-3-Clause
/// The one interface behind which eigensolvers take each other's place.
#ifndef SpectralWatermark_Core_Eigensolver_Eigensolver_h
#define SpectralWatermark_Core_Eigensolver_Eigensolver_h

#include "Core/Support/Progress.h"
#include "Core/Support/Types.h"

#include <Eigen/Cholesky>
#include <Eigen/SparseCore>

namespace spectralwatermark
{

/// S h = lambda M h with S positive semi-definite and M positive semi-definite of total mass 1
/// (the sum of its entries): the eigenvalues are then of the order of 4 pi k (Weyl's law),
/// whatever the model's size, and a solver's shifts and tolerances have no unit.
struct EigenProblem
{
  const SparseMatrix& Stiffness;
  const SparseMatrix& Mass;
  const Eigen::MatrixXd& Kernel; ///< M-orthonormal null space of S; its pairs come for free
  Index Rank = 0;                ///< number of finite eigenvalues
};

/// What a solver knows of a nearby problem, of a mesh with the same triangles.
struct WarmStart
{
  Eigen::VectorXd Values;         ///< ascending, of a surface of area 1
  const Eigen::MatrixXd* Vectors; ///< a column each, of any length
  Eigen::VectorXi Order;          ///< see EigenPairs; may be empty
};

struct EigensolverOptions
{
  Index Count = 100;       ///< eigenpairs wanted, from the smallest; the kernel counts
  Index BandSize = 0;      ///< eigenpairs per shift-invert band; 0: the solver's choice
  double Tolerance = 1e-8; ///< relative residual (see RelativeResiduals)
  int Threads = 1;         ///< at most; the result does not depend on it
  const WarmStart* InitialGuess = nullptr; ///< makes it faster, if there
};

struct EigenPairs
{
  Eigen::VectorXd Values;    ///< ascending; exactly 0 for the kernel
  Eigen::MatrixXd Vectors;   ///< a column each, M-orthonormal
  Eigen::VectorXd Residuals; ///< relative (see RelativeResiduals)
  Eigen::VectorXi Order;     ///< in which the rows were eliminated, if the solver chose one
  Index Bands = 0;           ///< shift-invert bands that were used
  bool Complete = false;     ///< all that were wanted, and no eigenvalue below them is missing
};

class Eigensolver
{
public:
  virtual ~Eigensolver() = default;

  /// Throws SolverFailure when a factorisation breaks down, Aborted when `progress` says so.
  /// Pairs that do not converge or cannot be completed are told by EigenPairs, not thrown.
  virtual EigenPairs Solve(const EigenProblem& problem, const EigensolverOptions& options,
    const Progress& progress) const = 0;
};

/// R^T R of vectors' Gram matrix; throws SolverFailure when they depend on each other.
Eigen::LLT<Eigen::MatrixXd> CholeskyOfGram(const Eigen::MatrixXd& gram);

/// Makes vectors M-orthonormal that nearly are: V <- V R^-1 with V^T M V = R^T R. Keeps order.
void Orthonormalize(const SparseMatrix& mass, Eigen::MatrixXd& vectors);

} // namespace spectralwatermark

#endif

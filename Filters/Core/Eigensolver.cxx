// SPDX-License-Identifier: BSD-3-Clause
#include "Eigensolver.h"

#include "Errors.h"

#include <Eigen/Cholesky>

namespace spectralwatermark
{

void Orthonormalize(const Eigen::SparseMatrix<double>& mass, Eigen::MatrixXd& vectors)
{
  const Eigen::MatrixXd gram = vectors.transpose() * (mass * vectors).eval();
  const Eigen::LLT<Eigen::MatrixXd> cholesky(gram);
  if (cholesky.info() != Eigen::Success)
  {
    throw SolverFailure("the computed harmonics are linearly dependent");
  }
  cholesky.matrixU().solveInPlace<Eigen::OnTheRight>(vectors);
}

} // namespace spectralwatermark

// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Eigensolver/Eigensolver.h"

namespace spectralwatermark
{

Eigen::LLT<Eigen::MatrixXd> CholeskyOfGram(const Eigen::MatrixXd& gram)
{
  Eigen::LLT<Eigen::MatrixXd> cholesky(gram);
  if (cholesky.info() != Eigen::Success)
  {
    throw SolverFailure("the computed harmonics are linearly dependent");
  }
  return cholesky;
}

void Orthonormalize(const SparseMatrix& mass, Eigen::MatrixXd& vectors)
{
  const Eigen::MatrixXd gram = vectors.transpose() * (mass * vectors).eval();
  CholeskyOfGram(gram).matrixU().solveInPlace<Eigen::OnTheRight>(vectors);
}

} // namespace spectralwatermark

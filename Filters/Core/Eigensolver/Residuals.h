// SPDX-License-Identifier: BSD-3-Clause
/// Relative residuals of eigenpairs of S h = lambda M h, and the limit that rounding sets to them.
#ifndef SpectralWatermark_Core_Eigensolver_Residuals_h
#define SpectralWatermark_Core_Eigensolver_Residuals_h

#include "Core/LinearAlgebra/MultiVector.h"

namespace spectralwatermark
{

/// ||S h - lambda M h|| / ((lambda + 1 / area) ||M h||) for every column h of `vectors`: the
/// relative residual, with 1 / area as the scale where lambda is 0.
Eigen::VectorXd RelativeResiduals(const SparseMatrix& stiffness, const SparseMatrix& mass,
  double area, const Eigen::VectorXd& values, const Eigen::MatrixXd& vectors);

/// What rounding alone may leave of RelativeResiduals(): products with S cancel down from its
/// largest entries. Matters on meshes with very thin triangles, and for tolerances near 1e-12.
Eigen::VectorXd ResidualFloors(const SparseMatrix& stiffness, const SparseMatrix& mass, double area,
  const Eigen::VectorXd& values, const Eigen::MatrixXd& vectors);

/// RelativeResiduals() (area 1) of every column of the blocks; `values` has one for each.
Eigen::VectorXd MultiVectorResiduals(const SparseMatrix& stiffness, const SparseMatrix& mass,
  const Eigen::VectorXd& values, const MultiVector& vectors, int threads);

} // namespace spectralwatermark

#endif

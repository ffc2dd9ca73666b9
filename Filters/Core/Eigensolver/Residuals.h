// SPDX-License-Identifier: BSD-3-Clause
/// Relative residuals of eigenpairs of S h = lambda M h, and their lower limit from rounding.
#ifndef SpectralWatermark_Core_Eigensolver_Residuals_h
#define SpectralWatermark_Core_Eigensolver_Residuals_h

#include "Core/LinearAlgebra/MultiVector.h"

namespace spectralwatermark
{

/// The relative residual ||S h - lambda M h|| / ((lambda + 1 / area) ||M h||) of every column h of
/// `vectors`; 1 / area is the scale where lambda is 0.
Eigen::VectorXd RelativeResiduals(const SparseMatrix& stiffness, const SparseMatrix& mass,
  double area, const Eigen::VectorXd& values, const Eigen::MatrixXd& vectors);

/// The relative residuals that rounding alone may cause, because products with S cancel down from
/// its largest entries. This matters on meshes with very thin triangles, and for tolerances near
/// 1e-12.
Eigen::VectorXd ResidualFloors(const SparseMatrix& stiffness, const SparseMatrix& mass, double area,
  const Eigen::VectorXd& values, const Eigen::MatrixXd& vectors);

/// RelativeResiduals(), for area 1, of every column of the blocks. `values` has an eigenvalue for
/// each column.
Eigen::VectorXd MultiVectorResiduals(const SparseMatrix& stiffness, const SparseMatrix& mass,
  const Eigen::VectorXd& values, const MultiVector& vectors, int threads);

} // namespace spectralwatermark

#endif

// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Eigensolver/Residuals.h"

#include "Core/Support/Parallel.h"

#include <cmath>
#include <limits>

namespace spectralwatermark
{

Eigen::VectorXd RelativeResiduals(const SparseMatrix& stiffness, const SparseMatrix& mass,
  double area, const Eigen::VectorXd& values, const Eigen::MatrixXd& vectors)
{
  Eigen::VectorXd residuals(values.size());
  for (Index k = 0; k < values.size(); ++k)
  {
    const Eigen::VectorXd massTimes = mass * vectors.col(k);
    const Eigen::VectorXd residual = stiffness * vectors.col(k) - values[k] * massTimes;
    residuals[k] = residual.norm() / ((std::abs(values[k]) + 1.0 / area) * massTimes.norm());
  }
  return residuals;
}

Eigen::VectorXd ResidualFloors(const SparseMatrix& stiffness, const SparseMatrix& mass, double area,
  const Eigen::VectorXd& values, const Eigen::MatrixXd& vectors)
{
  const double largest = stiffness.diagonal().cwiseAbs().maxCoeff();
  const double rounding = 8.0 * std::numeric_limits<double>::epsilon() * largest;
  Eigen::VectorXd floors(values.size());
  for (Index k = 0; k < values.size(); ++k)
  {
    floors[k] = rounding * vectors.col(k).norm() /
      ((std::abs(values[k]) + 1.0 / area) * (mass * vectors.col(k)).norm());
  }
  return floors;
}

Eigen::VectorXd MultiVectorResiduals(const SparseMatrix& stiffness, const SparseMatrix& mass,
  const Eigen::VectorXd& values, const MultiVector& vectors, int threads)
{
  Eigen::VectorXd residuals(BlockWidth * static_cast<Index>(vectors.size()));
  ForEachTask(threads, static_cast<Index>(vectors.size()),
    [&](Index k)
    {
      const BlockVector& block = vectors[k];
      const auto value = values.segment<BlockWidth>(BlockWidth * k).array();
      BlockVector massTimes;
      BlockVector residual;
      MultiplyBlock(mass, block, massTimes, 1);
      MultiplyBlock(stiffness, block, residual, 1);
      residual -= massTimes * value.matrix().asDiagonal();
      const Eigen::Array<double, BlockWidth, 1> norms = massTimes.colwise().norm();
      residuals.segment<BlockWidth>(BlockWidth * k) =
        (norms > 0.0)
          .select(residual.colwise().norm().transpose().array() / ((value.abs() + 1.0) * norms),
            0.0);
    });
  return residuals;
}

} // namespace spectralwatermark

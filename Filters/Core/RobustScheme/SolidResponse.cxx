// SPDX-License-Identifier: BSD-3-Clause
#include "Core/RobustScheme/SolidResponse.h"

#include "Core/Mesh/Measures.h"
#include "Core/Support/Errors.h"
#include "Core/Support/Parallel.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <string>

namespace spectralwatermark
{

namespace
{

using Eigen::MatrixXd;
using Eigen::VectorXd;

// The smallest pivot of the patterns' Gram matrix, relative to the largest, that is not rounding
// error.
constexpr double SmallestPivot = 1e-10;

// The functions on the surface that belong to the moments: a column each, a row per point.
MatrixXd MomentsOf(const TriangleMesh::PointMatrix& points)
{
  MatrixXd rows(points.rows(), FrameMoments);
  const auto x = points.col(0).array();
  const auto y = points.col(1).array();
  const auto z = points.col(2).array();
  rows.col(0).setOnes();
  rows.middleCols<3>(1) = points;
  rows.col(4) = x.square();
  rows.col(5) = y.square();
  rows.col(6) = z.square();
  rows.col(7) = x * y;
  rows.col(8) = y * z;
  rows.col(9) = z * x;
  rows.col(10) = x.cube();
  rows.col(11) = y.cube();
  rows.col(12) = z.cube();
  return rows;
}

// The lower triangle of patterns^T diag(weights) patterns. The entries above it are not set.
MatrixXd LowerGram(const VectorXd& weights, const MatrixXd& patterns, int threads)
{
  // The number of columns of a task. It is fixed, so that the sums do not depend on the threads.
  constexpr Index columns = 32;
  const Index size = patterns.cols();
  MatrixXd gram(size, size);
  ForEachTask(threads, (size + columns - 1) / columns,
    [&](Index task)
    {
      const Index first = task * columns;
      const Index count = std::min(columns, size - first);
      gram.block(first, first, size - first, count).noalias() =
        patterns.rightCols(size - first).transpose() *
        (weights.asDiagonal() * patterns.middleCols(first, count)).eval();
    });
  return gram;
}

} // namespace

SolidView::SolidView(const TriangleMesh& oriented)
  : SolidView(oriented, FrameOf(oriented))
{
}

SolidView::SolidView(const TriangleMesh& oriented, const SolidFrame& frame)
  : Frame(frame)
  , Mesh(oriented)
{
  this->Mesh.Points = this->Frame.ToFrame(oriented.Points);
}

SolidResponse::SolidResponse(const SolidView& view, const CarrierSet& carriers, int threads)
  : Areas(VertexAreas(view.Mesh))
  , Patterns(view.Mesh.NumberOfVertices(), carriers.Count() + FrameMoments)
{
  const Index waves = carriers.Waves.rows();
  const MatrixXd phases = view.Mesh.Points * carriers.Waves.transpose();
  this->Patterns.leftCols(waves) = phases.array().cos();
  this->Patterns.middleCols(waves, waves) = phases.array().sin();
  this->Patterns.rightCols<FrameMoments>() = MomentsOf(view.Mesh.Points);
  const Eigen::LDLT<MatrixXd> factors(LowerGram(this->Areas, this->Patterns, threads));
  const VectorXd pivots = factors.vectorD();
  if (!(pivots.minCoeff() > SmallestPivot * pivots.maxCoeff()))
  {
    throw InvalidInput("NumberOfBits",
      "the mesh is too small or too simple for so many bits: " + std::to_string(carriers.Count()) +
        " waves cannot be told apart on it",
      "embed fewer bits");
  }
  this->Inverse = factors.solve(MatrixXd::Identity(this->Patterns.cols(), this->Patterns.cols()));
  this->Inverse = (0.5 * (this->Inverse + this->Inverse.transpose())).eval();
}

VectorXd SolidResponse::Displacements(const VectorXd& changes) const
{
  return this->Patterns * (this->Inverse.leftCols(changes.size()) * changes);
}

MatrixXd SolidResponse::Cost(Index carriers) const
{
  return this->Inverse.topLeftCorner(carriers, carriers) / this->Areas.sum();
}

} // namespace spectralwatermark

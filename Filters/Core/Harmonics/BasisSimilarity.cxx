// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Harmonics/BasisSimilarity.h"

#include <algorithm>
#include <cmath>

namespace spectralwatermark
{

namespace
{

// One past the last eigenvalue of the cluster that begins at `first`.
Index ClusterEnd(const Eigen::VectorXd& eigenvalues, Index first, double tolerance)
{
  Index end = first + 1;
  while (end < eigenvalues.size() &&
    eigenvalues[end] - eigenvalues[end - 1] <= tolerance * eigenvalues[end])
  {
    ++end;
  }
  return end;
}

} // namespace

Eigen::VectorXd BasisSimilarity(const ManifoldHarmonics& reference, const Eigen::MatrixXd& other,
  double clusterTolerance)
{
  const Index count = std::min(reference.Count(), other.cols());
  const Eigen::MatrixXd massTimes = reference.Mass * other.leftCols(count);
  Eigen::VectorXd similarity(count);
  for (Index first = 0; first < count;)
  {
    const Index end = ClusterEnd(reference.Eigenvalues, first, clusterTolerance);
    const auto span = reference.Basis.middleCols(first, end - first);
    for (Index k = first; k < std::min(end, count); ++k)
    {
      const double norm = std::sqrt(std::max(0.0, other.col(k).dot(massTimes.col(k))));
      const double projection = (span.transpose() * massTimes.col(k)).norm();
      similarity[k] = norm > 0.0 ? std::min(1.0, projection / norm) : 0.0;
    }
    first = end;
  }
  return similarity;
}

} // namespace spectralwatermark

// SPDX-License-Identifier: BSD-3-Clause
/// What the tests of the robust scheme share.
#ifndef SpectralWatermark_Testing_RobustTesting_h
#define SpectralWatermark_Testing_RobustTesting_h

#include "Core/RobustScheme/RobustEmbedding.h"
#include "Core/Support/Random.h"
#include "Support/Shapes.h"

#include <string>

namespace robusttesting
{

using namespace spectralwatermark;

const std::string Message = "1011001110001011";

/// A solid without symmetry and with three different axes.
inline TriangleMesh Host(int level)
{
  TriangleMesh mesh = shapes::Bumpy(level);
  mesh.Points *= Eigen::Vector3d(1.5, 1.0, 0.7).asDiagonal();
  return mesh;
}

inline RobustEmbeddingResult Marked(const TriangleMesh& mesh, const SecretKey& key,
  const std::string& message = Message, double distortion = 0.0007)
{
  RobustEmbeddingOptions options;
  options.Message = message;
  options.MaximumDistortion = distortion;
  options.Threads = 2;
  return EmbedRobust(mesh, key, options, Progress());
}

/// The mesh with other points.
inline TriangleMesh With(TriangleMesh mesh, const TriangleMesh::PointMatrix& points)
{
  mesh.Points = points;
  return mesh;
}

/// Wave vectors of this length in all directions, a row each.
inline Eigen::MatrixXd RandomWaves(Index count, double length)
{
  Eigen::MatrixXd waves(count, 3);
  for (Index k = 0; k < waves.size(); ++k)
  {
    waves.data()[k] = NormalRandom(11, static_cast<std::uint64_t>(k));
  }
  return length * waves.rowwise().normalized();
}

} // namespace robusttesting

#endif

// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Mesh/Measures.h"
#include "Core/RobustScheme/CarrierSet.h"
#include "Core/RobustScheme/SolidFrame.h"
#include "Core/RobustScheme/SolidResponse.h"
#include "Core/RobustScheme/SolidSpectrum.h"
#include "Core/Support/Errors.h"
#include "Core/Support/Random.h"
#include "Support/CoreTesting.h"
#include "Support/RobustTesting.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>

using namespace spectralwatermark;
using robusttesting::Host;

namespace
{

struct Response
{
  explicit Response(int level)
    : View(Host(level))
    , Carriers(CarriersOf(SecretKey("secret"), 4))
    , Solid(View, Carriers, 2)
  {
  }

  /// The mesh in its frame, moved along its normals.
  TriangleMesh Moved(const Eigen::VectorXd& heights) const
  {
    TriangleMesh moved = this->View.Mesh;
    moved.Points += heights.asDiagonal() * VertexNormals(moved);
    return moved;
  }

  SolidView View;
  CarrierSet Carriers;
  SolidResponse Solid;
};

Eigen::VectorXd SmallChanges(Index count)
{
  Eigen::VectorXd changes(count);
  for (Index k = 0; k < count; ++k)
  {
    changes[k] = 1e-5 * (2.0 * UniformRandom(1, static_cast<std::uint64_t>(k)) - 1.0);
  }
  return changes;
}

} // namespace

TEST(SolidResponse, ViewsTheMeshInItsFrame)
{
  const TriangleMesh mesh = Host(2);
  const SolidView view(mesh);
  EXPECT_EQ(view.Mesh.Points, FrameOf(mesh).ToFrame(mesh.Points));
  const SolidFrame frame = FrameOf(view.Mesh);
  EXPECT_LT(frame.Origin.norm(), 1e-12);
  EXPECT_NEAR(frame.Scale, 1.0, 1e-12);
}

TEST(SolidResponse, DisplacementsChangeTheCarriersAsAsked)
{
  const Response response(4);
  const Eigen::VectorXd changes = SmallChanges(response.Carriers.Count());
  const TriangleMesh moved = response.Moved(response.Solid.Displacements(changes));
  const Eigen::VectorXd before = SolidSpectrum(response.View.Mesh, response.Carriers.Waves, 2);
  const Eigen::VectorXd after = SolidSpectrum(moved, response.Carriers.Waves, 2);
  EXPECT_LT((after - before - changes).norm(), 0.1 * changes.norm());
}

// Exactly so for sums over the vertices: volume, centre and second moments.
TEST(SolidResponse, DisplacementsAreOrthogonalToTheFramesMoments)
{
  const Response response(4);
  const Eigen::VectorXd heights =
    response.Solid.Displacements(SmallChanges(response.Carriers.Count()));
  const Eigen::VectorXd weighted = VertexAreas(response.View.Mesh).cwiseProduct(heights);
  const TriangleMesh::PointMatrix& points = response.View.Mesh.Points;
  EXPECT_NEAR(weighted.sum(), 0.0, 1e-12);
  EXPECT_LT((points.transpose() * weighted).norm(), 1e-12);
  EXPECT_LT((points.transpose() * weighted.asDiagonal() * points).norm(), 1e-12);
}

// Integrals over the surface differ from sums over the vertices, the less the finer the mesh.
TEST(SolidResponse, DisplacementsOfAFinerMeshMoveTheFrameLess)
{
  const auto frameMotion = [](int level)
  {
    const Response response(level);
    const Eigen::VectorXd heights =
      response.Solid.Displacements(SmallChanges(response.Carriers.Count()));
    const SolidFrame before = FrameOf(response.View.Mesh);
    const SolidFrame after = FrameOf(response.Moved(heights));
    const double motion = (after.Origin - before.Origin).norm() +
      (after.Axes - before.Axes).norm() + std::abs(after.Scale - before.Scale);
    return motion / heights.cwiseAbs().maxCoeff();
  };
  const double coarse = frameMotion(4);
  const double fine = frameMotion(5);
  EXPECT_LT(fine, 0.5 * coarse) << coarse;
}

TEST(SolidResponse, CostIsTheMeanSquareOfTheDisplacements)
{
  const Response response(3);
  const Index count = response.Carriers.Count();
  const Eigen::MatrixXd cost = response.Solid.Cost(count);
  EXPECT_LT((cost - cost.transpose()).norm(), 1e-14 * cost.norm());
  const Eigen::VectorXd areas = VertexAreas(response.View.Mesh);
  for (int trial = 0; trial < 3; ++trial)
  {
    const Eigen::VectorXd changes = Eigen::VectorXd::Random(count);
    const Eigen::VectorXd heights = response.Solid.Displacements(changes);
    const double meanSquare = areas.dot(heights.cwiseAbs2()) / areas.sum();
    EXPECT_NEAR(changes.dot(cost * changes) / meanSquare, 1.0, 1e-8);
  }
}

TEST(SolidResponse, RefusesMoreWavesThanVertices)
{
  const SolidView view(Host(1)); // 42 vertices
  const CarrierSet carriers = CarriersOf(SecretKey("secret"), 16);
  coretesting::ExpectRefusal([&] { SolidResponse(view, carriers, 1); },
    std::to_string(carriers.Count()) + " waves cannot be told apart");
}

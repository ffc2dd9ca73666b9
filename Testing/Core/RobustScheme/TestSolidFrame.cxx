// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Attacks/Attacks.h"
#include "Core/Mesh/Orientation.h"
#include "Core/RobustScheme/SolidFrame.h"
#include "Core/Support/Errors.h"
#include "Support/Shapes.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace spectralwatermark;

namespace
{

TriangleMesh Moved(TriangleMesh mesh, const SimilarityTransform& t)
{
  mesh.Points =
    (t.Scale * mesh.Points * t.Rotation.transpose()).rowwise() + t.Translation.transpose();
  return mesh;
}

} // namespace

TEST(SolidFrame, MovesWithItsSolid)
{
  const TriangleMesh mesh = shapes::Bumpy(4);
  const TriangleMesh::PointMatrix inFrame = FrameOf(mesh).ToFrame(mesh.Points);
  for (int seed = 0; seed < 20; ++seed)
  {
    const TriangleMesh moved =
      Moved(mesh, RandomSimilarity(mesh, static_cast<std::uint64_t>(seed)));
    const SolidFrame frame = FrameOf(moved);
    EXPECT_LT((frame.ToFrame(moved.Points) - inFrame).cwiseAbs().maxCoeff(), 1e-9);
    const TriangleMesh::PointMatrix changes = TriangleMesh::PointMatrix::Random(5, 3);
    TriangleMesh::PointMatrix shifted = moved.Points.topRows(5);
    shifted += frame.DifferencesFromFrame(changes);
    EXPECT_LT((frame.ToFrame(shifted) - inFrame.topRows(5) - changes).norm(), 1e-9);
  }
}

TEST(SolidFrame, FollowsFromTheMoments)
{
  // Of a box with sides a > b > c: variances a^2 / 12 and so on, and no skewness.
  TriangleMesh box = shapes::Box(3.0, 2.0, 1.0);
  box.Points.rowwise() += Eigen::RowVector3d(1e4, -5.0, 7.0);
  const SolidFrame frame = FrameOf(box);
  EXPECT_LT((frame.Origin - Eigen::RowVector3d(1e4, -5.0, 7.0)).norm(), 1e-8);
  EXPECT_NEAR(frame.Scale, std::sqrt(14.0 / 12.0), 1e-10);
  EXPECT_LT((frame.Axes.cwiseAbs() - Eigen::Matrix3d::Identity()).norm(), 1e-9);
  EXPECT_LT(frame.Clearness, 1e-6);
  EXPECT_GT(FrameOf(shapes::Bumpy(4)).Clearness, 1e-3);
}

TEST(SolidFrame, RotationsByPiAreHalfTurns)
{
  const SolidFrame frame = FrameOf(shapes::Bumpy(3));
  EXPECT_EQ(RotatedByPi(frame, 0).Axes, frame.Axes);
  for (int turn = 1; turn < NumberOfTurns; ++turn)
  {
    const Eigen::Matrix3d rotation = RotatedByPi(frame, turn).Axes * frame.Axes.transpose();
    EXPECT_NEAR(rotation(turn - 1, turn - 1), 1.0, 1e-12);
    EXPECT_NEAR(rotation.trace(), -1.0, 1e-12);
  }
}

TEST(SolidFrame, SheetsAreRefused)
{
  EXPECT_THROW(FrameOf(shapes::Rectangle(4, 4, 1.0, 1.0)), InvalidInput);
}

// The volume of the last is one of rounding.
TEST(SolidFrame, PointsInARowHaveNone)
{
  for (Index count = 4; count < 60; ++count)
  {
    EXPECT_FALSE(FrameIfAny(shapes::PointsInARow(count, 2, { 3.0, 7.0, 11.0 })).has_value())
      << count;
  }
  EXPECT_FALSE(FrameIfAny(Oriented(shapes::PointsInARow(6, 2, { 24.0, 1.0, 10.0 }))).has_value());
}

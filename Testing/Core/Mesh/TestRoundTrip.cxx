// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Mesh/RoundTrip.h"
#include "Core/Support/Errors.h"
#include "Support/CoreTesting.h"
#include "Support/Shapes.h"

#include <gtest/gtest.h>

using namespace spectralwatermark;

TEST(RoundTrip, VerticesMayMergeOrVanish)
{
  const RoundTripResult stored{ {}, { 1, -1, 0, 1 }, {} };
  TriangleMesh::PointMatrix rows(2, 3);
  rows << 1.0, 2.0, 3.0, 4.0, 5.0, 6.0;
  TriangleMesh::PointMatrix expected(4, 3);
  expected << 4.0, 5.0, 6.0, 0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0;
  EXPECT_EQ(stored.ToStored(rows), expected);
}

TEST(RoundTrip, ExactKeepsTrianglesAndPoints)
{
  const TriangleMesh mesh = shapes::Icosphere(1);
  const TriangleMesh::PointMatrix moved = 1.7 * mesh.Points;
  const RoundTripResult stored = ExactRoundTrip(mesh)(moved);
  EXPECT_TRUE(SameTriangles(stored.Mesh, mesh));
  EXPECT_EQ(stored.Mesh.Points, moved);
  EXPECT_EQ(stored.Points, moved);
  EXPECT_EQ(stored.ToStored(moved), moved);
}

TEST(RoundTrip, ARefusalAfterItNamesStoringAsTheReason)
{
  EXPECT_EQ(ReadAfterRoundTrip([] { return 7; }), 7);
  const auto refuse = []() -> int { throw InvalidInput("", "nothing is left", ""); };
  coretesting::ExpectRefusal([&] { ReadAfterRoundTrip(refuse); },
    "once marked and rounded as its points are stored, the mesh cannot be read");
  coretesting::ExpectRefusal([&] { ReadAfterRoundTrip(refuse); }, "nothing is left");
  const auto abort = []() -> int { throw Aborted(); };
  EXPECT_THROW(ReadAfterRoundTrip(abort), Aborted);
}

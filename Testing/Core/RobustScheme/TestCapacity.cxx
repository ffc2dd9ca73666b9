// SPDX-License-Identifier: BSD-3-Clause
#include "Core/RobustScheme/Capacity.h"
#include "Core/RobustScheme/RobustEmbedding.h"
#include "Core/Support/Errors.h"
#include "Core/Support/Progress.h"
#include "Support/RobustTesting.h"

#include <gtest/gtest.h>

using namespace spectralwatermark;
using namespace robusttesting;

// What is said to fit is embedded, and two words of the code more are refused.
TEST(Capacity, IsWhatFits)
{
  const SecretKey key("secret");
  const TriangleMesh mesh = Host(3);
  const double distortion = 2e-5;
  const Index capacity = CapacityOf(mesh, key, distortion, 2, Progress());
  ASSERT_GE(capacity, 16);
  ASSERT_LT(capacity, 200);
  EXPECT_LE(Marked(mesh, key, key.Message(capacity), distortion).Distortion, distortion);
  EXPECT_THROW(Marked(mesh, key, key.Message(capacity + 24), distortion), InvalidInput);
  EXPECT_EQ(CapacityOf(mesh, key, 1e-9, 2, Progress()), 0);
}

TEST(Capacity, ProgressRisesAndAbortStops)
{
  const TriangleMesh mesh = Host(2);
  const SecretKey key("secret");
  const double distortion = RobustEmbeddingOptions().MaximumDistortion;
  double last = 0.0;
  const Progress rising(
    [&last](double fraction)
    {
      EXPECT_GE(fraction, last);
      last = fraction;
      return true;
    });
  CapacityOf(mesh, key, distortion, 2, rising);
  EXPECT_EQ(last, 1.0);
  const Progress stopping([](double fraction) { return fraction < 0.6; });
  EXPECT_THROW(CapacityOf(mesh, key, distortion, 2, stopping), Aborted);
}

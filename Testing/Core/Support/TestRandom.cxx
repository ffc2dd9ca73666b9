// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Support/Random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <vector>

using namespace spectralwatermark;

TEST(Random, UniformNumbersAreUniform)
{
  constexpr int count = 100000;
  double sum = 0.0;
  std::vector<int> tenths(10, 0);
  for (int k = 0; k < count; ++k)
  {
    const double u = UniformRandom(3, static_cast<std::uint64_t>(k));
    ASSERT_GT(u, 0.0);
    ASSERT_LT(u, 1.0);
    sum += u;
    ++tenths[static_cast<std::size_t>(10.0 * u)];
  }
  EXPECT_NEAR(sum / count, 0.5, 5.0 / std::sqrt(12.0 * count));
  for (const int tenth : tenths)
  {
    EXPECT_NEAR(tenth, count / 10, 5.0 * std::sqrt(0.09 * count));
  }
}

TEST(Random, NormalNumbersAreStandardNormal)
{
  const Index n = 200000;
  Eigen::VectorXd samples(n);
  for (Index i = 0; i < n; ++i)
  {
    samples[i] = NormalRandom(42, static_cast<std::uint64_t>(i));
  }
  const double mean = samples.mean();
  const Eigen::ArrayXd centred = samples.array() - mean;
  const double variance = centred.square().mean();
  EXPECT_NEAR(mean, 0.0, 5.0 / std::sqrt(static_cast<double>(n)));
  EXPECT_NEAR(variance, 1.0, 5.0 * std::sqrt(2.0 / static_cast<double>(n)));
  EXPECT_NEAR(centred.pow(4).mean(), 3.0, 0.1);
  // Neighbouring elements are independent.
  EXPECT_NEAR((centred.head(n - 1) * centred.tail(n - 1)).mean(), 0.0, 0.012);
}

TEST(Random, DependsOnSeedAndElementAlone)
{
  EXPECT_EQ(NormalRandom(7, 3), NormalRandom(7, 3));
  std::set<double> values;
  for (std::uint64_t seed = 0; seed < 50; ++seed)
  {
    for (std::uint64_t element = 0; element < 50; ++element)
    {
      values.insert(NormalRandom(seed, element));
    }
  }
  EXPECT_EQ(values.size(), 2500u);
}

TEST(Random, EveryOrderIsEquallyLikely)
{
  std::map<std::vector<Index>, int> counts;
  for (int seed = 0; seed < 6000; ++seed)
  {
    ++counts[RandomOrder(3, static_cast<std::uint64_t>(seed))];
  }
  EXPECT_EQ(counts.size(), 6u);
  for (const auto& [order, count] : counts)
  {
    EXPECT_EQ(std::set<Index>(order.begin(), order.end()), (std::set<Index>{ 0, 1, 2 }));
    EXPECT_NEAR(count, 1000, 150);
  }
  EXPECT_TRUE(RandomOrder(0, 1).empty());
}

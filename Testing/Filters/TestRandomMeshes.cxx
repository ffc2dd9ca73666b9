// SPDX-License-Identifier: BSD-3-Clause
// Any mesh, any properties: a clear error, or an output that keeps its promises (Support/FilterCase.h). The
// fuzzers search for cases; these are a few hundred that anyone can run.
#include "Support/FilterCase.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace
{

class RandomMeshes : public testing::TestWithParam<const char*>
{
};

std::vector<std::uint8_t> RandomBytes(std::uint32_t seed)
{
  std::mt19937 random(seed);
  std::vector<std::uint8_t> bytes(300 + random() % 3000);
  for (std::uint8_t& byte : bytes)
  {
    byte = static_cast<std::uint8_t>(random());
  }
  return bytes;
}

TEST_P(RandomMeshes, AreRefusedOrServed)
{
  constexpr std::uint32_t cases = 120;
  int served = 0;
  for (std::uint32_t seed = 0; seed < cases; ++seed)
  {
    const std::vector<std::uint8_t> data = RandomBytes(seed);
    fuzzing::Bytes bytes(data.data(), data.size());
    const fuzzing::Outcome outcome = fuzzing::RunFilterCase(GetParam(), bytes);
    EXPECT_EQ(outcome.Wrong, "") << "seed " << seed;
    served += outcome.Error.empty() ? 1 : 0;
  }
  // Both happen often enough to mean something.
  EXPECT_GT(served, 4);
  EXPECT_LT(served, 116);
}

INSTANTIATE_TEST_SUITE_P(Filters, RandomMeshes, testing::ValuesIn(fuzzing::FilterNames),
  [](const testing::TestParamInfo<const char*>& filter) { return std::string(filter.param); });

} // namespace

// SPDX-License-Identifier: BSD-3-Clause
// What is free, and what is said when it is not enough.
#include "Core/Errors.h"
#include "Core/MemoryLimit.h"
#include "Support/AddressSpace.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace spectralwatermark;

TEST(MemoryLimit, SomethingIsFreeAndKnown)
{
  EXPECT_GT(AvailableMemory(), 0.0);
  EXPECT_TRUE(std::isfinite(AvailableMemory()));
  EXPECT_NO_THROW(RequireMemory(1e6, "these", "nothing"));
}

TEST(MemoryLimit, MoreThanAnyMachineHasIsRefused)
{
  try
  {
    RequireMemory(1.23e18, "a billion harmonics", "ask for fewer");
    FAIL();
  }
  catch (const InvalidInput& error)
  {
    const std::string text = error.what();
    EXPECT_EQ(text.find("a billion harmonics need about 1230000000 GB of memory, and "),
      std::size_t{ 0 });
    EXPECT_NE(text.find(" GB are free: ask for fewer"), std::string::npos) << text;
  }
}

#ifndef SPECTRALWATERMARK_NO_ADDRESS_LIMIT
TEST(MemoryLimit, TheLimitOfTheShellCounts)
{
  const AddressSpaceLimit limit(200e6);
  ASSERT_TRUE(limit.Holds());
  EXPECT_LE(AvailableMemory(), 200e6);
  EXPECT_GT(AvailableMemory(), 150e6);
  EXPECT_NO_THROW(RequireMemory(100e6, "these", "nothing"));
  EXPECT_THROW(RequireMemory(300e6, "these", "nothing"), InvalidInput);
}
#endif

// SPDX-License-Identifier: BSD-3-Clause
// What is free, and what is said when it is not enough.
#include "Core/Support/Errors.h"
#include "Core/Support/MemoryBudget.h"
#include "Support/AddressSpace.h"
#include "Support/CoreTesting.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

using namespace spectralwatermark;

TEST(MemoryBudget, SomethingIsFreeAndKnown)
{
  EXPECT_GT(AvailableMemory(), 0.0);
  EXPECT_TRUE(std::isfinite(AvailableMemory()));
  EXPECT_NO_THROW(RequireMemory(1e6, "these", "nothing"));
}

TEST(MemoryBudget, MoreThanAnyMachineHasIsRefused)
{
  const std::string text =
    coretesting::RefusalOf([] { RequireMemory(1.23e18, "a billion harmonics", "ask for fewer"); });
  EXPECT_EQ(text.find("a billion harmonics need about 1230000000 GB of memory, and "),
    std::size_t{ 0 })
    << text;
  EXPECT_NE(text.find(" GB are free; ask for fewer"), std::string::npos) << text;
}

// More than 32 bits count: none are lost on the way to the text.
TEST(MemoryBudget, TrianglesBeyondAnIntAreCounted)
{
  coretesting::ExpectRefusal([] { RequireMemoryForTriangles(Index{ 1 } << 40, 100.0); },
    "1099511627776 triangles need about 109951 GB of memory");
}

#ifdef __linux__

namespace
{

// What Linux shows of control groups, in a folder of its own.
class Groups
{
public:
  Groups() { std::filesystem::create_directories(this->Root); }
  ~Groups() { std::filesystem::remove_all(this->Root); }
  Groups(const Groups&) = delete;
  void operator=(const Groups&) = delete;

  void Write(const std::string& path, const std::string& text) const
  {
    const std::filesystem::path file = this->Root + path;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text;
  }
  double Available() const { return AvailableMemoryOfGroups(this->Root); }

private:
  std::string Root = testing::TempDir() + "/groups" + std::to_string(getpid());
};

} // namespace

TEST(MemoryBudget, ControlGroupsOfTheSecondVersionAreRead)
{
  const Groups groups;
  groups.Write("/proc/self/cgroup", "0::/user/job\n");
  EXPECT_TRUE(std::isinf(groups.Available()));
  groups.Write("/sys/fs/cgroup/user/job/memory.max", "max\n");
  groups.Write("/sys/fs/cgroup/user/job/memory.current", "700\n");
  EXPECT_TRUE(std::isinf(groups.Available()));
  groups.Write("/sys/fs/cgroup/user/memory.max", "5000\n"); // holds for those in it
  groups.Write("/sys/fs/cgroup/user/memory.current", "1000\n");
  EXPECT_EQ(groups.Available(), 4000.0);
  groups.Write("/sys/fs/cgroup/user/job/memory.max", "2000\n");
  EXPECT_EQ(groups.Available(), 1300.0);
  // What files are kept in memory is given up when it is needed.
  groups.Write("/sys/fs/cgroup/user/job/memory.stat", "anon 600\ninactive_file 100\n");
  EXPECT_EQ(groups.Available(), 1400.0);
}

// In a container the path is that outside, and the container's group is the root.
TEST(MemoryBudget, ControlGroupsOfTheFirstVersionAreRead)
{
  const Groups groups;
  groups.Write("/proc/self/cgroup", "9:cpu,cpuacct:/box\n4:memory:/box/17\n0::/other\n");
  groups.Write("/sys/fs/cgroup/memory/memory.limit_in_bytes", "3000\n");
  groups.Write("/sys/fs/cgroup/memory/memory.usage_in_bytes", "2500\n");
  groups.Write("/sys/fs/cgroup/memory/memory.stat", "inactive_file 1\ntotal_inactive_file 50\n");
  EXPECT_EQ(groups.Available(), 550.0);
}

#endif

#ifndef SPECTRALWATERMARK_NO_ADDRESS_LIMIT
TEST(MemoryBudget, TheLimitOfTheShellCounts)
{
  const AddressSpaceLimit limit(200e6);
  ASSERT_TRUE(limit.Holds());
  EXPECT_LE(AvailableMemory(), 200e6);
  EXPECT_GT(AvailableMemory(), 150e6);
  EXPECT_NO_THROW(RequireMemory(100e6, "these", "nothing"));
  EXPECT_THROW(RequireMemory(300e6, "these", "nothing"), InvalidInput);
}
#endif

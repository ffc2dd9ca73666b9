// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Support/Parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <vector>

using namespace spectralwatermark;

TEST(Parallel, EveryTaskIsDoneOnceOnAnyNumberOfThreads)
{
  constexpr Eigen::Index tasks = 1000;
  for (const int threads : { 1, 2, 3, 16 })
  {
    std::vector<std::atomic<int>> done(tasks);
    ForEachTask(threads, tasks, [&done](Eigen::Index task) { ++done[task]; });
    for (const std::atomic<int>& times : done)
    {
      ASSERT_EQ(times, 1) << threads;
    }
  }
}

TEST(Parallel, SumsByTaskDoNotDependOnTheThreads)
{
  const auto sum = [](int threads)
  {
    std::vector<double> parts(300);
    ForEachTask(threads, 300,
      [&parts](Eigen::Index task) { parts[task] = std::sin(static_cast<double>(task)); });
    double total = 0.0;
    for (const double part : parts)
    {
      total += part;
    }
    return total;
  };
  EXPECT_EQ(sum(1), sum(2));
  EXPECT_EQ(sum(1), sum(5));
}

TEST(Parallel, NoTasksAreNoWork)
{
  ForEachTask(4, 0, [](Eigen::Index) { FAIL() << "there is no task"; });
}

TEST(Parallel, MoreThreadsThanTasksAreFine)
{
  std::atomic<int> done{ 0 };
  ForEachTask(8, 1, [&done](Eigen::Index task) { done += task == 0 ? 1 : 100; });
  EXPECT_EQ(done, 1);
}

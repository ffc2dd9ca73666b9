// SPDX-License-Identifier: BSD-3-Clause
#ifndef SpectralWatermark_Core_Parallel_h
#define SpectralWatermark_Core_Parallel_h

#include <Eigen/Core>

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

namespace spectralwatermark
{

/// Calls work(task) for every task from 0 to tasks - 1, on up to `threads` threads. Which thread
/// takes which task is open, so results must not depend on it: whoever sums, sums by task.
template <typename Work>
void ForEachTask(int threads, Eigen::Index tasks, const Work& work)
{
  std::atomic<Eigen::Index> next{ 0 };
  const auto run = [&]()
  {
    for (Eigen::Index task = next++; task < tasks; task = next++)
    {
      work(task);
    }
  };
  std::vector<std::thread> helpers;
  for (Eigen::Index t = 1; t < std::min<Eigen::Index>(threads, tasks); ++t)
  {
    helpers.emplace_back(run);
  }
  run();
  for (std::thread& helper : helpers)
  {
    helper.join();
  }
}

} // namespace spectralwatermark

#endif

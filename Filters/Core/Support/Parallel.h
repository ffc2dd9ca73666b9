// SPDX-License-Identifier: BSD-3-Clause
/// A parallel loop over tasks.
#ifndef SpectralWatermark_Core_Support_Parallel_h
#define SpectralWatermark_Core_Support_Parallel_h

#include <Eigen/Core>

#include <algorithm>

namespace spectralwatermark
{

/// Calls work(task) for every task from 0 to tasks - 1, on up to `threads` threads. Tasks are
/// assigned to threads in no fixed order: accumulate per task, never per thread, so that results do
/// not depend on the assignment. work() must not throw.
template <typename Work>
void ForEachTask(int threads, Eigen::Index tasks, const Work& work)
{
  const int useful = static_cast<int>(std::min<Eigen::Index>(threads, tasks));
#pragma omp parallel for num_threads(useful) schedule(dynamic, 1) if (useful > 1)
  for (Eigen::Index task = 0; task < tasks; ++task)
  {
    work(task);
  }
}

} // namespace spectralwatermark

#endif

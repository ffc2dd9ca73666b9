// SPDX-License-Identifier: BSD-3-Clause
#ifndef SpectralWatermark_Core_Support_AbortableCall_h
#define SpectralWatermark_Core_Support_AbortableCall_h

#include "Core/Support/Progress.h"

#include <chrono>
#include <future>
#include <thread>
#include <utility>

namespace spectralwatermark
{

/// Runs work() on a thread of its own and asks `progress` meanwhile whether to stop. For a single
/// call into a library that cannot be interrupted and may take seconds: when it is aborted, the call
/// goes on in the background and its result is thrown away, so work must own all that it touches.
/// Returns what work returns, throws what it throws, or Aborted. The fraction reported is where
/// `progress` begins.
template <typename Work>
auto RunAbortably(const Progress& progress, Work work)
{
  std::packaged_task<decltype(work())()> task(std::move(work));
  auto result = task.get_future();
  std::thread(std::move(task)).detach();
  while (result.wait_for(std::chrono::milliseconds(100)) != std::future_status::ready)
  {
    progress.Report(0.0);
  }
  return result.get();
}

} // namespace spectralwatermark

#endif

// SPDX-License-Identifier: BSD-3-Clause
/// Runs a call that cannot be interrupted so that its caller can stop waiting for it.
#ifndef SpectralWatermark_Core_Support_AbortableCall_h
#define SpectralWatermark_Core_Support_AbortableCall_h

#include "Core/Support/Progress.h"

#include <chrono>
#include <cstddef>
#include <future>
#include <utility>

namespace spectralwatermark
{

/// Keeps a call that its caller no longer waits for. Its thread is joined by the first later call
/// that finds it ended, or else when the program ends or the library is unloaded.
void KeepAbandonedCall(std::future<void> call);

/// Joins the threads of abandoned calls that have ended. Returns the number of abandoned calls that
/// are still running; it does not wait for these.
std::size_t JoinFinishedCalls();

/// Runs work() on a thread of its own and meanwhile asks `progress` whether to stop. It is meant
/// for a single call into a library that cannot be interrupted and may take seconds. An abort
/// returns at once: the call continues in the background and its result is discarded, so `work`
/// must own everything that it uses. Returns what work() returns; throws what work() throws, or
/// Aborted. The reported fraction stays where `progress` begins.
template <typename Work>
auto RunAbortably(const Progress& progress, Work work)
{
  JoinFinishedCalls();
  std::packaged_task<decltype(work())()> task(std::move(work));
  auto result = task.get_future();
  std::future<void> call = std::async(std::launch::async,
    [task = std::move(task)]() mutable
    {
      // An abandoned call frees its memory when it ends, not when it is joined.
      auto own = std::move(task);
      own();
    });
  try
  {
    while (result.wait_for(std::chrono::milliseconds(100)) != std::future_status::ready)
    {
      progress.Report(0.0);
    }
  }
  catch (...)
  {
    KeepAbandonedCall(std::move(call));
    throw;
  }
  return result.get();
}

} // namespace spectralwatermark

#endif

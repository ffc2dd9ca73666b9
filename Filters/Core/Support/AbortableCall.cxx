// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Support/AbortableCall.h"

#include <algorithm>
#include <mutex>
#include <vector>

namespace spectralwatermark
{

namespace
{

// The calls that are still running, or ended and not joined. std::async's futures join their thread
// when they are destroyed, so the destructor of this class joins them all.
class AbandonedCalls
{
public:
  void Add(std::future<void> call)
  {
    const std::lock_guard<std::mutex> lock(this->Access);
    this->Calls.push_back(std::move(call));
  }

  std::size_t JoinFinished()
  {
    const std::lock_guard<std::mutex> lock(this->Access);
    const auto finished = [](const std::future<void>& call)
    { return call.wait_for(std::chrono::seconds(0)) == std::future_status::ready; };
    this->Calls.erase(std::remove_if(this->Calls.begin(), this->Calls.end(), finished),
      this->Calls.end());
    return this->Calls.size();
  }

private:
  std::mutex Access;
  std::vector<std::future<void>> Calls;
};

AbandonedCalls& Registry()
{
  static AbandonedCalls calls;
  return calls;
}

} // namespace

void KeepAbandonedCall(std::future<void> call)
{
  Registry().Add(std::move(call));
}

std::size_t JoinFinishedCalls()
{
  return Registry().JoinFinished();
}

} // namespace spectralwatermark

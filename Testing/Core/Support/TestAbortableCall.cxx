// SPDX-License-Identifier: BSD-3-Clause
// Calls on a thread of their own: their result, and what an abort leaves running.
#include "Core/Support/AbortableCall.h"
#include "Core/Support/Errors.h"
#include "Core/Support/Progress.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

using namespace spectralwatermark;

namespace
{

using Clock = std::chrono::steady_clock;

const Progress AlwaysAbort([](double) { return false; });

// A call that ends only when it is released, so that a test decides which of the two ends first.
struct HeldCall
{
  std::promise<void> Release;
  std::shared_ptr<std::atomic<bool>> Ended = std::make_shared<std::atomic<bool>>(false);

  auto Work()
  {
    return [released = this->Release.get_future().share(), ended = this->Ended]
    {
      released.wait();
      *ended = true;
      return 1;
    };
  }
};

// Whether `condition` holds within ten seconds.
template <typename Condition>
bool Eventually(const Condition& condition)
{
  const auto deadline = Clock::now() + std::chrono::seconds(10);
  while (!condition() && Clock::now() < deadline)
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return condition();
}

// Earlier tests may have left calls behind; these tests count from none.
class AbortableCall : public testing::Test
{
protected:
  void SetUp() override
  {
    ASSERT_TRUE(Eventually([] { return JoinFinishedCalls() == 0; }));
  }
};

} // namespace

TEST_F(AbortableCall, ReturnsWhatTheWorkReturns)
{
  EXPECT_EQ(RunAbortably(Progress(), [] { return 42; }), 42);
  const auto owned = RunAbortably(Progress(), [] { return std::make_unique<int>(7); });
  EXPECT_EQ(*owned, 7);
}

TEST_F(AbortableCall, RunsWorkWithoutAResultOnAnotherThread)
{
  std::thread::id id;
  RunAbortably(Progress(), [&id] { id = std::this_thread::get_id(); });
  EXPECT_NE(id, std::thread::id());
  EXPECT_NE(id, std::this_thread::get_id());
}

TEST_F(AbortableCall, ThrowsWhatTheWorkThrows)
{
  EXPECT_THROW(RunAbortably(Progress(), []() -> int { throw std::out_of_range("work"); }),
    std::out_of_range);
}

TEST_F(AbortableCall, ReportsWhereItsPartBegins)
{
  std::vector<double> reports;
  const Progress progress(
    [&reports](double fraction)
    {
      reports.push_back(fraction);
      return true;
    });
  RunAbortably(progress.Part(0.25, 0.75),
    [] { std::this_thread::sleep_for(std::chrono::milliseconds(250)); });
  ASSERT_FALSE(reports.empty());
  for (const double fraction : reports)
  {
    EXPECT_EQ(fraction, 0.25);
  }
}

// The call is released only after the abort, so an abort that waited for it would never return.
TEST_F(AbortableCall, AnAbortDoesNotWaitForTheWork)
{
  HeldCall call;
  EXPECT_THROW(RunAbortably(AlwaysAbort, call.Work()), Aborted);
  EXPECT_FALSE(*call.Ended);
  EXPECT_EQ(JoinFinishedCalls(), std::size_t{ 1 });
  call.Release.set_value();
  EXPECT_TRUE(Eventually([] { return JoinFinishedCalls() == 0; }));
  EXPECT_TRUE(*call.Ended);
}

TEST_F(AbortableCall, ALaterCallRunsBesideAnAbandonedOne)
{
  HeldCall call;
  EXPECT_THROW(RunAbortably(AlwaysAbort, call.Work()), Aborted);
  EXPECT_EQ(RunAbortably(Progress(), [] { return 3; }), 3);
  EXPECT_FALSE(*call.Ended);
  call.Release.set_value();
  EXPECT_TRUE(Eventually([] { return JoinFinishedCalls() == 0; }));
}

TEST_F(AbortableCall, AnAbandonedCallFreesItsMemoryWhenItEnds)
{
  HeldCall call;
  auto owned = std::make_shared<int>(0);
  const std::weak_ptr<int> alive = owned;
  auto work = [owned = std::move(owned), work = call.Work()] { return work() + *owned; };
  EXPECT_THROW(RunAbortably(AlwaysAbort, std::move(work)), Aborted);
  EXPECT_FALSE(alive.expired());
  call.Release.set_value();
  EXPECT_TRUE(Eventually([&alive] { return alive.expired(); }));
  EXPECT_TRUE(Eventually([] { return JoinFinishedCalls() == 0; }));
}

TEST_F(AbortableCall, AnAbandonedCallMayThrow)
{
  HeldCall call;
  auto work = [work = call.Work()]() -> int
  {
    work();
    throw std::out_of_range("nobody sees this");
  };
  EXPECT_THROW(RunAbortably(AlwaysAbort, std::move(work)), Aborted);
  call.Release.set_value();
  EXPECT_TRUE(Eventually([] { return JoinFinishedCalls() == 0; }));
}

// What an abandoned call uses must exist until it ends, so the end of the program waits for it.
TEST(AbortableCallDeathTest, TheEndOfTheProgramWaitsForAnAbandonedCall)
{
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  const auto abortAndExit = []
  {
    try
    {
      RunAbortably(AlwaysAbort,
        []
        {
          std::this_thread::sleep_for(std::chrono::milliseconds(500));
          std::cerr << "the call has ended" << std::endl;
        });
    }
    catch (const Aborted&)
    {
      std::cerr << "aborted; ";
      std::exit(0);
    }
  };
  EXPECT_EXIT(abortAndExit(), testing::ExitedWithCode(0), "aborted; the call has ended");
}

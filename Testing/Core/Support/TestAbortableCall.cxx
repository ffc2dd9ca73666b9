// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Support/AbortableCall.h"
#include "Core/Support/Errors.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <string>
#include <thread>

using namespace spectralwatermark;

TEST(AbortableCall, ReturnsWhatTheWorkReturns)
{
  EXPECT_EQ(RunAbortably(Progress(), [] { return std::string("done"); }), "done");
}

TEST(AbortableCall, RunsOnAThreadOfItsOwn)
{
  EXPECT_NE(RunAbortably(Progress(), [] { return std::this_thread::get_id(); }),
    std::this_thread::get_id());
}

TEST(AbortableCall, ThrowsWhatTheWorkThrows)
{
  EXPECT_THROW(RunAbortably(Progress(), []() -> int { throw InvalidInput("no"); }), InvalidInput);
  EXPECT_THROW(RunAbortably(Progress(), []() -> int { throw SolverFailure("no"); }), SolverFailure);
}

// The work of these owns the flag, since it may outlive the call.
TEST(AbortableCall, AsksMeanwhileWhetherToStop)
{
  const auto isOver = std::make_shared<std::atomic<bool>>(false);
  int asked = 0;
  const Progress progress(
    [&](double fraction)
    {
      EXPECT_EQ(fraction, 0.25);
      *isOver = ++asked >= 2;
      return true;
    });
  const auto work = [isOver]
  {
    while (!*isOver)
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return 5;
  };
  EXPECT_EQ(RunAbortably(progress.Part(0.25, 0.75), work), 5);
  EXPECT_GE(asked, 2);
}

TEST(AbortableCall, ThrowsAbortedWhenAskedToStop)
{
  const auto isAborted = std::make_shared<std::atomic<bool>>(false);
  const Progress progress(
    [&](double)
    {
      *isAborted = true;
      return false;
    });
  const auto work = [isAborted]
  {
    while (!*isAborted)
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    return 5;
  };
  EXPECT_THROW(RunAbortably(progress, work), Aborted);
}

// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Support/Errors.h"

#include <gtest/gtest.h>

#include <type_traits>

using namespace spectralwatermark;

TEST(Errors, TextsJoinThePartsThatAreThere)
{
  EXPECT_STREQ(InvalidInput("Size", "it is 3", "take 4").what(), "Size: it is 3; take 4");
  EXPECT_STREQ(InvalidInput("", "the mesh is empty", "load one").what(),
    "the mesh is empty; load one");
  EXPECT_STREQ(InvalidInput("Size", "it is 3", "").what(), "Size: it is 3");
  EXPECT_STREQ(SolverFailure("it did not converge").what(), "it did not converge");
}

TEST(Errors, PartsCanBeReadOneByOne)
{
  try
  {
    throw InvalidInput("Size", "it is 3", "take 4");
  }
  catch (const Failure& failure)
  {
    EXPECT_EQ(failure.Parameter, "Size");
    EXPECT_EQ(failure.Reason, "it is 3");
    EXPECT_EQ(failure.Advice, "take 4");
  }
  EXPECT_EQ(SolverFailure("it did not converge", "take fewer").Parameter, "");
  EXPECT_EQ(SolverFailure("it did not converge", "take fewer").Advice, "take fewer");
}

TEST(Errors, AbortingIsNoFailure)
{
  EXPECT_FALSE((std::is_base_of_v<Failure, Aborted>));
}

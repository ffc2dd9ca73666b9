// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Support/Text.h"

#include <gtest/gtest.h>

#include <iomanip>

using namespace spectralwatermark;

TEST(Text, PartsFollowOneAnother)
{
  EXPECT_EQ(TextOf(), "");
  EXPECT_EQ(TextOf("point ", 17, " of ", 42), "point 17 of 42");
}

TEST(Text, ManipulatorsSetTheFormatOfWhatFollows)
{
  EXPECT_EQ(TextOf(std::setprecision(3), 0.123456, " %"), "0.123 %");
  EXPECT_EQ(TextOf(std::scientific, std::setprecision(1), 0.00026), "2.6e-04");
}

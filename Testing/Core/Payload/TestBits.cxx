// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Payload/Bits.h"
#include "Support/CoreTesting.h"

#include <gtest/gtest.h>

using namespace spectralwatermark;

TEST(Bits, OtherCharactersAreRefused)
{
  coretesting::ExpectRefusal([] { CheckMessage("10x10"); },
    "a character other than 0 and 1 at position 3");
  EXPECT_NO_THROW(CheckMessage("0110"));
  EXPECT_NO_THROW(CheckMessage(""));
}

TEST(Bits, AgreementsAreCountedPlaceByPlace)
{
  EXPECT_EQ(CountAgreements("10110", "10110"), 5);
  EXPECT_EQ(CountAgreements("10110", "01001"), 0);
  EXPECT_EQ(CountAgreements("10110", "10011"), 3);
  EXPECT_EQ(CountAgreements("", ""), 0);
}

// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Payload/BitAgreement.h"
#include "Core/Payload/Bits.h"
#include "Support/PValues.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

using namespace spectralwatermark;
using pvalues::TailByEnumeration;

namespace
{

const UnmarkedModel FairCoins{ 0.5, 0.5 };

} // namespace

TEST(BitAgreement, FairCoinsGiveTheBinomialTail)
{
  EXPECT_NEAR(AgreementPValue("10110", "10110", FairCoins), 1.0 / 32.0, 1e-15);
  EXPECT_NEAR(AgreementPValue("10111", "10110", FairCoins), 6.0 / 32.0, 1e-14);
  EXPECT_DOUBLE_EQ(AgreementPValue("01001", "10110", FairCoins), 1.0);
  // 51 of 64 are needed for one in a million.
  const std::string expected(64, '1');
  const std::string agrees51 = std::string(51, '1') + std::string(13, '0');
  const std::string agrees50 = std::string(50, '1') + std::string(14, '0');
  EXPECT_LT(AgreementPValue(agrees51, expected, FairCoins), 1e-6);
  EXPECT_GT(AgreementPValue(agrees50, expected, FairCoins), 1e-6);
}

TEST(BitAgreement, UnfairBitsGiveThePoissonBinomialTail)
{
  const UnmarkedModel unfair{ 0.6, 0.52 };
  const std::string expected = "1011001";
  std::vector<double> probability;
  for (const char bit : expected)
  {
    probability.push_back(bit == '1' ? 0.52 : 0.6);
  }
  const std::vector<double> ones(expected.size(), 1.0);
  for (const char* read : { "1011001", "1111001", "0100110", "1010010" })
  {
    const auto agreements = static_cast<double>(CountAgreements(read, expected));
    EXPECT_NEAR(AgreementPValue(read, expected, unfair),
      TailByEnumeration(ones, probability, agreements), 1e-14)
      << read;
  }
}

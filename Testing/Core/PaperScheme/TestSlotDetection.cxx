// SPDX-License-Identifier: BSD-3-Clause
#include "Core/PaperScheme/SlotDetection.h"
#include "Core/PaperScheme/Slots.h"
#include "Core/Payload/BitAgreement.h"
#include "Core/Support/Random.h"
#include "Support/FullTests.h"
#include "Support/PValues.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace spectralwatermark;
using pvalues::TailByEnumeration;

namespace
{

const UnmarkedModel FairCoins{ 0.5, 0.5 };

SlotReading Reading(double relative, double deviation = 0.4)
{
  SlotReading reading;
  reading.Average = 2.0;
  reading.Magnitude = 2.0 * (1.0 + relative);
  reading.Deviation = 2.0 * deviation;
  return reading;
}

SlotOptions Keyed(std::size_t bits)
{
  SlotOptions options;
  options.Keystream.assign(bits, '0');
  options.KeyedPositions.assign(bits, 5);
  return options;
}

} // namespace

// Without a key, 0 is the likelier: agreeing in zeros proves less than agreeing in ones.
TEST(SlotDetection, KeyMakesThePValueExactAndWithoutOneItIsLarger)
{
  const UnmarkedModel keyed = UnmarkedModelOf(Keyed(5));
  EXPECT_EQ(keyed.ZeroAtMost, 0.5);
  EXPECT_EQ(keyed.OneAtMost, 0.5);
  for (const SlotDivision division : { SlotDivision::Normal, SlotDivision::InterleavedNarrow })
  {
    SlotOptions open;
    open.Division = division;
    const UnmarkedModel unkeyed = UnmarkedModelOf(open);
    EXPECT_GT(AgreementPValue("00000", "00000", unkeyed), 1.0 / 32.0);
    EXPECT_GT(AgreementPValue("00000", "00000", unkeyed),
      AgreementPValue("11111", "11111", unkeyed));
  }
}

TEST(SlotDetection, WeightedTailAgreesWithEnumeration)
{
  std::vector<SlotReading> readings;
  for (const double relative : { 0.9, -0.5, 0.05, 0.4, -0.1, 1.7, -0.8 })
  {
    readings.push_back(Reading(relative));
  }
  const std::string expected = "1011011";
  for (const SlotOptions& options : { SlotOptions(), Keyed(7) })
  {
    std::vector<double> weights;
    std::vector<double> probability;
    double reached = 0.0;
    const UnmarkedModel unmarked = UnmarkedModelOf(options);
    for (std::size_t i = 0; i < readings.size(); ++i)
    {
      const SlotLikelihood likelihood = LikelihoodOf(readings[i], options);
      const int bit = readings[i].Bit();
      weights.push_back(std::max(0.0, likelihood.Of(bit) - likelihood.Of(1 - bit)));
      probability.push_back(expected[i] == '1' ? unmarked.OneAtMost : unmarked.ZeroAtMost);
      reached += bit == expected[i] - '0' ? weights.back() : 0.0;
    }
    EXPECT_NEAR(WeightedAgreementPValue(readings, options, expected),
      TailByEnumeration(weights, probability, reached), 1e-12);
  }
}

// With equal evidence in every slot, weighing changes nothing.
TEST(SlotDetection, EqualWeightsAreHardDecisions)
{
  const std::vector<SlotReading> readings(6, Reading(0.5));
  EXPECT_NEAR(WeightedAgreementPValue(readings, Keyed(6), "111101"),
    AgreementPValue("111111", "111101", FairCoins), 1e-14);
}

// Over many fair messages, p <= alpha happens with probability alpha at most, for any readings.
TEST(SlotDetection, PValuesAreCalibratedUnderAKey)
{
  constexpr int bits = 24;
  const int trials = QuickOrFull(5000, 20000);
  std::vector<SlotReading> readings;
  for (std::uint64_t i = 0; i < bits; ++i)
  {
    readings.push_back(Reading(0.5 * NormalRandom(1, i)));
  }
  const SlotOptions options = Keyed(bits);
  int hard = 0;
  int soft = 0;
  for (int trial = 0; trial < trials; ++trial)
  {
    std::string message;
    for (std::uint64_t i = 0; i < bits; ++i)
    {
      message += NormalRandom(static_cast<std::uint64_t>(2 + trial), i) > 0.0 ? '1' : '0';
    }
    hard += AgreementPValue(MessageOf(readings), message, FairCoins) <= 0.01 ? 1 : 0;
    soft += WeightedAgreementPValue(readings, options, message) <= 0.01 ? 1 : 0;
  }
  const double allowed = 0.01 * trials + 4.0 * std::sqrt(0.01 * trials);
  EXPECT_LT(hard, allowed);
  EXPECT_LT(soft, allowed);
  EXPECT_GT(soft, 0.5 * 0.01 * trials); // and not by never being that small
}

// Each density is one: its integral over the relative magnitude is 1, from 0 to where nothing is
// left, but for the normal tail that the model has below a magnitude of 0.
TEST(SlotDetection, LikelihoodsAreDensities)
{
  for (const BitEmbedding embedding : { BitEmbedding::Aggressive, BitEmbedding::NonAggressive })
  {
    SlotOptions options;
    options.Embedding = embedding;
    double zero = 0.0;
    double one = 0.0;
    double unmarked = 0.0;
    const double step = 0.002;
    for (double u = -8.0; u < 8.0; u += step)
    {
      const SlotLikelihood likelihood = LikelihoodOf(Reading(u), options);
      zero += step * std::exp(likelihood.Zero);
      one += step * std::exp(likelihood.One);
      unmarked += step * std::exp(likelihood.Unmarked);
    }
    EXPECT_NEAR(zero, 1.0, 1e-6);
    EXPECT_NEAR(one, 1.0, 1e-6);
    EXPECT_NEAR(unmarked, 1.0, 1e-6);
  }
}

TEST(SlotDetection, EvidenceGrowsWithTheMarginAndFollowsTheKeystream)
{
  const SlotOptions options;
  double previous = -100.0;
  for (const double relative : { -0.9, -0.4, 0.0, 0.3, 0.8 })
  {
    const SlotLikelihood likelihood = LikelihoodOf(Reading(relative), options);
    EXPECT_GT(likelihood.One - likelihood.Zero, previous);
    previous = likelihood.One - likelihood.Zero;
  }
  SlotReading inverted = Reading(0.8);
  inverted.Inverted = true;
  const SlotLikelihood plain = LikelihoodOf(Reading(0.8), options);
  const SlotLikelihood opposite = LikelihoodOf(inverted, options);
  EXPECT_EQ(plain.One, opposite.Zero);
  EXPECT_EQ(plain.Zero, opposite.One);
  EXPECT_EQ(LogLikelihoodRatio({ inverted }, options, "0"),
    LogLikelihoodRatio({ Reading(0.8) }, options, "1"));
}

TEST(SlotDetection, ExtremeSlotsStayFinite)
{
  SlotOptions options;
  options.TurbulenceFactor = 1000.0;
  for (const double relative : { -1.0, 0.0, 1e3, 1e8 })
  {
    const SlotLikelihood likelihood = LikelihoodOf(Reading(relative, 3.0), options);
    EXPECT_TRUE(std::isfinite(likelihood.Zero)) << relative;
    EXPECT_TRUE(std::isfinite(likelihood.One)) << relative;
  }
  const SlotLikelihood silent = LikelihoodOf(SlotReading(), options);
  EXPECT_EQ(silent.Zero, silent.One);
  EXPECT_EQ(WeightedAgreementPValue({ SlotReading() }, Keyed(1), "0"), 0.5);
}

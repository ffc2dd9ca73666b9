// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Harmonics/Transform.h"
#include "Core/PaperScheme/Slots.h"
#include "Support/CoreTesting.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

using namespace spectralwatermark;
using coretesting::ExpectRefusal;

TEST(Slots, PaperSlotsAreComponents21To70)
{
  const SlotOptions slots;
  EXPECT_EQ(ComponentsNeeded(slots, 5), 70);
  // Magnitude k is k: carriers 25, 35, ...; references 21..29 without 25.
  const Eigen::VectorXd magnitudes = Eigen::VectorXd::LinSpaced(70, 1.0, 70.0);
  const std::vector<SlotReading> readings = ReadSlots(magnitudes, slots, 5);
  ASSERT_EQ(readings.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i)
  {
    EXPECT_EQ(readings[i].Component, 25 + 10 * static_cast<Index>(i));
    EXPECT_DOUBLE_EQ(readings[i].Magnitude, 25.0 + 10.0 * static_cast<double>(i));
    EXPECT_DOUBLE_EQ(readings[i].Average, readings[i].Magnitude);
    EXPECT_NEAR(readings[i].Deviation, std::sqrt(60.0 / 8.0), 1e-12);
    EXPECT_EQ(readings[i].Bit(), 0); // c = a reads 0
  }
}

TEST(Slots, NarrowSlotsUseTheNeighboursOnly)
{
  SlotOptions slots;
  slots.Division = SlotDivision::InterleavedNarrow;
  Eigen::VectorXd magnitudes = Eigen::VectorXd::Constant(70, 100.0);
  magnitudes[23] = 3.0; // components 24 and 26
  magnitudes[25] = 7.0;
  magnitudes[24] = 6.0;
  const SlotReading reading = ReadSlots(magnitudes, slots, 5).front();
  EXPECT_DOUBLE_EQ(reading.Average, 5.0);
  EXPECT_DOUBLE_EQ(reading.Deviation, 2.0);
  EXPECT_DOUBLE_EQ(reading.Margin(), 0.5);
  EXPECT_EQ(reading.Bit(), 1);
}

// Figure 8: components 45 to 54, carrier 50.
TEST(Slots, FigureEightSlotIsCarriedByComponent50)
{
  SlotOptions slots;
  slots.FirstComponent = 45;
  slots.CarrierPosition = 6;
  EXPECT_EQ(ReadSlots(Eigen::VectorXd::Ones(54), slots, 1).front().Component, 50);
  EXPECT_EQ(ComponentsNeeded(slots, 1), 54);
}

TEST(Slots, TargetsFollowEquations10And11)
{
  SlotReading reading;
  reading.Average = 10.0;
  reading.Deviation = 2.0;
  SlotOptions aggressive;
  SlotOptions gentle;
  gentle.Embedding = BitEmbedding::NonAggressive;
  const auto target = [&reading](double magnitude, int bit, const SlotOptions& options)
  {
    reading.Magnitude = magnitude;
    return TargetMagnitude(reading, bit, options);
  };
  EXPECT_EQ(target(13.0, 1, aggressive), 13.0); // c > a + s d stays
  EXPECT_EQ(target(11.0, 1, aggressive), 12.0); // a < c < a + s d moves
  EXPECT_EQ(target(9.0, 0, aggressive), 8.0);
  EXPECT_EQ(target(7.0, 0, aggressive), 7.0);
  EXPECT_EQ(target(11.0, 1, gentle), 11.0); // right side already: stays
  EXPECT_EQ(target(9.0, 1, gentle), 12.0);
  EXPECT_EQ(target(9.0, 0, gentle), 9.0);
  EXPECT_EQ(target(11.0, 0, gentle), 8.0);
  aggressive.TurbulenceFactor = 6.0;
  EXPECT_EQ(target(9.0, 0, aggressive), 0.0); // a magnitude is not negative
}

TEST(Slots, ChangeKeepsTheDirectionAndMovesTheMagnitude)
{
  Spectrum spectrum = Spectrum::Random(30, 3);
  spectrum.row(24) *= 0.01;
  SlotOptions slots;
  const std::vector<SlotReading> readings = ReadSlots(Magnitudes(spectrum), slots, 1);
  const Spectrum changed = spectrum + SpectrumChange(spectrum, readings, "1", slots);
  EXPECT_NEAR(changed.row(24).norm(), readings[0].Average + readings[0].Deviation, 1e-14);
  EXPECT_NEAR(changed.row(24).normalized().dot(spectrum.row(24).normalized()), 1.0, 1e-12);
  for (Index k = 0; k < 30; ++k)
  {
    if (k != 24)
    {
      EXPECT_EQ((changed.row(k) - spectrum.row(k)).norm(), 0.0);
    }
  }
  spectrum.row(24).setZero();
  const Spectrum fromZero =
    SpectrumChange(spectrum, ReadSlots(Magnitudes(spectrum), slots, 1), "1", slots);
  EXPECT_EQ(fromZero(24, 0), fromZero(24, 1));
  EXPECT_GT(fromZero(24, 2), 0.0);
}

TEST(Slots, ContradictoryOptionsAreRefused)
{
  SlotOptions slots;
  const auto expectRefusal = [&slots](Index bits, const std::string& piece)
  { ExpectRefusal([&] { CheckSlots(slots, bits); }, piece); };
  expectRefusal(0, "the message is empty");
  for (const int position : { 1, 10 })
  {
    slots.CarrierPosition = position;
    expectRefusal(5,
      "position " + std::to_string(position) + " is not inside a slot of 10 components");
  }
  slots = SlotOptions();
  slots.SlotSize = 3;
  slots.CarrierPosition = 2;
  expectRefusal(5, "slots of 3 components have no room for references");
  slots = SlotOptions();
  slots.FirstComponent = 1;
  expectRefusal(5, "component 1 is constant");
  slots = SlotOptions();
  slots.TurbulenceFactor = std::nan("");
  expectRefusal(5, "the value is negative or not finite");
  ExpectRefusal([] { CheckSlotsAboveKernel(SlotOptions(), 44); }, "the mesh has 44 components");
  EXPECT_NO_THROW(CheckSlotsAboveKernel(SlotOptions(), 20));
}

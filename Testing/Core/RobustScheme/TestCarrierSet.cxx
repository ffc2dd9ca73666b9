// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Payload/SecretKey.h"
#include "Core/RobustScheme/CarrierSet.h"
#include "Core/RobustScheme/FrameAlignment.h"
#include "Core/RobustScheme/SolidFrame.h"
#include "Core/RobustScheme/SolidSpectrum.h"
#include "Core/Support/Errors.h"
#include "Support/RobustTesting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

using namespace spectralwatermark;
using robusttesting::Host;

TEST(CarrierSet, SpreadsEvenlyAndDependsOnTheKey)
{
  const SecretKey key("one");
  const CarrierSet carriers = CarriersOf(key, 64);
  EXPECT_EQ(carriers.Count(), 168); // 7 words of the code
  EXPECT_EQ(carriers.CheckBits, 20);
  EXPECT_EQ(carriers.Waves.rows(), 84);
  double nearest = 1e9;
  for (Index a = 0; a < carriers.Waves.rows(); ++a)
  {
    EXPECT_GT(carriers.Waves.row(a).norm(), 2.99);
    for (Index b = 0; b < a; ++b)
    {
      nearest = std::min({ nearest, (carriers.Waves.row(a) - carriers.Waves.row(b)).norm(),
        (carriers.Waves.row(a) + carriers.Waves.row(b)).norm() });
    }
  }
  EXPECT_GT(nearest, 2.0);
  EXPECT_GE(carriers.Dither.minCoeff(), 0.0);
  EXPECT_LT(carriers.Dither.maxCoeff(), 1.0);
  EXPECT_EQ(CarriersOf(SecretKey("one"), 64).Waves, carriers.Waves);
  EXPECT_NE(CarriersOf(SecretKey("two"), 64).Waves, carriers.Waves);
  EXPECT_NE(CarriersOf(SecretKey("two"), 64).Dither, carriers.Dither);
  EXPECT_NE(CarriersOf(SecretKey("two"), 64).Whitening, carriers.Whitening);
  EXPECT_THROW(CarriersOf(key, 0), InvalidInput);
  EXPECT_THROW(CarriersOf(key, LargestMessage + 1), InvalidInput);
  EXPECT_EQ(CarriersOf(key, LargestMessage).Count(), 24 * 87);
}

// For a mesh without the mark every bit is a fair coin of the key: at one step, with one frame, the
// agreements of many keys are binomial.
TEST(CarrierSet, BitsOfUnmarkedMeshesAreFairCoins)
{
  constexpr int keys = 400;
  const TriangleMesh mesh = Host(2);
  TriangleMesh inFrame = mesh;
  inFrame.Points = FrameOf(mesh).ToFrame(mesh.Points);
  double agreements = 0.0;
  double squares = 0.0;
  double count = 0.0;
  for (int k = 0; k < keys; ++k)
  {
    const SecretKey key("key " + std::to_string(k));
    const CarrierSet carriers = CarriersOf(key, 4); // 48 carriers
    const std::string code = CodeOf(DataOf("1010", key, carriers.CheckBits));
    const Eigen::VectorXd values = SolidSpectrum(inFrame, carriers.Waves, 1);
    count = static_cast<double>(carriers.Count());
    double agree = 0.0;
    for (Index j = 0; j < carriers.Count(); ++j)
    {
      const auto at = static_cast<std::size_t>(j);
      // Nearest to a point of the lattice for 0 or of the one for 1?
      const double place = values[j] / StepOfNumber(12) - carriers.Dither[j];
      const bool one = std::abs(place - std::round(place)) > 0.25;
      agree += (one != (carriers.Whitening[at] == '1')) == (code[at] == '1') ? 1.0 : 0.0;
    }
    agreements += agree / keys;
    squares += agree * agree / keys;
  }
  EXPECT_NEAR(agreements, 0.5 * count, 5.0 * std::sqrt(0.25 * count / keys));
  const double variance = squares - agreements * agreements;
  EXPECT_NEAR(variance, 0.25 * count, 5.0 * 0.25 * count * std::sqrt(2.0 / keys));
}

TEST(CarrierSet, MessageAndCheckFillWholeWords)
{
  for (const Index bits : { 1, 4, 5, 16, 64, 400, 1024 })
  {
    const Index words = WordsOf(bits);
    EXPECT_EQ(bits + CheckBitsOf(bits), 12 * words) << bits;
    EXPECT_GE(CheckBitsOf(bits), 20) << bits; // one wrong reading in a million is taken for right
    EXPECT_LT(CheckBitsOf(bits), 32) << bits;
    EXPECT_GE(MessageBitsOf(words), bits);
    EXPECT_EQ(WordsOf(MessageBitsOf(words)), words);
  }
  EXPECT_EQ(MessageBitsOf(1), 0);
  EXPECT_EQ(MessageBitsOf(1000), LargestMessage);
}

// Without noise the decoder undoes the code, whose words are spread over the carriers.
TEST(CarrierSet, CodeIsInterleavedWordByWord)
{
  const std::string data = SecretKey("any").Message(36);
  const std::string code = CodeOf(data);
  ASSERT_EQ(code.size(), 72u);
  for (std::size_t word = 0; word < 3; ++word)
  {
    for (std::size_t bit = 0; bit < 12; ++bit)
    {
      EXPECT_EQ(code[bit * 3 + word], data[12 * word + bit]) << word << ", " << bit;
    }
  }
  Eigen::VectorXd soft(72);
  for (Index j = 0; j < 72; ++j)
  {
    soft[j] = code[j] == '0' ? 1.0 : -1.0;
  }
  double fit = 0.0;
  EXPECT_EQ(Decode(soft, fit), data);
  EXPECT_EQ(fit, 1.0);
}

TEST(CarrierSet, StepsAreAGeometricSeries)
{
  const double ratio = StepOfNumber(1) / StepOfNumber(0);
  EXPECT_GT(ratio, 1.0);
  for (int number = 1; number < NumberOfSteps; ++number)
  {
    EXPECT_NEAR(StepOfNumber(number) / StepOfNumber(number - 1), ratio, 1e-12) << number;
  }
}

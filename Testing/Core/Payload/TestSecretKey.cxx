// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Payload/SecretKey.h"
#include "Support/CoreTesting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <new>
#include <numeric>
#include <set>

using namespace spectralwatermark;

// Meshes marked today must be found by every later version: these never change. The Python tests
// derive them a second time, from hashlib and a ChaCha20 of their own.
TEST(SecretKey, DerivationIsPinned)
{
  const SecretKey key("correct horse battery staple");
  EXPECT_EQ(key.CarrierPositions(12, 10),
    (std::vector<Eigen::Index>{ 4, 4, 3, 5, 3, 4, 8, 9, 6, 6, 3, 4 }));
  EXPECT_EQ(key.Keystream(32), "01110001111010101111100001101111");
  EXPECT_EQ(key.Message(64), "1011100010100001100011000110001100101010001111111001111011100000");
}

TEST(SecretKey, DerivationForTheRobustSchemeIsPinned)
{
  const SecretKey key("a secret");
  EXPECT_EQ(key.WaveNumbers(3),
    (std::vector<double>{ 0.33367837748338514, 0.33219131956536208, 0.52929921256007972 }));
  EXPECT_EQ(key.Dither(3),
    (std::vector<double>{ 0.065948233430544678, 0.13304546307218301, 0.80515901715596139 }));
  EXPECT_EQ(key.CarrierKeystream(24), "100101111111101001101111");
  EXPECT_EQ(key.Check("10110", 24), "100000101010110011001000");
  EXPECT_NE(key.Check("10111", 24), key.Check("10110", 24));
}

TEST(SecretKey, LongerStreamsBeginWithShorterOnes)
{
  const SecretKey key("a secret");
  EXPECT_EQ(key.Keystream(100).substr(0, 13), key.Keystream(13));
  EXPECT_EQ(key.Message(64).substr(0, 5), key.Message(5));
  const auto longer = key.CarrierPositions(40, 10);
  const auto shorter = key.CarrierPositions(7, 10);
  EXPECT_TRUE(std::equal(shorter.begin(), shorter.end(), longer.begin()));
}

TEST(SecretKey, PurposesDoNotShareAStream)
{
  const SecretKey key("a secret");
  EXPECT_NE(key.Keystream(128), key.Message(128));
}

TEST(SecretKey, OneCharacterChangesEverything)
{
  const std::string a = SecretKey("secret 1").Message(256);
  const std::string b = SecretKey("secret 2").Message(256);
  const auto agreements = std::inner_product(a.begin(), a.end(), b.begin(), 0, std::plus<>(),
    [](char x, char y) { return x == y ? 1 : 0; });
  EXPECT_NEAR(agreements, 128, 40); // five standard deviations
}

// Chi-square over all positions and fair coins over many keys, at five standard deviations.
TEST(SecretKey, PositionsAndCoinsAreFair)
{
  constexpr int keys = 500;
  constexpr int slots = 16;
  std::array<int, 8> counts{};
  int ones = 0;
  for (int i = 0; i < keys; ++i)
  {
    const SecretKey key("key " + std::to_string(i));
    for (const Eigen::Index position : key.CarrierPositions(slots, 10))
    {
      ASSERT_GE(position, 2);
      ASSERT_LE(position, 9);
      ++counts[static_cast<std::size_t>(position - 2)];
    }
    const std::string coins = key.Keystream(slots);
    ones += static_cast<int>(std::count(coins.begin(), coins.end(), '1'));
  }
  const double expected = keys * slots / 8.0;
  double chiSquare = 0.0;
  for (const int count : counts)
  {
    chiSquare += (count - expected) * (count - expected) / expected;
  }
  EXPECT_LT(chiSquare, 7.0 + 5.0 * std::sqrt(14.0));
  EXPECT_NEAR(ones, keys * slots / 2, 5.0 * std::sqrt(keys * slots / 4.0));
}

TEST(SecretKey, SmallestSlotHasTwoPlaces)
{
  const std::vector<Eigen::Index> positions = SecretKey("x").CarrierPositions(100, 4);
  EXPECT_EQ(std::set<Eigen::Index>(positions.begin(), positions.end()),
    (std::set<Eigen::Index>{ 2, 3 }));
}

TEST(SecretKey, EmptyIsRefused)
{
  coretesting::ExpectRefusal([] { SecretKey(""); }, "the secret is empty");
}

// On the heap, which an emptied string keeps: what was there can be looked at.
TEST(SecretKey, WipingLeavesZeros)
{
  std::string secret(64, 's');
  const char* characters = secret.data();
  Wipe(secret);
  EXPECT_TRUE(secret.empty());
  ASSERT_EQ(secret.data(), characters);
  EXPECT_EQ(std::count(characters, characters + 64, '\0'), 64);
}

TEST(SecretKey, DestroyedLeavesZeros)
{
  alignas(SecretKey) std::array<unsigned char, sizeof(SecretKey)> storage{};
  auto* key = new (storage.data()) SecretKey("a secret");
  EXPECT_LT(std::count(storage.begin(), storage.end(), 0), 8); // a hash: hardly a byte is zero
  key->~SecretKey();
  EXPECT_EQ(std::count(storage.begin(), storage.end(), 0), std::ptrdiff_t{ sizeof(SecretKey) });
}

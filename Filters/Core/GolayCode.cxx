// SPDX-License-Identifier: BSD-3-Clause
#include "GolayCode.h"

#include <vector>

namespace spectralwatermark
{

namespace
{

constexpr std::uint32_t Words = 1U << GolayDataBits;
constexpr std::uint32_t Generator = 0xae3; // of degree 11
constexpr int CheckBits = 11;

std::uint32_t Encode(std::uint32_t data)
{
  std::uint32_t remainder = data << CheckBits;
  for (int bit = GolayDataBits + CheckBits - 1; bit >= CheckBits; --bit)
  {
    if ((remainder >> bit & 1U) != 0)
    {
      remainder ^= Generator << (bit - CheckBits);
    }
  }
  const std::uint32_t word = data | remainder << GolayDataBits;
  std::uint32_t parity = 0;
  for (std::uint32_t rest = word; rest != 0; rest &= rest - 1)
  {
    parity ^= 1U;
  }
  return word | parity << (GolayCodeBits - 1);
}

const std::vector<std::uint32_t>& AllWords()
{
  static const std::vector<std::uint32_t> words = []()
  {
    std::vector<std::uint32_t> all;
    for (std::uint32_t data = 0; data < Words; ++data)
    {
      all.push_back(Encode(data));
    }
    return all;
  }();
  return words;
}

} // namespace

std::uint32_t GolayEncode(std::uint32_t data)
{
  return AllWords()[data % Words];
}

std::uint32_t GolayDecode(const std::array<double, GolayCodeBits>& soft, double& score)
{
  std::uint32_t best = 0;
  for (std::uint32_t data = 0; data < Words; ++data)
  {
    const std::uint32_t word = AllWords()[data];
    double sum = 0.0;
    for (std::size_t bit = 0; bit < soft.size(); ++bit)
    {
      sum += (word >> bit & 1U) != 0 ? -soft[bit] : soft[bit];
    }
    if (data == 0 || sum > score)
    {
      score = sum;
      best = data;
    }
  }
  return best;
}

} // namespace spectralwatermark

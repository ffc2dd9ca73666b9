// SPDX-License-Identifier: BSD-3-Clause
#include "GolayCode.h"

#include <array>
#include <numeric>

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

// The checks that go with each data.
std::array<std::uint32_t, Words> ChecksOfData()
{
  std::array<std::uint32_t, Words> checks{};
  for (std::uint32_t data = 0; data < Words; ++data)
  {
    checks[data] = Encode(data) >> GolayDataBits;
  }
  return checks;
}

// For all patterns of 12 bits, the sum of 12 soft bits with the signs that the pattern gives them. A
// word's fit is one of its data's sums and one of its checks': no need to add 24 for each word.
using HalfSums = std::array<float, Words>;

void SumHalves(const float* soft, HalfSums& sums)
{
  sums[0] = std::accumulate(soft, soft + GolayDataBits, 0.0F);
  for (int bit = 0; bit < GolayDataBits; ++bit)
  {
    const std::uint32_t one = 1U << bit;
    for (std::uint32_t pattern = 0; pattern < one; ++pattern)
    {
      sums[one + pattern] = sums[pattern] - 2.0F * soft[bit];
    }
  }
}

} // namespace

std::uint32_t GolayEncode(std::uint32_t data)
{
  return Encode(data % Words);
}

std::uint32_t GolayDecode(const Eigen::RowVectorXf& soft, float& fit)
{
  static const std::array<std::uint32_t, Words> checks = ChecksOfData();
  HalfSums ofData;
  HalfSums ofChecks;
  SumHalves(soft.data(), ofData);
  SumHalves(soft.data() + GolayDataBits, ofChecks);
  std::uint32_t best = 0;
  fit = ofData[0] + ofChecks[0];
  for (std::uint32_t data = 1; data < Words; ++data)
  {
    const float sum = ofData[data] + ofChecks[checks[data]];
    if (sum > fit)
    {
      fit = sum;
      best = data;
    }
  }
  return best;
}

} // namespace spectralwatermark

// SPDX-License-Identifier: BSD-3-Clause
#include "GolayCode.h"

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

} // namespace

std::uint32_t GolayEncode(std::uint32_t data)
{
  return Encode(data % Words);
}

const Eigen::MatrixXf& GolaySigns()
{
  static const Eigen::MatrixXf signs = []()
  {
    Eigen::MatrixXf all(GolayCodeBits, Words);
    for (std::uint32_t data = 0; data < Words; ++data)
    {
      const std::uint32_t word = Encode(data);
      for (int bit = 0; bit < GolayCodeBits; ++bit)
      {
        all(bit, data) = (word >> bit & 1U) != 0 ? -1.0F : 1.0F;
      }
    }
    return all;
  }();
  return signs;
}

std::uint32_t GolayDecode(const Eigen::RowVectorXf& soft, float& fit)
{
  Eigen::Index best = 0;
  fit = (soft * GolaySigns()).maxCoeff(&best);
  return static_cast<std::uint32_t>(best);
}

} // namespace spectralwatermark

// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Payload/GolayCode.h"
#include "Core/Support/Types.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>

using namespace spectralwatermark;

namespace
{

int WeightOf(std::uint32_t word)
{
  int weight = 0;
  for (; word != 0; word &= word - 1)
  {
    ++weight;
  }
  return weight;
}

// 1 for each 0 of a word, -1 for each 1.
Eigen::RowVectorXf SignsOf(std::uint32_t data)
{
  Eigen::RowVectorXf signs(GolayCodeBits);
  for (int bit = 0; bit < GolayCodeBits; ++bit)
  {
    signs[bit] = (GolayEncode(data) >> bit & 1U) != 0 ? -1.0F : 1.0F;
  }
  return signs;
}

} // namespace

// The weights of its words identify the extended Golay code.
TEST(GolayCode, HasTheWeightsOfTheGolayCode)
{
  std::map<int, int> weights;
  for (std::uint32_t data = 0; data < 4096; ++data)
  {
    EXPECT_EQ(GolayEncode(data) & 0xfffU, data);
    ++weights[WeightOf(GolayEncode(data))];
  }
  const std::map<int, int> expected = { { 0, 1 }, { 8, 759 }, { 12, 2576 }, { 16, 759 },
    { 24, 1 } };
  EXPECT_EQ(weights, expected);
}

TEST(GolayCode, DecodesToTheWordThatFitsBest)
{
  for (int trial = 0; trial < 40; ++trial)
  {
    const Eigen::RowVectorXf soft = Eigen::RowVectorXf::Random(GolayCodeBits);
    float best = -24.0F;
    for (std::uint32_t data = 0; data < 1U << GolayDataBits; ++data)
    {
      best = std::max(best, soft.dot(SignsOf(data)));
    }
    float fit = 0.0F;
    const std::uint32_t decoded = GolayDecode(soft, fit);
    EXPECT_NEAR(fit, best, 1e-5F);
    EXPECT_NEAR(soft.dot(SignsOf(decoded)), best, 1e-5F);
  }
}

TEST(GolayCode, FitsOfManyAreTheFitsOfEach)
{
  const Eigen::MatrixXf all = Eigen::MatrixXf::Random(7, 2 * GolayCodeBits);
  const Eigen::Map<const Eigen::MatrixXf, 0, Eigen::OuterStride<>> everyOther(all.data(), 7,
    GolayCodeBits, Eigen::OuterStride<>(14));
  const Eigen::VectorXf fits = GolayFits(everyOther);
  for (Index row = 0; row < 7; ++row)
  {
    float fit = 0.0F;
    GolayDecode(everyOther.row(row), fit);
    EXPECT_EQ(fits[row], fit);
  }
}

TEST(GolayCode, CorrectsThreeWrongBitsAndMoreWhenTheyAreWeak)
{
  for (const std::uint32_t data : { 0U, 1U, 0xabcU, 0xfffU })
  {
    const Eigen::RowVectorXf right = SignsOf(data);
    float score = 0.0F;
    EXPECT_EQ(GolayDecode(right, score), data);
    EXPECT_EQ(score, 24.0F);
    for (Index a = 0; a < right.size(); ++a)
    {
      for (Index b = 0; b < a; ++b)
      {
        for (Index c = 0; c < b; ++c)
        {
          Eigen::RowVectorXf wrong = right;
          wrong[a] *= -1.0F;
          wrong[b] *= -1.0F;
          wrong[c] *= -1.0F;
          ASSERT_EQ(GolayDecode(wrong, score), data);
        }
      }
    }
    Eigen::RowVectorXf weak = right;
    weak.head(6) *= -0.1F; // six wrong, but weakly
    EXPECT_EQ(GolayDecode(weak, score), data);
  }
}

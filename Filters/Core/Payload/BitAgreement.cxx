// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Payload/BitAgreement.h"

#include "Core/Payload/Bits.h"

#include <algorithm>
#include <utility>

namespace spectralwatermark
{

double WeightedTail(const std::vector<std::size_t>& weights,
  const std::vector<double>& probabilities, std::size_t reached)
{
  std::size_t total = 0;
  std::vector<double> distribution{ 1.0 };
  for (std::size_t i = 0; i < weights.size(); ++i)
  {
    total += weights[i];
    std::vector<double> next(total + 1, 0.0);
    for (std::size_t sum = 0; sum < distribution.size(); ++sum)
    {
      next[sum] += (1.0 - probabilities[i]) * distribution[sum];
      next[sum + weights[i]] += probabilities[i] * distribution[sum];
    }
    distribution = std::move(next);
  }
  // The smallest terms come first, so that rounding does not swallow them.
  double tail = 0.0;
  for (std::size_t sum = distribution.size(); sum-- > reached;)
  {
    tail += distribution[sum];
  }
  return std::min(1.0, tail);
}

double AgreementPValue(const std::string& read, const std::string& expected,
  const UnmarkedModel& unmarked)
{
  std::vector<double> probabilities;
  for (const char bit : expected)
  {
    probabilities.push_back(unmarked.AtMost(bit));
  }
  return WeightedTail(std::vector<std::size_t>(expected.size(), 1), probabilities,
    CountAgreements(read, expected));
}

} // namespace spectralwatermark

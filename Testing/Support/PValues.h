// SPDX-License-Identifier: BSD-3-Clause
/// Whether p-values are what they say.
#ifndef SpectralWatermark_Testing_PValues_h
#define SpectralWatermark_Testing_PValues_h

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace pvalues
{

/// P(X >= successes) for a binomial X.
inline double UpperTail(int trials, double chance, int successes)
{
  double tail = 0.0;
  for (int k = trials; k >= successes; --k)
  {
    tail += std::exp(std::lgamma(trials + 1.0) - std::lgamma(k + 1.0) -
      std::lgamma(trials - k + 1.0) + k * std::log(chance) + (trials - k) * std::log1p(-chance));
  }
  return tail;
}

/// The probability of every set of agreements, added where it reaches the weight that was seen.
inline double TailByEnumeration(const std::vector<double>& weights,
  const std::vector<double>& probability, double reached)
{
  double tail = 0.0;
  for (unsigned int set = 0; set < 1u << weights.size(); ++set)
  {
    double weight = 0.0;
    double chance = 1.0;
    for (std::size_t i = 0; i < weights.size(); ++i)
    {
      const bool agrees = (set >> i) % 2 == 1;
      weight += agrees ? weights[i] : 0.0;
      chance *= agrees ? probability[i] : 1.0 - probability[i];
    }
    tail += weight >= reached - 1e-9 ? chance : 0.0;
  }
  return tail;
}

/// Of keys that marked nothing: no more small ones than chance has, in one of a million tests.
inline void ExpectValid(const std::vector<double>& values)
{
  for (const double rate : { 0.5, 0.2, 0.05, 0.01, 0.001 })
  {
    const auto count = static_cast<int>(
      std::count_if(values.begin(), values.end(), [rate](double value) { return value <= rate; }));
    EXPECT_GT(UpperTail(static_cast<int>(values.size()), rate, count), 1e-6)
      << count << " of " << values.size() << " at " << rate;
  }
}

} // namespace pvalues

#endif

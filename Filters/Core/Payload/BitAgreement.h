// SPDX-License-Identifier: BSD-3-Clause
/// The probability that an unmarked mesh agrees with an expected message by chance.
#ifndef SpectralWatermark_Core_Payload_BitAgreement_h
#define SpectralWatermark_Core_Payload_BitAgreement_h

#include <cstddef>
#include <string>
#include <vector>

namespace spectralwatermark
{

/// Upper bounds of the probability of either bit in what an unmarked mesh reads. With a secret key, the
/// keystream makes both exactly 1/2, whatever the mesh.
struct UnmarkedModel
{
  double ZeroAtMost = 0.5;
  double OneAtMost = 0.5;

  double AtMost(char bit) const { return bit == '1' ? this->OneAtMost : this->ZeroAtMost; }
};

/// P(sum of w_i X_i >= reached) for independent X_i that are 1 with probability p_i.
double WeightedTail(const std::vector<std::size_t>& weights,
  const std::vector<double>& probabilities, std::size_t reached);

/// An upper bound of the probability that an unmarked mesh agrees with `expected` in at least as many bits
/// as `read` does: the tail of a Poisson binomial distribution.
double AgreementPValue(const std::string& read, const std::string& expected,
  const UnmarkedModel& unmarked);

} // namespace spectralwatermark

#endif

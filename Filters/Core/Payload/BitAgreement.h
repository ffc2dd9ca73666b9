// SPDX-License-Identifier: BSD-3-Clause
/// The probability that an unmarked mesh agrees with an expected message by chance.
#ifndef SpectralWatermark_Core_Payload_BitAgreement_h
#define SpectralWatermark_Core_Payload_BitAgreement_h

#include <cstddef>
#include <string>
#include <vector>

namespace spectralwatermark
{

/// How likely each bit is when an unmarked mesh is read: upper bounds of the two probabilities.
/// Under a secret key both are exactly 1/2 for every mesh, because the keystream whitens the bits.
struct UnmarkedModel
{
  double ZeroAtMost = 0.5;
  double OneAtMost = 0.5;

  /// The bound for one bit, given as the character 0 or 1.
  double AtMost(char bit) const { return bit == '1' ? this->OneAtMost : this->ZeroAtMost; }
};

/// The probability that a weighted sum of independent bits is at least `reached`: bit i is 1 with
/// probability probabilities[i] and adds weights[i]. Both vectors have the same length. The result
/// is exact up to rounding, in [0, 1]. The work grows with the number of bits times the sum of the
/// weights.
double WeightedTail(const std::vector<std::size_t>& weights,
  const std::vector<double>& probabilities, std::size_t reached);

/// The p-value of a reading: an upper bound of the probability that an unmarked mesh agrees with
/// `expected` in at least as many bits as `read` does. It is the tail of a Poisson binomial
/// distribution, exact where the bounds of `unmarked` are.
double AgreementPValue(const std::string& read, const std::string& expected,
  const UnmarkedModel& unmarked);

} // namespace spectralwatermark

#endif

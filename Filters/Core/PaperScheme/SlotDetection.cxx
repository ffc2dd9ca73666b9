// SPDX-License-Identifier: BSD-3-Clause
#include "Core/PaperScheme/SlotDetection.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace spectralwatermark
{

namespace
{

// The distribution of (c - a) / a on unmarked scans, where c is the carrier's magnitude and a the
// average of its references, measured on components 21 to 300 and taken for normal.
struct UnmarkedSpread
{
  double Mean;
  double Deviation;
};

UnmarkedSpread SpreadOf(SlotDivision division)
{
  return division == SlotDivision::Normal ? UnmarkedSpread{ 0.03, 0.56 }
                                          : UnmarkedSpread{ 0.14, 0.83 };
}

// The share of the marked slots in which attacks like the paper's mix neighbouring harmonics until
// nothing is left of the mark. Fitted to five attacked scans.
constexpr double LostShare = 0.3;

// The correlation of (c - a) / a before and after such attacks in the other marked slots. Fitted to
// five attacked scans.
constexpr double KeptCorrelation = 0.8;

// The number of steps to which WeightedAgreementPValue() rounds the weights: each is a multiple of
// their sum divided by this.
constexpr double WeightSteps = 20000.0;

// The logarithm of the normal density.
double LogNormal(double x, double mean, double deviation)
{
  const double z = (x - mean) / deviation;
  return -0.5 * z * z - std::log(deviation) - 0.5 * std::log(2.0 * Pi);
}

// The logarithm of P(Z > z) for a standard normal Z, without underflow.
double LogUpperTail(double z)
{
  if (z < 30.0)
  {
    return std::log(0.5 * std::erfc(z / std::sqrt(2.0)));
  }
  return LogNormal(z, 0.0, 1.0) - std::log(z);
}

// The logarithm of exp(a) + exp(b).
double LogSum(double a, double b)
{
  const double larger = std::max(a, b);
  return std::isinf(larger) ? larger : larger + std::log1p(std::exp(std::min(a, b) - larger));
}

// The logarithm of the density at x, after attacks, of a normal u whose values under `threshold`
// were moved to `target` by the embedding. Attacks draw u towards its mean and add noise that
// restores its spread, so that the distribution of an unmarked slot does not change.
double LogMarkedAbove(double x, const UnmarkedSpread& spread, double threshold, double target)
{
  const double attacked = spread.Deviation * std::sqrt(1.0 - KeptCorrelation * KeptCorrelation);
  const auto drawn = [&spread](double u)
  { return spread.Mean + KeptCorrelation * (u - spread.Mean); };
  const double unmarked = LogNormal(x, spread.Mean, spread.Deviation);
  // Conditioned on x after the attacks, u before them is normal with mean drawn(x) and deviation
  // `attacked`.
  const double stayed = unmarked + LogUpperTail((threshold - drawn(x)) / attacked);
  const double moved = LogUpperTail((spread.Mean - threshold) / spread.Deviation) +
    LogNormal(x, drawn(target), attacked);
  return LogSum(std::log(LostShare) + unmarked, std::log(1.0 - LostShare) + LogSum(stayed, moved));
}

// The logarithm of the density at u of a slot that holds a bit whose carrier lies above (side 1) or
// below (side -1) the average of its references, after attacks.
double LogMarked(double u, int side, const SlotReading& reading, const SlotOptions& options)
{
  const UnmarkedSpread spread = SpreadOf(options.Division);
  const double s = options.TurbulenceFactor * reading.Deviation / reading.Average;
  const double target = side > 0 ? s : std::max(-1.0, -s);
  const double threshold = options.Embedding == BitEmbedding::Aggressive ? target : 0.0;
  // A carrier below the average is the mirror image of one above it.
  return LogMarkedAbove(side * u, { side * spread.Mean, spread.Deviation }, side * threshold,
    side * target);
}

} // namespace

UnmarkedModel UnmarkedModelOf(const SlotOptions& options)
{
  if (!options.Keystream.empty())
  {
    return { 0.5, 0.5 };
  }
  return options.Division == SlotDivision::Normal ? UnmarkedModel{ 0.60, 0.52 }
                                                  : UnmarkedModel{ 0.57, 0.52 };
}

SlotLikelihood LikelihoodOf(const SlotReading& reading, const SlotOptions& options)
{
  SlotLikelihood likelihood;
  if (!(reading.Average > 0.0))
  {
    return likelihood;
  }
  const double u = reading.Magnitude / reading.Average - 1.0;
  const UnmarkedSpread spread = SpreadOf(options.Division);
  likelihood.Unmarked = LogNormal(u, spread.Mean, spread.Deviation);
  likelihood.Zero = LogMarked(u, reading.Inverted ? 1 : -1, reading, options);
  likelihood.One = LogMarked(u, reading.Inverted ? -1 : 1, reading, options);
  return likelihood;
}

double LogLikelihoodRatio(const std::vector<SlotReading>& readings, const SlotOptions& options,
  const std::string& expected)
{
  double ratio = 0.0;
  for (std::size_t slot = 0; slot < readings.size(); ++slot)
  {
    const SlotLikelihood likelihood = LikelihoodOf(readings[slot], options);
    ratio += likelihood.Of(expected[slot] - '0') - likelihood.Unmarked;
  }
  return ratio;
}

double WeightedAgreementPValue(const std::vector<SlotReading>& readings, const SlotOptions& options,
  const std::string& expected)
{
  const UnmarkedModel unmarked = UnmarkedModelOf(options);
  std::vector<double> evidence;
  double sum = 0.0;
  for (const SlotReading& reading : readings)
  {
    const SlotLikelihood likelihood = LikelihoodOf(reading, options);
    const int bit = reading.Bit();
    evidence.push_back(std::max(0.0, likelihood.Of(bit) - likelihood.Of(1 - bit)));
    sum += evidence.back();
  }
  const double step = sum / WeightSteps;
  std::vector<std::size_t> weights;
  std::vector<double> probabilities;
  std::size_t reached = 0;
  for (std::size_t slot = 0; slot < readings.size(); ++slot)
  {
    weights.push_back(
      step > 0.0 ? static_cast<std::size_t>(std::lround(evidence[slot] / step)) : std::size_t{ 1 });
    probabilities.push_back(unmarked.AtMost(expected[slot]));
    reached += readings[slot].Bit() == expected[slot] - '0' ? weights.back() : 0;
  }
  return WeightedTail(weights, probabilities, reached);
}

} // namespace spectralwatermark

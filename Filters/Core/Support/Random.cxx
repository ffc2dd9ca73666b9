// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Support/Random.h"

#include <cmath>
#include <numeric>
#include <utility>

namespace spectralwatermark
{

namespace
{

// SplitMix64 (Steele, Lea and Flood, "Fast Splittable Pseudorandom Number Generators", 2014):
// its output function turns a counter into well mixed bits.
std::uint64_t Mix(std::uint64_t x)
{
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

// A number in (0, 1) from the upper 53 bits; never 0.
double UniformOfBits(std::uint64_t bits)
{
  return (static_cast<double>(bits >> 11) + 0.5) * 0x1.0p-53;
}

} // namespace

double UniformRandom(std::uint64_t seed, std::uint64_t element)
{
  return UniformOfBits(Mix(Mix(seed) ^ element));
}

// By Box and Muller, because the distributions of the standard library differ between
// implementations.
double NormalRandom(std::uint64_t seed, std::uint64_t element)
{
  const std::uint64_t first = Mix(Mix(seed) ^ element);
  const double radius = std::sqrt(-2.0 * std::log(UniformOfBits(first)));
  const double angle = 2.0 * Pi * UniformOfBits(Mix(first));
  return radius * std::cos(angle);
}

std::vector<Index> RandomOrder(Index count, std::uint64_t seed)
{
  std::vector<Index> order(count);
  std::iota(order.begin(), order.end(), Index{ 0 });
  // By Fisher and Yates, because std::shuffle differs between implementations.
  for (Index k = count - 1; k > 0; --k)
  {
    const auto other = static_cast<Index>(
      UniformRandom(seed, static_cast<std::uint64_t>(k)) * static_cast<double>(k + 1));
    std::swap(order[k], order[other]);
  }
  return order;
}

} // namespace spectralwatermark

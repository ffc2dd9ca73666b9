// SPDX-License-Identifier: BSD-3-Clause
#include "GolayCode.h"

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace spectralwatermark
{

namespace
{

constexpr std::uint32_t Words = 1U << GolayDataBits;
constexpr std::uint32_t Generator = 0xae3; // of degree 11
constexpr int CheckBits = 11;

std::size_t WeightOf(std::uint32_t word)
{
  return std::bitset<GolayCodeBits>(word).count();
}

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
  return word | static_cast<std::uint32_t>(WeightOf(word) % 2) << (GolayCodeBits - 1);
}

constexpr int OctadBits = 8;
constexpr std::uint32_t AllOfOctad = (1U << OctadBits) - 1;
constexpr std::uint32_t AllOfWord = (1U << GolayCodeBits) - 1;

// The bits of a word at some places, the lowest place's first.
using Octad = std::array<int, OctadBits>;

Octad PlacesOf(std::uint32_t word)
{
  Octad places{};
  for (int place = 0, found = 0; place < GolayCodeBits; ++place)
  {
    if ((word >> place & 1U) != 0)
    {
      places[static_cast<std::size_t>(found++)] = place;
    }
  }
  return places;
}

std::uint32_t PatternIn(const Octad& places, std::uint32_t word)
{
  std::uint32_t pattern = 0;
  for (int bit = 0; bit < OctadBits; ++bit)
  {
    pattern |= (word >> places[static_cast<std::size_t>(bit)] & 1U) << bit;
  }
  return pattern;
}

std::uint32_t WordOf(const Octad& places, std::uint32_t pattern)
{
  std::uint32_t word = 0;
  for (int bit = 0; bit < OctadBits; ++bit)
  {
    word |= (pattern >> bit & 1U) << places[static_cast<std::size_t>(bit)];
  }
  return word;
}

// Three words of eight ones that together have all 24 (a trio). Adding one of them to a word turns the
// word's bits over in that octad alone, so the best of all 4096 words is found among the 512 whose last
// bit in each octad is 0: each octad then counts with its sum's magnitude, and is turned over where the
// sum is negative. After Conway and Sloane, "Soft decoding techniques for codes and lattices, including
// the Golay code and the Leech lattice", IEEE Trans. Inf. Theory 32 (1986).
struct Trio
{
  static constexpr std::size_t Parts = 3;
  std::array<Octad, Parts> Octads;
  std::vector<std::array<std::uint32_t, Parts>> Patterns; // of the 512 words

  Trio()
  {
    const std::uint32_t first = NextOctad(0);
    const std::uint32_t second = NextOctad(first);
    this->Octads = { PlacesOf(first), PlacesOf(second), PlacesOf(AllOfWord ^ first ^ second) };
    for (std::uint32_t data = 0; data < Words; ++data)
    {
      const std::uint32_t word = Encode(data);
      std::array<std::uint32_t, Parts> patterns{};
      for (std::size_t part = 0; part < Parts; ++part)
      {
        patterns[part] = PatternIn(this->Octads[part], word);
      }
      if (((patterns[0] | patterns[1] | patterns[2]) >> (OctadBits - 1)) == 0)
      {
        this->Patterns.push_back(patterns);
      }
    }
  }

private:
  // The first word of eight ones that has none of these.
  static std::uint32_t NextOctad(std::uint32_t taken)
  {
    for (std::uint32_t data = 0; data < Words; ++data)
    {
      const std::uint32_t word = Encode(data);
      if ((word & taken) == 0 && WeightOf(word) == OctadBits)
      {
        return word;
      }
    }
    throw std::logic_error("no octad"); // every octad of the Golay code is part of a trio
  }
};

// For all patterns of an octad whose last bit is 0, the sum of its soft bits with their signs.
using OctadSums = std::array<float, 1U << (OctadBits - 1)>;

OctadSums SumsOf(const Octad& places, const SoftWord& soft)
{
  OctadSums sums;
  sums[0] = 0.0F;
  for (const int place : places)
  {
    sums[0] += soft[place];
  }
  for (std::size_t bit = 0; bit < OctadBits - 1; ++bit)
  {
    const std::size_t one = std::size_t{ 1 } << bit;
    const float both = 2.0F * soft[places[bit]];
    std::transform(sums.data(), sums.data() + one, sums.data() + one,
      [both](float sum) { return sum - both; });
  }
  return sums;
}

} // namespace

std::uint32_t GolayEncode(std::uint32_t data)
{
  return Encode(data % Words);
}

std::uint32_t GolayDecode(const SoftWord& soft, float& fit)
{
  static const Trio trio;
  std::array<OctadSums, Trio::Parts> sums;
  for (std::size_t part = 0; part < Trio::Parts; ++part)
  {
    sums[part] = SumsOf(trio.Octads[part], soft);
  }
  const auto magnitude = [&sums](std::size_t part, std::uint32_t pattern)
  { return std::abs(sums[part][pattern]); };
  const auto* best = &trio.Patterns.front();
  fit = -std::numeric_limits<float>::infinity();
  for (const auto& patterns : trio.Patterns)
  {
    const float sum =
      magnitude(0, patterns[0]) + magnitude(1, patterns[1]) + magnitude(2, patterns[2]);
    if (sum > fit)
    {
      fit = sum;
      best = &patterns;
    }
  }
  std::uint32_t word = 0;
  for (std::size_t part = 0; part < Trio::Parts; ++part)
  {
    const std::uint32_t pattern = (*best)[part];
    word |= WordOf(trio.Octads[part], sums[part][pattern] < 0.0F ? pattern ^ AllOfOctad : pattern);
  }
  return word % Words;
}

} // namespace spectralwatermark

// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Payload/GolayCode.h"

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

// The number of code words.
constexpr std::uint32_t Words = 1U << GolayDataBits;

// The coefficients of the generator polynomial.
constexpr std::uint32_t Generator = 0xae3;

// The degree of the generator polynomial: the number of check bits without the parity bit.
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

// An octad is the set of places where a code word of weight 8 has its ones.
constexpr int OctadBits = 8;
constexpr std::uint32_t AllOfOctad = (1U << OctadBits) - 1;
constexpr std::uint32_t AllOfWord = (1U << GolayCodeBits) - 1;

// The places of an octad in ascending order.
using Octad = std::array<int, OctadBits>;

Octad PlacesOf(std::uint32_t word)
{
  Octad places{};
  for (int place = 0, found = 0; place < GolayCodeBits; ++place)
  {
    if ((word >> place & 1U) != 0)
    {
      places[found++] = place;
    }
  }
  return places;
}

// The bits of a word at the places of an octad, as a number of 8 bits.
std::uint32_t PatternIn(const Octad& places, std::uint32_t word)
{
  std::uint32_t pattern = 0;
  for (int bit = 0; bit < OctadBits; ++bit)
  {
    pattern |= (word >> places[bit] & 1U) << bit;
  }
  return pattern;
}

// The word that has this pattern at the places of an octad, and 0 elsewhere.
std::uint32_t WordOf(const Octad& places, std::uint32_t pattern)
{
  std::uint32_t word = 0;
  for (int bit = 0; bit < OctadBits; ++bit)
  {
    word |= (pattern >> bit & 1U) << places[bit];
  }
  return word;
}

// Three octads that together cover all 24 places (a trio), and the code words relative to them.
//
// Adding one of the three octads to a code word inverts the word's bits within that octad alone.
// The best of all 4096 words is therefore found among the 512 whose last bit in each octad is 0:
// each octad contributes the magnitude of its sum, and is inverted where the sum is negative. After
// Conway and Sloane, "Soft decoding techniques for codes and lattices, including the Golay code and
// the Leech lattice", IEEE Trans. Inf. Theory 32 (1986).
struct Trio
{
  static constexpr std::size_t Parts = 3;
  std::array<Octad, Parts> Octads;
  // The pattern of each of the 512 words in each octad.
  std::vector<std::array<std::uint32_t, Parts>> Patterns;

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
  // The first octad that is disjoint from `taken`.
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
    // Never reached: every octad of the Golay code is part of a trio.
    throw std::logic_error("no octad");
  }
};

// The signed sums of the soft bits in an octad: a row per word, and a column for each pattern whose
// last bit is 0. A soft bit is negated where the pattern has a 1.
Eigen::ArrayXXf SumsOf(const Octad& places, const SoftWords& soft)
{
  Eigen::ArrayXXf sums(soft.rows(), Eigen::Index{ 1 } << (OctadBits - 1));
  sums.col(0).setZero();
  for (const int place : places)
  {
    sums.col(0) += soft.col(place).array();
  }
  for (std::size_t bit = 0; bit < OctadBits - 1; ++bit)
  {
    const Eigen::Index one = Eigen::Index{ 1 } << bit;
    const Eigen::ArrayXf both = 2.0F * soft.col(places[bit]).array();
    sums.middleCols(one, one) = sums.leftCols(one).colwise() - both;
  }
  return sums;
}

using SumsOfTrio = std::array<Eigen::ArrayXXf, Trio::Parts>;

SumsOfTrio SumsOf(const Trio& trio, const SoftWords& soft)
{
  SumsOfTrio sums;
  for (std::size_t part = 0; part < Trio::Parts; ++part)
  {
    sums[part] = SumsOf(trio.Octads[part], soft);
  }
  return sums;
}

const Trio& TheTrio()
{
  static const Trio trio;
  return trio;
}

} // namespace

std::uint32_t GolayEncode(std::uint32_t data)
{
  return Encode(data % Words);
}

std::uint32_t GolayDecode(const SoftWords& soft, float& fit)
{
  const Trio& trio = TheTrio();
  const SumsOfTrio sums = SumsOf(trio, soft);
  const auto magnitude = [&sums](std::size_t part, std::uint32_t pattern)
  { return std::abs(sums[part](0, pattern)); };
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
    const bool isInverted = sums[part](0, pattern) < 0.0F;
    word |= WordOf(trio.Octads[part], isInverted ? pattern ^ AllOfOctad : pattern);
  }
  return word % Words;
}

Eigen::VectorXf GolayFits(const SoftWords& soft)
{
  const Trio& trio = TheTrio();
  SumsOfTrio magnitudes = SumsOf(trio, soft);
  for (Eigen::ArrayXXf& part : magnitudes)
  {
    part = part.abs().eval();
  }
  Eigen::ArrayXf fits =
    Eigen::ArrayXf::Constant(soft.rows(), -std::numeric_limits<float>::infinity());
  for (const auto& patterns : trio.Patterns)
  {
    fits = fits.max(magnitudes[0].col(patterns[0]) + magnitudes[1].col(patterns[1]) +
      magnitudes[2].col(patterns[2]));
  }
  return fits;
}

} // namespace spectralwatermark

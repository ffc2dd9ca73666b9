// SPDX-License-Identifier: BSD-3-Clause
#include "Core/RobustScheme/CarrierSet.h"

#include "Core/Payload/GolayCode.h"
#include "Core/Support/Errors.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace spectralwatermark
{

namespace
{

using Eigen::MatrixXd;
using Eigen::VectorXd;

// The smallest length of a check, in bits. A check of this length holds for a random message once
// in a million.
constexpr Index LeastCheckBits = 20;

// The inner radius of the shell that the wave vectors fill evenly, in 1 / scale of the frame.
// Closer to the origin the transform of the solid itself is large, so that a small shift or
// rotation of the frame changes a carrier a lot.
constexpr double InnerRadius = 3.0;

// The volume of the shell for each wave vector, in 1 / (scale of the frame)^3. Waves that are
// closer to each other are too similar on the surface.
constexpr double VolumePerWave = 220.0;

// The number of candidates that best-candidate sampling draws for each wave vector.
constexpr Index CandidatesPerWave = 64;

// The smallest quantisation step, in (scale of the frame)^3.
constexpr double SmallestStep = 2.5e-4;

// The ratio of consecutive quantisation steps: 2^(1/8).
constexpr double StepRatio = 1.0905077326652577;

// Best-candidate sampling (Mitchell, 1991): each wave vector is the candidate that is farthest from
// all earlier ones. A vector and its opposite are the same wave.
MatrixXd EvenWaves(const std::vector<double>& numbers, Index count)
{
  const double inner = std::pow(InnerRadius, 3);
  const double shell = VolumePerWave * static_cast<double>(count) * 3.0 / (4.0 * Pi);
  MatrixXd waves(count, 3);
  auto number = numbers.begin();
  for (Index w = 0; w < count; ++w)
  {
    double farthest = -1.0;
    for (Index candidate = 0; candidate < CandidatesPerWave; ++candidate)
    {
      const double radius = std::cbrt(inner + shell * *number++);
      const double height = 2.0 * *number++ - 1.0;
      const double angle = 2.0 * Pi * *number++;
      const double around = std::sqrt(1.0 - height * height);
      const Eigen::RowVector3d wave =
        radius * Eigen::RowVector3d(around * std::cos(angle), around * std::sin(angle), height);
      // The candidate's own opposite is a neighbour too.
      double nearest = 4.0 * wave.squaredNorm();
      for (Index other = 0; other < w; ++other)
      {
        nearest = std::min({ nearest, (waves.row(other) - wave).squaredNorm(),
          (waves.row(other) + wave).squaredNorm() });
      }
      if (nearest > farthest)
      {
        farthest = nearest;
        waves.row(w) = wave;
      }
    }
  }
  return waves;
}

} // namespace

Index WordsOf(Index messageBits)
{
  return (messageBits + LeastCheckBits + GolayDataBits - 1) / GolayDataBits;
}

Index MessageBitsOf(Index words)
{
  return std::clamp<Index>(words * GolayDataBits - LeastCheckBits, 0, LargestMessage);
}

Index CheckBitsOf(Index messageBits)
{
  return WordsOf(messageBits) * GolayDataBits - messageBits;
}

double StepOfNumber(int number)
{
  return SmallestStep * std::pow(StepRatio, number);
}

CarrierSet CarriersOf(const SecretKey& key, Index messageBits)
{
  if (messageBits < 1 || messageBits > LargestMessage)
  {
    throw InvalidInput("NumberOfBits",
      "the robust scheme takes messages of 1 to " + std::to_string(LargestMessage) + " bits, not " +
        std::to_string(messageBits),
      "choose a message of such a length");
  }
  const Index blocks = WordsOf(messageBits);
  const Index count = GolayCodeBits * blocks;
  CarrierSet carriers;
  carriers.MessageBits = messageBits;
  carriers.CheckBits = CheckBitsOf(messageBits);
  carriers.Waves = EvenWaves(key.WaveNumbers(3 * CandidatesPerWave * count / 2), count / 2);
  const std::vector<double> dither = key.Dither(count);
  carriers.Dither = Eigen::Map<const VectorXd>(dither.data(), count);
  carriers.Whitening = key.CarrierKeystream(count);
  return carriers;
}

std::string DataOf(const std::string& message, const SecretKey& key, Index checkBits)
{
  return message + key.Check(message, checkBits);
}

std::string CodeOf(const std::string& data)
{
  const std::size_t words = data.size() / GolayDataBits;
  std::string code(words * GolayCodeBits, '0');
  for (std::size_t w = 0; w < words; ++w)
  {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < GolayDataBits; ++i)
    {
      bits |= (data[GolayDataBits * w + i] == '1' ? 1U : 0U) << i;
    }
    const std::uint32_t word = GolayEncode(bits);
    for (std::size_t i = 0; i < GolayCodeBits; ++i)
    {
      code[i * words + w] = (word >> i & 1U) != 0 ? '1' : '0';
    }
  }
  return code;
}

} // namespace spectralwatermark

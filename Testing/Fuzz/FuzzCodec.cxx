// SPDX-License-Identifier: BSD-3-Clause
// Messages with their checks through the code and back, with as many wrong bits as it mends; soft bits
// of any kind; secrets of any bytes.
#include "Core/Payload/GolayCode.h"
#include "Core/Payload/SecretKey.h"
#include "Core/RobustScheme/CarrierSet.h"
#include "Core/RobustScheme/FrameAlignment.h"
#include "Core/Support/Errors.h"
#include "Fuzz/Require.h"
#include "Support/Bytes.h"

#include <cmath>

namespace sw = spectralwatermark;
using fuzzing::Require;

namespace
{

bool IsBits(const std::string& text)
{
  return text.find_first_not_of("01") == std::string::npos;
}

// As SolidEmbedding lays them out, without the waves, which take long and hold no bits.
sw::CarrierSet Layout(sw::Index messageBits, sw::Index words)
{
  sw::CarrierSet carriers;
  carriers.MessageBits = messageBits;
  carriers.CheckBits = sw::GolayDataBits * words - messageBits;
  return carriers;
}

// Three wrong bits of each word's 24 are mended, and the message comes back.
void CheckRoundTrip(fuzzing::Bytes& bytes)
{
  constexpr int mended = 3;
  const std::string secret = "secret" + std::to_string(bytes.Byte());
  const sw::SecretKey key(secret);
  const std::string message = '1' + bytes.Bits(60);
  const auto bits = static_cast<sw::Index>(message.size());
  const sw::Index words = (bits + 20 + sw::GolayDataBits - 1) / sw::GolayDataBits;
  const std::string data = sw::DataOf(message, key, Layout(bits, words).CheckBits);
  Require(IsBits(data) && static_cast<sw::Index>(data.size()) == sw::GolayDataBits * words,
    "data is not words of bits");
  const std::string code = sw::CodeOf(data);
  Require(IsBits(code) && static_cast<sw::Index>(code.size()) == sw::GolayCodeBits * words,
    "code is not words of bits");
  Eigen::VectorXd soft(static_cast<sw::Index>(code.size()));
  for (sw::Index j = 0; j < soft.size(); ++j)
  {
    soft[j] = code[static_cast<std::size_t>(j)] == '0' ? 1.0 : -1.0;
  }
  for (sw::Index word = 0; word < words; ++word)
  {
    for (int k = 0; k < mended; ++k) // the same bit twice is none
    {
      soft[bytes.Below(sw::GolayCodeBits) * words + word] *= -1.0;
    }
  }
  double fit = 0.0;
  Require(sw::Decode(soft, fit) == data, "three wrong bits of a word were not mended");
  Require(fit >= 0.75 - 1e-6 && fit <= 1.0 + 1e-6,
    "the fit is not that of three wrong bits or fewer");
}

float FitOf(const Eigen::RowVectorXf& soft, std::uint32_t data)
{
  const std::uint32_t word = sw::GolayEncode(data);
  float fit = 0.0F;
  for (int bit = 0; bit < sw::GolayCodeBits; ++bit)
  {
    fit += (word >> bit & 1U) != 0 ? -soft[bit] : soft[bit];
  }
  return fit;
}

// Any soft bits decode to some data, and to the word that fits them best.
void CheckAnySoftBits(fuzzing::Bytes& bytes)
{
  Eigen::RowVectorXf soft(sw::GolayCodeBits);
  for (float& value : soft)
  {
    value = bytes.Flag() ? static_cast<float>(2.0 * bytes.Share() - 1.0)
                         : static_cast<float>(bytes.Below(3) - 1);
  }
  float fit = 0.0F;
  const std::uint32_t data = sw::GolayDecode(soft, fit);
  Require(data < (1U << sw::GolayDataBits), "decoded to more than 12 bits");
  Require(std::abs(FitOf(soft, data) - fit) <= 1e-4F, "the fit is another word's");
  for (int k = 0; k < 16; ++k)
  {
    Require(FitOf(soft, static_cast<std::uint32_t>(bytes.Below(4096))) <= fit + 1e-4F,
      "another word fits better");
  }
}

void CheckSecret(fuzzing::Bytes& bytes)
{
  std::string secret(static_cast<std::size_t>(bytes.Below(300)), '\0');
  for (char& character : secret)
  {
    character = static_cast<char>(bytes.Byte());
  }
  try
  {
    const sw::SecretKey key(secret);
    Require(!secret.empty(), "an empty secret was taken");
    const std::string message = key.Message(64);
    Require(message == sw::SecretKey(secret).Message(64) && IsBits(message) && message.size() == 64,
      "a message is not 64 bits of its secret");
    Require(key.Message(40) == message.substr(0, 40),
      "a longer stream does not begin with the shorter");
    Require(key.Check(message, 20) == key.Check(message, 256).substr(0, 20), "checks differ");
    secret += '!';
    Require(sw::SecretKey(secret).Message(64) != message, "two secrets have the same message");
  }
  catch (const sw::InvalidInput&)
  {
    Require(secret.empty(), "a secret was refused");
  }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  fuzzing::Bytes bytes(data, size);
  switch (bytes.Below(3))
  {
    case 0:
      CheckRoundTrip(bytes);
      break;
    case 1:
      CheckAnySoftBits(bytes);
      break;
    default:
      CheckSecret(bytes);
  }
  return 0;
}

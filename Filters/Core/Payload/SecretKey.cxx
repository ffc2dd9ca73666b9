// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Payload/SecretKey.h"

#include "Core/Support/Errors.h"

#include <sodium.h>

#include <cstdint>

namespace spectralwatermark
{

namespace
{

// The BLAKE2b key under which the secret is hashed to the master key.
constexpr char MasterLabel[] = "SpectralWatermark v1";

// The context of crypto_kdf, which separates these seeds from those of other programs.
constexpr char KdfContext[crypto_kdf_CONTEXTBYTES + 1] = "SpecWM_1";

// The number of bytes of a stream from which one random number is made.
constexpr std::size_t WordSize = 8;

// What a seed is used for. The numbers are part of the derivation and must never change.
enum Purpose : std::uint64_t
{
  Positions = 1,
  Whitening = 2,
  OwnMessage = 3,
  Waves = 4,
  Dithers = 5,
  CarrierWhitening = 6,
  MessageCheck = 7
};

void InitializeSodium()
{
  if (sodium_init() < 0)
  {
    throw SolverFailure("libsodium could not be initialised");
  }
}

} // namespace

SecretKey::SecretKey(const std::string& secret)
{
  if (secret.empty())
  {
    throw InvalidInput("SecretKey", "the secret is empty", "give at least one character");
  }
  InitializeSodium();
  crypto_generichash(this->Master.data(), this->Master.size(),
    reinterpret_cast<const unsigned char*>(secret.data()), secret.size(),
    reinterpret_cast<const unsigned char*>(MasterLabel), sizeof(MasterLabel) - 1);
}

SecretKey::~SecretKey()
{
  sodium_memzero(this->Master.data(), this->Master.size());
}

std::array<unsigned char, 32> SecretKey::Seed(std::uint64_t purpose) const
{
  static_assert(crypto_kdf_KEYBYTES == 32 && randombytes_SEEDBYTES == 32);
  std::array<unsigned char, 32> seed{};
  crypto_kdf_derive_from_key(seed.data(), seed.size(), purpose, KdfContext, this->Master.data());
  return seed;
}

std::vector<unsigned char> SecretKey::Stream(std::uint64_t purpose, std::size_t size) const
{
  std::array<unsigned char, 32> seed = this->Seed(purpose);
  std::vector<unsigned char> stream(size);
  randombytes_buf_deterministic(stream.data(), stream.size(), seed.data());
  sodium_memzero(seed.data(), seed.size());
  return stream;
}

namespace
{

// The stream as words of eight bytes, little-endian on every platform.
std::vector<std::uint64_t> Words(const std::vector<unsigned char>& stream)
{
  std::vector<std::uint64_t> words;
  for (std::size_t begin = 0; begin + WordSize <= stream.size(); begin += WordSize)
  {
    std::uint64_t word = 0;
    for (std::size_t byte = WordSize; byte-- > 0;)
    {
      word = (word << 8) | stream[begin + byte];
    }
    words.push_back(word);
  }
  return words;
}

// The first bits of the bytes, the lowest bit of each byte first.
std::string FirstBits(const unsigned char* bytes, Eigen::Index bits)
{
  std::string text;
  for (Eigen::Index i = 0; i < bits; ++i)
  {
    text += (bytes[i / 8] >> (i % 8)) % 2 == 1 ? '1' : '0';
  }
  return text;
}

} // namespace

std::vector<Eigen::Index> SecretKey::CarrierPositions(Eigen::Index slots,
  Eigen::Index slotSize) const
{
  std::vector<Eigen::Index> positions;
  for (const std::uint64_t word : Words(this->Stream(Positions, WordSize * slots)))
  {
    positions.push_back(
      2 + static_cast<Eigen::Index>(word % static_cast<std::uint64_t>(slotSize - 2)));
  }
  return positions;
}

std::vector<double> SecretKey::Uniform(std::uint64_t purpose, Eigen::Index count) const
{
  std::vector<double> numbers;
  for (const std::uint64_t word : Words(this->Stream(purpose, WordSize * count)))
  {
    numbers.push_back(static_cast<double>(word >> 11) * 0x1.0p-53);
  }
  return numbers;
}

std::vector<double> SecretKey::WaveNumbers(Eigen::Index count) const
{
  return this->Uniform(Waves, count);
}

std::vector<double> SecretKey::Dither(Eigen::Index count) const
{
  return this->Uniform(Dithers, count);
}

std::string SecretKey::Bits(std::uint64_t purpose, Eigen::Index bits) const
{
  return FirstBits(this->Stream(purpose, (bits + 7) / 8).data(), bits);
}

std::string SecretKey::Keystream(Eigen::Index bits) const
{
  return this->Bits(Whitening, bits);
}

std::string SecretKey::Message(Eigen::Index bits) const
{
  return this->Bits(OwnMessage, bits);
}

std::string SecretKey::CarrierKeystream(Eigen::Index bits) const
{
  return this->Bits(CarrierWhitening, bits);
}

std::string SecretKey::Check(const std::string& message, Eigen::Index bits) const
{
  std::array<unsigned char, 32> seed = this->Seed(MessageCheck);
  std::array<unsigned char, 32> hash{};
  crypto_generichash(hash.data(), hash.size(),
    reinterpret_cast<const unsigned char*>(message.data()), message.size(), seed.data(),
    seed.size());
  sodium_memzero(seed.data(), seed.size());
  return FirstBits(hash.data(), bits);
}

void Wipe(std::string& secret)
{
  if (!secret.empty())
  {
    sodium_memzero(secret.data(), secret.size());
    secret.clear();
  }
}

} // namespace spectralwatermark

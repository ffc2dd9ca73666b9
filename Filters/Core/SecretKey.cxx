// SPDX-License-Identifier: BSD-3-Clause
#include "SecretKey.h"

#include "Errors.h"

#include <sodium.h>

#include <cstdint>

namespace spectralwatermark
{

namespace
{

constexpr char MasterLabel[] = "SpectralWatermark v1";
constexpr char KdfContext[crypto_kdf_CONTEXTBYTES + 1] = "SpecWM_1";

enum Purpose : std::uint64_t
{
  Positions = 1,
  Whitening = 2,
  OwnMessage = 3
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
    throw InvalidInput("the secret key is empty");
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

std::vector<unsigned char> SecretKey::Stream(std::uint64_t purpose, std::size_t size) const
{
  static_assert(crypto_kdf_KEYBYTES == 32 && randombytes_SEEDBYTES == 32);
  std::array<unsigned char, randombytes_SEEDBYTES> seed{};
  crypto_kdf_derive_from_key(seed.data(), seed.size(), purpose, KdfContext, this->Master.data());
  std::vector<unsigned char> stream(size);
  randombytes_buf_deterministic(stream.data(), stream.size(), seed.data());
  sodium_memzero(seed.data(), seed.size());
  return stream;
}

std::vector<Eigen::Index> SecretKey::CarrierPositions(Eigen::Index slots,
  Eigen::Index slotSize) const
{
  constexpr std::size_t wordSize = 8;
  const std::vector<unsigned char> stream =
    this->Stream(Positions, wordSize * static_cast<std::size_t>(slots));
  std::vector<Eigen::Index> positions;
  for (std::size_t slot = 0; slot < static_cast<std::size_t>(slots); ++slot)
  {
    std::uint64_t word = 0; // little-endian on every platform
    for (std::size_t byte = wordSize; byte-- > 0;)
    {
      word = (word << 8) | stream[wordSize * slot + byte];
    }
    positions.push_back(
      2 + static_cast<Eigen::Index>(word % static_cast<std::uint64_t>(slotSize - 2)));
  }
  return positions;
}

std::string SecretKey::Bits(std::uint64_t purpose, Eigen::Index bits) const
{
  const auto count = static_cast<std::size_t>(bits);
  const std::vector<unsigned char> stream = this->Stream(purpose, (count + 7) / 8);
  std::string text;
  for (std::size_t i = 0; i < count; ++i)
  {
    text += (stream[i / 8] >> (i % 8)) % 2 == 1 ? '1' : '0';
  }
  return text;
}

std::string SecretKey::Keystream(Eigen::Index bits) const
{
  return this->Bits(Whitening, bits);
}

std::string SecretKey::Message(Eigen::Index bits) const
{
  return this->Bits(OwnMessage, bits);
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

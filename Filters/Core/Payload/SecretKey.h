// SPDX-License-Identifier: BSD-3-Clause
/// Everything that a secret decides, derived from it by libsodium alone.
#ifndef SpectralWatermark_Core_Payload_SecretKey_h
#define SpectralWatermark_Core_Payload_SecretKey_h

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace spectralwatermark
{

/// A secret, and the streams derived from it. Version 1 of the derivation, never to change:
///
///     master = BLAKE2b-256(secret, key "SpectralWatermark v1")         crypto_generichash
///     seed_p = BLAKE2b-256(master; salt p, personal "SpecWM_1")        crypto_kdf
///     stream_p = ChaCha20(seed_p, nonce "LibsodiumDRG")                randombytes_buf_deterministic
///
/// with one stream for each purpose p: 1 positions, 2 keystream, 3 message; for the robust scheme 4
/// wave vectors, 5 dither, 6 whitening. A longer stream begins with the shorter one. A message's
/// check is BLAKE2b-256(message, key seed_7). The memory of master and seeds is cleared.
class SecretKey
{
public:
  /// Throws InvalidInput when the secret is empty.
  explicit SecretKey(const std::string& secret);
  ~SecretKey();
  SecretKey(const SecretKey&) = delete;
  SecretKey& operator=(const SecretKey&) = delete;

  /// For each slot a carrier position from 2 to slotSize - 1, uniform (to 2^-60).
  std::vector<Eigen::Index> CarrierPositions(Eigen::Index slots, Eigen::Index slotSize) const;

  /// Fair coins, 0 or 1, that whiten a message of this length.
  std::string Keystream(Eigen::Index bits) const;

  /// The message of this length that stands for the secret itself.
  std::string Message(Eigen::Index bits) const;

  /// Numbers in [0, 1), uniform, with 53 bits: for wave vectors and for dithers.
  std::vector<double> WaveNumbers(Eigen::Index count) const;
  std::vector<double> Dither(Eigen::Index count) const;

  /// Fair coins, 0 or 1, that whiten what the carriers of the robust scheme hold.
  std::string CarrierKeystream(Eigen::Index bits) const;

  /// Up to 256 bits that only this secret and this message give.
  std::string Check(const std::string& message, Eigen::Index bits) const;

private:
  std::array<unsigned char, 32> Seed(std::uint64_t purpose) const;
  std::vector<double> Uniform(std::uint64_t purpose, Eigen::Index count) const;
  std::vector<unsigned char> Stream(std::uint64_t purpose, std::size_t size) const;
  std::string Bits(std::uint64_t purpose, Eigen::Index bits) const;

  std::array<unsigned char, 32> Master{};
};

/// Overwrites a string's characters before it lets them go.
void Wipe(std::string& secret);

} // namespace spectralwatermark

#endif

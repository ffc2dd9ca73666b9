// SPDX-License-Identifier: BSD-3-Clause
/// A secret key and the random streams that libsodium derives from it.
#ifndef SpectralWatermark_Core_Payload_SecretKey_h
#define SpectralWatermark_Core_Payload_SecretKey_h

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace spectralwatermark
{

/// A secret key, from which every key-dependent choice of both schemes is derived.
///
/// The derivation is version 1 and must never change, because marked meshes depend on it:
///
///     master   = BLAKE2b-256(secret, key "SpectralWatermark v1")    crypto_generichash
///     seed_p   = BLAKE2b-256(master; salt p, personal "SpecWM_1")   crypto_kdf
///     stream_p = ChaCha20(seed_p, nonce "LibsodiumDRG")             randombytes_buf_deterministic
///
/// Each purpose p has a stream of its own: 1 carrier positions, 2 keystream and 3 message; for the
/// robust scheme 4 wave vectors, 5 dither and 6 whitening. A longer stream begins with the shorter
/// one. The check of a message is BLAKE2b-256(message, key seed_7). The memory that held the master
/// key or a seed is cleared.
class SecretKey
{
public:
  /// Throws InvalidInput when the secret is empty.
  explicit SecretKey(const std::string& secret);
  ~SecretKey();
  SecretKey(const SecretKey&) = delete;
  SecretKey& operator=(const SecretKey&) = delete;

  /// A carrier position for each slot, uniform over 2 to slotSize - 1 (with a bias below 2^-60).
  std::vector<Eigen::Index> CarrierPositions(Eigen::Index slots, Eigen::Index slotSize) const;

  /// The keystream that whitens a message of the paper's scheme: `bits` fair coins, 0 or 1.
  std::string Keystream(Eigen::Index bits) const;

  /// The message of `bits` bits that is derived from the secret.
  std::string Message(Eigen::Index bits) const;

  /// Uniform numbers in [0, 1) with 53 random bits, from which the robust scheme makes wave
  /// vectors.
  std::vector<double> WaveNumbers(Eigen::Index count) const;

  /// The dithers of the robust scheme: uniform numbers in [0, 1) with 53 random bits.
  std::vector<double> Dither(Eigen::Index count) const;

  /// The keystream that whitens the code bits of the robust scheme: `bits` fair coins, 0 or 1.
  std::string CarrierKeystream(Eigen::Index bits) const;

  /// The check of a message: `bits` bits, at most 256, that depend on the secret and the message.
  std::string Check(const std::string& message, Eigen::Index bits) const;

private:
  std::array<unsigned char, 32> Seed(std::uint64_t purpose) const;
  std::vector<double> Uniform(std::uint64_t purpose, Eigen::Index count) const;
  std::vector<unsigned char> Stream(std::uint64_t purpose, std::size_t size) const;
  std::string Bits(std::uint64_t purpose, Eigen::Index bits) const;

  std::array<unsigned char, 32> Master{};
};

/// Overwrites the characters of a string with zeros, then empties it.
void Wipe(std::string& secret);

} // namespace spectralwatermark

#endif

// SPDX-License-Identifier: BSD-3-Clause
/// Choices out of a fuzzer's bytes, which are all that decides a case.
#ifndef SpectralWatermark_Testing_Bytes_h
#define SpectralWatermark_Testing_Bytes_h

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

namespace fuzzing
{

/// Reads from the front; zeros once there is nothing left, so that every input is a case.
class Bytes
{
public:
  Bytes(const std::uint8_t* data, std::size_t size)
    : Next(data)
    , Left(size)
  {
  }

  bool AtEnd() const { return this->Left == 0; }

  std::uint8_t Byte()
  {
    if (this->Left == 0)
    {
      return 0;
    }
    --this->Left;
    return *this->Next++;
  }

  bool Flag() { return (this->Byte() & 1) != 0; }

  /// 0 to bound - 1; bound at most 65,536.
  int Below(int bound)
  {
    const int high = bound > 256 ? this->Byte() : 0;
    return (high * 256 + this->Byte()) % bound;
  }

  /// In [0, 1), in 65,536 steps.
  double Share() { return this->Below(65536) / 65536.0; }

  template <typename Number>
  Number Raw()
  {
    unsigned char bytes[sizeof(Number)];
    for (unsigned char& byte : bytes)
    {
      byte = this->Byte();
    }
    Number number;
    std::memcpy(&number, bytes, sizeof number);
    return number;
  }

  /// Up to `most` characters 0 and 1.
  std::string Bits(int most)
  {
    std::string bits(static_cast<std::size_t>(this->Below(most + 1)), '0');
    for (char& bit : bits)
    {
      bit = this->Flag() ? '1' : '0';
    }
    return bits;
  }

private:
  const std::uint8_t* Next;
  std::size_t Left;
};

} // namespace fuzzing

#endif

// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSpectralWatermarkAlgorithm.h"

#include "Core/PaperScheme/Slots.h"
#include "Core/Payload/SecretKey.h"
#include "Core/Support/Errors.h"
#include "Core/Support/MemoryBudget.h"

#include <fstream>

namespace sw = spectralwatermark;

vtkSpectralWatermarkAlgorithm::vtkSpectralWatermarkAlgorithm()
{
  this->SetNumberOfOutputPorts(2);
}

vtkSpectralWatermarkAlgorithm::~vtkSpectralWatermarkAlgorithm()
{
  sw::Wipe(this->SecretKey);
}

double vtkSpectralWatermarkAlgorithm::GetAvailableMemory()
{
  return sw::AvailableMemory();
}

namespace
{

std::string SecretInFile(const std::string& path)
{
  constexpr std::streamsize limit = 1 << 20;
  std::ifstream file(path, std::ios::binary);
  std::string secret(limit + 1, '\0');
  file.read(secret.data(), limit + 1);
  const std::streamsize size = file.gcount();
  if (!file.is_open() || file.bad() || (size == 0 && !file.eof()))
  {
    throw sw::InvalidInput("SecretKeyFile", "the file \"" + path + "\" cannot be read",
      "check its path and permissions");
  }
  if (size > limit)
  {
    throw sw::InvalidInput("SecretKeyFile", "the file \"" + path + "\" is over 1 MiB",
      "check that it is the right file");
  }
  secret.resize(size);
  for (const char ending : { '\n', '\r' })
  {
    if (!secret.empty() && secret.back() == ending)
    {
      secret.pop_back();
    }
  }
  if (secret.empty())
  {
    throw sw::InvalidInput("SecretKeyFile", "the file \"" + path + "\" is empty",
      "write the secret into it");
  }
  return secret;
}

} // namespace

void vtkSpectralWatermarkAlgorithm::SetSecretKey(const char* secret)
{
  const char* wanted = secret != nullptr ? secret : "";
  if (this->SecretKey != wanted)
  {
    sw::Wipe(this->SecretKey);
    this->SecretKey = wanted;
    this->Modified();
  }
}

void vtkSpectralWatermarkAlgorithm::SetSecretKeyFile(const char* path)
{
  const char* wanted = path != nullptr ? path : "";
  if (this->SecretKeyFile != wanted)
  {
    this->SecretKeyFile = wanted;
    this->Modified();
  }
}

int vtkSpectralWatermarkAlgorithm::GetHasSecretKey() const
{
  return this->SecretKey.empty() && this->SecretKeyFile.empty() ? 0 : 1;
}

const char* vtkSpectralWatermarkAlgorithm::GetSchemeAsString() const
{
  switch (this->Scheme)
  {
    case PaperSlots:
      return "PaperSlots";
    case Robust:
      return "Robust";
    default:
      return "Unknown";
  }
}

int vtkSpectralWatermarkAlgorithm::GetNumberOfBits() const
{
  constexpr int slots = 5;
  constexpr int robust = 64;
  return this->NumberOfBits > 0 ? this->NumberOfBits : this->Scheme == Robust ? robust : slots;
}

const char* vtkSpectralWatermarkAlgorithm::GetSlotDivisionAsString() const
{
  return this->SlotDivision == Normal ? "Normal" : "InterleavedNarrow";
}

const char* vtkSpectralWatermarkAlgorithm::GetBitEmbeddingAsString() const
{
  return this->BitEmbedding == Aggressive ? "Aggressive" : "NonAggressive";
}

std::unique_ptr<sw::SecretKey> vtkSpectralWatermarkAlgorithm::ReadSecretKey() const
{
  if (!this->SecretKey.empty() && !this->SecretKeyFile.empty())
  {
    throw sw::InvalidInput("SecretKeyFile", "a secret key is set as well",
      "leave one of them empty");
  }
  if (!this->SecretKeyFile.empty())
  {
    std::string secret = SecretInFile(this->SecretKeyFile);
    auto key = std::make_unique<sw::SecretKey>(secret);
    sw::Wipe(secret);
    return key;
  }
  if (this->SecretKey.empty())
  {
    return nullptr;
  }
  return std::make_unique<sw::SecretKey>(this->SecretKey);
}

std::unique_ptr<sw::SecretKey> vtkSpectralWatermarkAlgorithm::ReadRobustKey() const
{
  constexpr char publicKey[] = "SpectralWatermark: a mark for everyone to read";
  if (this->GetHasSecretKey() != 0)
  {
    return this->ReadSecretKey();
  }
  return std::make_unique<sw::SecretKey>(publicKey);
}

void vtkSpectralWatermarkAlgorithm::CheckScheme() const
{
  if (this->Scheme != PaperSlots && this->Scheme != Robust)
  {
    throw sw::InvalidInput("Scheme", std::to_string(this->Scheme) + " is unknown",
      "choose PaperSlots (0) or Robust (1)");
  }
}

sw::SlotOptions vtkSpectralWatermarkAlgorithm::GetSlotOptions(const sw::SecretKey* key,
  long long bits) const
{
  sw::SlotOptions options;
  options.FirstComponent = this->FirstComponent;
  options.SlotSize = this->SlotSize;
  options.CarrierPosition = this->CarrierPosition;
  options.Division = static_cast<sw::SlotDivision>(this->SlotDivision);
  options.Embedding = static_cast<sw::BitEmbedding>(this->BitEmbedding);
  options.TurbulenceFactor = this->TurbulenceFactor;
  sw::CheckSlots(options, bits);
  if (key != nullptr)
  {
    options.KeyedPositions = key->CarrierPositions(bits, this->SlotSize);
    options.Keystream = key->Keystream(bits);
  }
  return options;
}

void vtkSpectralWatermarkAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Scheme: " << this->GetSchemeAsString() << "\n";
  os << indent << "SlotDivision: " << this->GetSlotDivisionAsString() << "\n";
  os << indent << "FirstComponent: " << this->FirstComponent << "\n";
  os << indent << "SlotSize: " << this->SlotSize << "\n";
  os << indent << "CarrierPosition: " << this->CarrierPosition << "\n";
  os << indent << "BitEmbedding: " << this->GetBitEmbeddingAsString() << "\n";
  os << indent << "TurbulenceFactor: " << this->TurbulenceFactor << "\n";
  os << indent << "NumberOfBits: " << this->GetNumberOfBits() << "\n";
  os << indent << "HasSecretKey: " << this->GetHasSecretKey() << "\n";
  os << indent << "SecretKeyFile: " << this->SecretKeyFile << "\n";
}

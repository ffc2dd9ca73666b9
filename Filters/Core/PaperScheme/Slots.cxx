// SPDX-License-Identifier: BSD-3-Clause
#include "Core/PaperScheme/Slots.h"

#include <cmath>

namespace spectralwatermark
{

namespace
{

// The component, 1-based, of a position, 1-based, in a slot, counted from 0.
Index ComponentAt(const SlotOptions& options, Index slot, Index position)
{
  return options.FirstComponent + slot * options.SlotSize + position - 1;
}

Index CarrierPosition(const SlotOptions& options, Index slot)
{
  return options.KeyedPositions.empty() ? options.CarrierPosition : options.KeyedPositions[slot];
}

std::vector<Index> ReferencePositions(const SlotOptions& options, Index carrier)
{
  if (options.Division == SlotDivision::InterleavedNarrow)
  {
    return { carrier - 1, carrier + 1 };
  }
  std::vector<Index> positions;
  for (Index position = 1; position < options.SlotSize; ++position)
  {
    if (position != carrier)
    {
      positions.push_back(position);
    }
  }
  return positions;
}

} // namespace

double SlotReading::Margin() const
{
  const double side = this->Inverted ? -1.0 : 1.0;
  return this->Deviation > 0.0 ? side * (this->Magnitude - this->Average) / this->Deviation : 0.0;
}

Index ComponentsNeeded(const SlotOptions& options, Index bits)
{
  return options.FirstComponent + bits * options.SlotSize - 1;
}

void CheckSlots(const SlotOptions& options, Index bits)
{
  if (bits < 1)
  {
    throw InvalidInput("Message", "the message is empty",
      "give at least one bit, such as \"10110\", or a secret key to derive a message from");
  }
  if (options.SlotSize < 4)
  {
    throw InvalidInput("SlotSize",
      "slots of " + std::to_string(options.SlotSize) +
        " components have no room for references around the carrier",
      "choose 4 or more");
  }
  if (options.CarrierPosition < 2 || options.CarrierPosition > options.SlotSize - 1)
  {
    throw InvalidInput("CarrierPosition",
      "position " + std::to_string(options.CarrierPosition) + " is not inside a slot of " +
        std::to_string(options.SlotSize) + " components",
      "choose 2 to " + std::to_string(options.SlotSize - 1));
  }
  if (options.FirstComponent < 2)
  {
    throw InvalidInput("FirstComponent", "component 1 is constant and holds the model's position",
      "choose 2 or more");
  }
  if (!(options.TurbulenceFactor >= 0.0) || !std::isfinite(options.TurbulenceFactor))
  {
    throw InvalidInput("TurbulenceFactor", "the value is negative or not finite",
      "choose a finite number, 0 or more");
  }
}

void CheckCapacity(const SlotOptions& options, Index bits, Index available)
{
  const Index needed = ComponentsNeeded(options, bits);
  if (needed > available)
  {
    const Index capacity =
      std::max<Index>(0, (available - options.FirstComponent + 1) / options.SlotSize);
    throw InvalidInput("Message",
      std::to_string(bits) + " bits need " + std::to_string(needed) +
        " harmonics, and the mesh has only " + std::to_string(available) +
        ", one for each distinct vertex",
      "in slots of " + std::to_string(options.SlotSize) + " from component " +
        std::to_string(options.FirstComponent) + " on, it can carry " + std::to_string(capacity) +
        " bits");
  }
}

void CheckSlotsAboveKernel(const SlotOptions& options, Index kernelDimension)
{
  if (options.FirstComponent <= kernelDimension)
  {
    throw InvalidInput("FirstComponent",
      "the mesh has " + std::to_string(kernelDimension) +
        " components, and that many first harmonics are constant on each of them: a mark there "
        "would move the parts against each other",
      "choose " + std::to_string(kernelDimension + 1) +
        " or more, or take the largest component alone");
  }
}

std::vector<SlotReading> ReadSlots(const Eigen::VectorXd& magnitudes, const SlotOptions& options,
  Index bits)
{
  std::vector<SlotReading> readings;
  for (Index slot = 0; slot < bits; ++slot)
  {
    const Index carrier = CarrierPosition(options, slot);
    const std::vector<Index> references = ReferencePositions(options, carrier);
    const double count = static_cast<double>(references.size());
    SlotReading reading;
    reading.Component = ComponentAt(options, slot, carrier);
    reading.Inverted = !options.Keystream.empty() && options.Keystream[slot] == '1';
    reading.Magnitude = magnitudes[reading.Component - 1];
    for (const Index position : references)
    {
      reading.Average += magnitudes[ComponentAt(options, slot, position) - 1] / count;
    }
    double variance = 0.0;
    for (const Index position : references)
    {
      const double distance =
        magnitudes[ComponentAt(options, slot, position) - 1] - reading.Average;
      variance += distance * distance / count;
    }
    reading.Deviation = std::sqrt(variance);
    readings.push_back(reading);
  }
  return readings;
}

std::string MessageOf(const std::vector<SlotReading>& readings)
{
  std::string message;
  for (const SlotReading& reading : readings)
  {
    message += reading.Bit() == 1 ? '1' : '0';
  }
  return message;
}

double TargetMagnitude(const SlotReading& reading, int bit, const SlotOptions& options)
{
  const double side = (bit == 1) != reading.Inverted ? 1.0 : -1.0;
  const double distance = options.TurbulenceFactor * reading.Deviation;
  const double target = std::max(0.0, reading.Average + side * distance);
  const double threshold = options.Embedding == BitEmbedding::Aggressive ? target : reading.Average;
  const bool stays = side * (reading.Magnitude - threshold) > 0.0;
  return stays ? reading.Magnitude : target;
}

Spectrum SpectrumChange(const Spectrum& spectrum, const std::vector<SlotReading>& readings,
  const std::string& message, const SlotOptions& options)
{
  Spectrum change = Spectrum::Zero(spectrum.rows(), 3);
  for (std::size_t slot = 0; slot < readings.size(); ++slot)
  {
    const SlotReading& reading = readings[slot];
    const double target = TargetMagnitude(reading, message[slot] == '1' ? 1 : 0, options);
    const Eigen::RowVector3d descriptor = spectrum.row(reading.Component - 1);
    const Eigen::RowVector3d direction = reading.Magnitude > 0.0
      ? (descriptor / reading.Magnitude).eval()
      : Eigen::RowVector3d::Constant(1.0 / std::sqrt(3.0)).eval();
    change.row(reading.Component - 1) = (target - reading.Magnitude) * direction;
  }
  return change;
}

} // namespace spectralwatermark

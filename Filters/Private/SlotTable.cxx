// SPDX-License-Identifier: BSD-3-Clause
#include "Private/SlotTable.h"

#include "Core/PaperScheme/SlotDetection.h"

#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkTable.h>

#include <cmath>

namespace spectralwatermark
{

namespace
{

using Readings = std::vector<SlotReading>;

template <typename ArrayType, typename Function>
void AddColumn(vtkTable* table, const char* name, const std::vector<Readings>& groups,
  Function valueOf)
{
  vtkNew<ArrayType> column;
  column->SetName(name);
  for (std::size_t group = 0; group < groups.size(); ++group)
  {
    for (std::size_t slot = 0; slot < groups[group].size(); ++slot)
    {
      column->InsertNextValue(valueOf(group, slot));
    }
  }
  table->AddColumn(column);
}

void AddReadingColumns(vtkTable* table, const std::vector<Readings>& groups)
{
  AddColumn<vtkIntArray>(table, "Slot", groups,
    [](std::size_t, std::size_t slot) { return static_cast<int>(slot) + 1; });
  AddColumn<vtkIntArray>(table, "Component", groups,
    [&](std::size_t group, std::size_t slot)
    { return static_cast<int>(groups[group][slot].Component); });
  AddColumn<vtkDoubleArray>(table, "Magnitude", groups,
    [&](std::size_t group, std::size_t slot) { return groups[group][slot].Magnitude; });
  AddColumn<vtkDoubleArray>(table, "Average", groups,
    [&](std::size_t group, std::size_t slot) { return groups[group][slot].Average; });
  AddColumn<vtkDoubleArray>(table, "Deviation", groups,
    [&](std::size_t group, std::size_t slot) { return groups[group][slot].Deviation; });
}

} // namespace

void FillEmbeddingTable(vtkTable* table, const std::vector<Readings>& history,
  const std::string& message)
{
  AddColumn<vtkIntArray>(table, "Iteration", history,
    [](std::size_t iteration, std::size_t) { return static_cast<int>(iteration); });
  AddReadingColumns(table, history);
  AddColumn<vtkIntArray>(table, "BitWanted", history,
    [&](std::size_t, std::size_t slot) { return message[slot] - '0'; });
  AddColumn<vtkIntArray>(table, "BitRead", history,
    [&](std::size_t iteration, std::size_t slot) { return history[iteration][slot].Bit(); });
}

void FillDetectionTable(vtkTable* table, const Readings& readings, const SlotOptions& options)
{
  const std::vector<Readings> one{ readings };
  AddReadingColumns(table, one);
  AddColumn<vtkDoubleArray>(table, "Margin", one,
    [&](std::size_t, std::size_t slot) { return readings[slot].Margin(); });
  AddColumn<vtkIntArray>(table, "Bit", one,
    [&](std::size_t, std::size_t slot) { return readings[slot].Bit(); });
  for (const int bit : { 0, 1 })
  {
    const std::string name = "LogLikelihoodRatio" + std::to_string(bit);
    AddColumn<vtkDoubleArray>(table, name.c_str(), one,
      [&](std::size_t, std::size_t slot)
      {
        const SlotLikelihood likelihood = LikelihoodOf(readings[slot], options);
        return likelihood.Of(bit) - likelihood.Unmarked;
      });
  }
  AddColumn<vtkDoubleArray>(table, "Confidence", one,
    [&](std::size_t, std::size_t slot)
    {
      const SlotLikelihood likelihood = LikelihoodOf(readings[slot], options);
      const int bit = readings[slot].Bit();
      return 1.0 / (1.0 + std::exp(likelihood.Of(1 - bit) - likelihood.Of(bit)));
    });
}

} // namespace spectralwatermark

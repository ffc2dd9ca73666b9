// SPDX-License-Identifier: BSD-3-Clause
#include "Private/CarrierTable.h"

#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkTable.h>

namespace spectralwatermark
{

namespace
{

template <typename ArrayType, typename Function>
void AddColumn(vtkTable* table, const char* name, std::size_t rows, Function valueOf)
{
  vtkNew<ArrayType> column;
  column->SetName(name);
  for (std::size_t row = 0; row < rows; ++row)
  {
    column->InsertNextValue(valueOf(row));
  }
  table->AddColumn(column);
}

} // namespace

void FillRoundsTable(vtkTable* table, const std::vector<RobustEmbeddingRound>& rounds)
{
  AddColumn<vtkIntArray>(table, "Iteration", rounds.size(),
    [](std::size_t k) { return static_cast<int>(k); });
  AddColumn<vtkDoubleArray>(table, "Distortion", rounds.size(),
    [&rounds](std::size_t k) { return 100.0 * rounds[k].Distortion; });
  AddColumn<vtkDoubleArray>(table, "LargestError", rounds.size(),
    [&rounds](std::size_t k) { return rounds[k].LargestError; });
}

void FillCarriersTable(vtkTable* table, const RobustReading& reading)
{
  const auto rows = static_cast<std::size_t>(reading.Soft.size());
  AddColumn<vtkIntArray>(table, "Carrier", rows,
    [](std::size_t k) { return static_cast<int>(k) + 1; });
  AddColumn<vtkDoubleArray>(table, "Value", rows,
    [&reading](std::size_t k) { return reading.Values[static_cast<Index>(k)]; });
  AddColumn<vtkDoubleArray>(table, "Margin", rows,
    [&reading](std::size_t k) { return -reading.Soft[static_cast<Index>(k)]; });
  AddColumn<vtkIntArray>(table, "Bit", rows,
    [&reading](std::size_t k) { return reading.Soft[static_cast<Index>(k)] < 0.0 ? 1 : 0; });
}

} // namespace spectralwatermark

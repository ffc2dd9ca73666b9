// SPDX-License-Identifier: BSD-3-Clause
#include "Private/Tables.h"

#include "Core/Harmonics/Transform.h"
#include "Core/PaperScheme/SlotDetection.h"

#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkTable.h>

#include <cmath>

namespace spectralwatermark
{

namespace
{

// A row of a slot table: one slot in one iteration, both counted from 0.
struct SlotRow
{
  int Iteration;
  int Slot;
  SlotReading Reading;
};

std::vector<SlotRow> RowsOf(const std::vector<std::vector<SlotReading>>& history)
{
  std::vector<SlotRow> rows;
  int iteration = 0;
  for (const std::vector<SlotReading>& readings : history)
  {
    int slot = 0;
    for (const SlotReading& reading : readings)
    {
      rows.push_back({ iteration, slot++, reading });
    }
    ++iteration;
  }
  return rows;
}

template <typename ArrayType, typename Function>
void AddColumn(vtkTable* table, const char* name, const std::vector<SlotRow>& rows,
  const Function& valueOf)
{
  table->AddColumn(Column<ArrayType>(name, static_cast<Index>(rows.size()),
    [&](Index row) { return valueOf(rows[row]); }));
}

void AddReadingColumns(vtkTable* table, const std::vector<SlotRow>& rows)
{
  AddColumn<vtkIntArray>(table, "Slot", rows, [](const SlotRow& row) { return row.Slot + 1; });
  AddColumn<vtkIntArray>(table, "Component", rows,
    [](const SlotRow& row) { return static_cast<int>(row.Reading.Component); });
  AddColumn<vtkDoubleArray>(table, "Magnitude", rows,
    [](const SlotRow& row) { return row.Reading.Magnitude; });
  AddColumn<vtkDoubleArray>(table, "Average", rows,
    [](const SlotRow& row) { return row.Reading.Average; });
  AddColumn<vtkDoubleArray>(table, "Deviation", rows,
    [](const SlotRow& row) { return row.Reading.Deviation; });
}

} // namespace

void FillSpectrumTable(vtkTable* table, const ManifoldHarmonics& harmonics,
  const PolyDataMesh& mesh)
{
  const Spectrum spectrum = ForwardTransform(harmonics, mesh.Mesh.Points);
  const Index count = harmonics.Eigenvalues.size();
  const auto add = [table, count](const char* name, const Eigen::VectorXd& values)
  {
    table->AddColumn(
      Column<vtkDoubleArray>(name, count, [&values](Index row) { return values[row]; }));
  };
  add("Component", Eigen::VectorXd::LinSpaced(count, 1.0, static_cast<double>(count)));
  add("Eigenvalue", harmonics.Eigenvalues);
  add("X", spectrum.col(0));
  add("Y", spectrum.col(1));
  add("Z", spectrum.col(2));
  add("Magnitude", Magnitudes(spectrum));
}

void FillEmbeddingTable(vtkTable* table, const std::vector<std::vector<SlotReading>>& history,
  const std::string& message)
{
  const std::vector<SlotRow> rows = RowsOf(history);
  AddColumn<vtkIntArray>(table, "Iteration", rows,
    [](const SlotRow& row) { return row.Iteration; });
  AddReadingColumns(table, rows);
  AddColumn<vtkIntArray>(table, "BitWanted", rows,
    [&message](const SlotRow& row) { return message[row.Slot] - '0'; });
  AddColumn<vtkIntArray>(table, "BitRead", rows,
    [](const SlotRow& row) { return row.Reading.Bit(); });
}

void FillDetectionTable(vtkTable* table, const std::vector<SlotReading>& readings,
  const SlotOptions& options)
{
  const std::vector<SlotRow> rows = RowsOf({ readings });
  AddReadingColumns(table, rows);
  AddColumn<vtkDoubleArray>(table, "Margin", rows,
    [](const SlotRow& row) { return row.Reading.Margin(); });
  AddColumn<vtkIntArray>(table, "Bit", rows, [](const SlotRow& row) { return row.Reading.Bit(); });
  for (const int bit : { 0, 1 })
  {
    const std::string name = "LogLikelihoodRatio" + std::to_string(bit);
    AddColumn<vtkDoubleArray>(table, name.c_str(), rows,
      [&options, bit](const SlotRow& row)
      {
        const SlotLikelihood likelihood = LikelihoodOf(row.Reading, options);
        return likelihood.Of(bit) - likelihood.Unmarked;
      });
  }
  AddColumn<vtkDoubleArray>(table, "Confidence", rows,
    [&options](const SlotRow& row)
    {
      const SlotLikelihood likelihood = LikelihoodOf(row.Reading, options);
      const int bit = row.Reading.Bit();
      return 1.0 / (1.0 + std::exp(likelihood.Of(1 - bit) - likelihood.Of(bit)));
    });
}

void FillRoundsTable(vtkTable* table, const std::vector<RobustEmbeddingRound>& rounds)
{
  const auto rows = static_cast<Index>(rounds.size());
  table->AddColumn(
    Column<vtkIntArray>("Iteration", rows, [](Index row) { return static_cast<int>(row); }));
  table->AddColumn(Column<vtkDoubleArray>("Distortion", rows,
    [&rounds](Index row) { return 100.0 * rounds[row].Distortion; }));
  table->AddColumn(Column<vtkDoubleArray>("LargestError", rows,
    [&rounds](Index row) { return rounds[row].LargestError; }));
}

void FillCarriersTable(vtkTable* table, const RobustReading& reading)
{
  const Index rows = reading.Soft.size();
  table->AddColumn(
    Column<vtkIntArray>("Carrier", rows, [](Index row) { return static_cast<int>(row) + 1; }));
  table->AddColumn(
    Column<vtkDoubleArray>("Value", rows, [&reading](Index row) { return reading.Values[row]; }));
  table->AddColumn(
    Column<vtkDoubleArray>("Margin", rows, [&reading](Index row) { return -reading.Soft[row]; }));
  table->AddColumn(Column<vtkIntArray>("Bit", rows,
    [&reading](Index row) { return reading.Soft[row] < 0.0 ? 1 : 0; }));
}

} // namespace spectralwatermark

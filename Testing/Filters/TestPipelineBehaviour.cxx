// SPDX-License-Identifier: BSD-3-Clause
// Progress, abort, determinism, threads and composite data: what pipelines rely on.
#include "Support/FilterTesting.h"
#include "Support/FullTests.h"

#include <vtkCellData.h>
#include <vtkCompositeDataIterator.h>
#include <vtkDataArray.h>
#include <vtkDataSetAttributes.h>
#include <vtkManifoldHarmonics.h>
#include <vtkManifoldHarmonicsSimilarity.h>
#include <vtkMeshAttack.h>
#include <vtkMeshDistortion.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>
#include <vtkSpectralWatermarkDetect.h>
#include <vtkSpectralWatermarkEmbed.h>
#include <vtkTable.h>
#include <vtkVariant.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

using namespace filtertesting;

namespace
{

using Filters = std::vector<vtkSmartPointer<vtkPolyDataAlgorithm>>;

// The mesh with waves on it: another surface of the same cells. Points that coincide stay together.
vtkSmartPointer<vtkPolyData> Wavy(vtkPolyData* mesh)
{
  auto wavy = vtkSmartPointer<vtkPolyData>::New();
  wavy->DeepCopy(mesh);
  for (vtkIdType i = 0; i < wavy->GetNumberOfPoints(); ++i)
  {
    double p[3];
    wavy->GetPoint(i, p);
    p[0] += 0.01 * std::sin(9.0 * p[1]);
    wavy->GetPoints()->SetPoint(i, p);
  }
  return wavy;
}

Filters EveryFilterOn(vtkPolyData* mesh)
{
  Filters filters = EveryFilter();
  const auto wavy = Wavy(mesh);
  for (const auto& filter : filters)
  {
    SetEveryInput(filter, mesh);
    if (filter->GetNumberOfInputPorts() > 1)
    {
      filter->SetInputData(1, wavy);
    }
    if (auto* detect = vtkSpectralWatermarkDetect::SafeDownCast(filter))
    {
      detect->SetExpectedMessage("10110");
      detect->SetFalsePositiveRate(0.5); // what so few bits can prove
    }
  }
  return filters;
}

std::string NameOf(vtkPolyDataAlgorithm* filter)
{
  auto* attack = vtkMeshAttack::SafeDownCast(filter);
  auto* watermark = vtkSpectralWatermarkAlgorithm::SafeDownCast(filter);
  const char* kind = attack != nullptr ? attack->GetAttackAsString()
    : watermark != nullptr             ? watermark->GetSchemeAsString()
                                       : "";
  return std::string(filter->GetClassName()) + " " + kind;
}

void Append(std::string& bytes, vtkAbstractArray* array)
{
  if (auto* numbers = vtkDataArray::SafeDownCast(array))
  {
    bytes.append(static_cast<const char*>(numbers->GetVoidPointer(0)),
      static_cast<std::size_t>(numbers->GetNumberOfValues() * numbers->GetDataTypeSize()));
    return;
  }
  for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i) // texts
  {
    bytes += array->GetVariantValue(i).ToString() + '\n';
  }
}

void Append(std::string& bytes, vtkFieldData* data)
{
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    Append(bytes, data->GetAbstractArray(i));
  }
}

// Every coordinate and every array of the mesh, byte by byte.
std::string BytesOf(vtkPolyData* mesh)
{
  std::string bytes;
  Append(bytes, mesh->GetPoints()->GetData());
  Append(bytes, mesh->GetPointData());
  Append(bytes, mesh->GetCellData());
  Append(bytes, mesh->GetFieldData());
  return bytes;
}

// What a filter tells beside its outputs, to the last bit.
std::string FiguresOf(vtkPolyDataAlgorithm* filter)
{
  std::ostringstream text;
  text << std::hexfloat;
  if (auto* similarity = vtkManifoldHarmonicsSimilarity::SafeDownCast(filter))
  {
    text << similarity->GetMeanSimilarity();
  }
  if (auto* embed = vtkSpectralWatermarkEmbed::SafeDownCast(filter))
  {
    text << embed->GetExtractedMessage() << ' ' << embed->GetConverged() << ' '
         << embed->GetDistortion() << ' ' << embed->GetMargin();
  }
  if (auto* detect = vtkSpectralWatermarkDetect::SafeDownCast(filter))
  {
    text << detect->GetExtractedMessage() << ' ' << detect->GetPValue() << ' '
         << detect->GetCorrelation() << ' ' << detect->GetLogLikelihoodRatio() << ' '
         << detect->GetUndoneSmoothing();
  }
  if (auto* distortion = vtkMeshDistortion::SafeDownCast(filter))
  {
    EXPECT_GT(distortion->GetMRMS(), 0.0) << "a mesh compared with itself tells nothing";
    text << distortion->GetGeomDiff() << ' ' << distortion->GetCurvDiff() << ' '
         << distortion->GetMRMS() << ' ' << distortion->GetHausdorff() << ' '
         << distortion->GetMSDM() << ' ' << distortion->GetMSDM2();
  }
  return text.str();
}

// All that comes out of a filter: its mesh, its tables, its figures.
std::string BytesOf(vtkPolyDataAlgorithm* filter)
{
  filter->Update();
  EXPECT_GT(filter->GetOutput()->GetNumberOfPoints(), 0) << NameOf(filter);
  std::string bytes = BytesOf(filter->GetOutput());
  for (int port = 1; port < filter->GetNumberOfOutputPorts(); ++port)
  {
    auto* table = vtkTable::SafeDownCast(filter->GetOutputDataObject(port));
    EXPECT_GT(table->GetNumberOfRows(), 0) << NameOf(filter);
    Append(bytes, table->GetRowData());
    Append(bytes, table->GetFieldData());
  }
  return bytes + FiguresOf(filter);
}

using BytesByName = std::map<std::string, std::string>;

BytesByName BytesOfEveryFilter(vtkPolyData* mesh)
{
  BytesByName bytes;
  for (const auto& filter : EveryFilterOn(mesh))
  {
    bytes[NameOf(filter)] = BytesOf(filter);
  }
  return bytes;
}

void ExpectSame(const BytesByName& first, const BytesByName& second)
{
  ASSERT_EQ(first.size(), second.size());
  for (const auto& [name, bytes] : first)
  {
    EXPECT_TRUE(second.at(name) == bytes) << name; // too many to print
  }
}

} // namespace

TEST(Pipeline, ProgressRisesFromLowToOne)
{
  for (const auto& filter : EveryFilterOn(PolyData(shapes::Bumpy(4))))
  {
    Listener listener(filter);
    filter->Update();
    ASSERT_GE(listener.Progress.size(), 2u) << NameOf(filter);
    EXPECT_TRUE(std::is_sorted(listener.Progress.begin(), listener.Progress.end()))
      << NameOf(filter);
    EXPECT_LT(listener.Progress.front(), 0.5) << NameOf(filter);
    EXPECT_EQ(listener.Progress.back(), 1.0) << NameOf(filter);
  }
}

TEST(Pipeline, LongFiltersReportOften)
{
  vtkNew<vtkSpectralWatermarkEmbed> embed;
  embed->SetSchemeToPaperSlots();
  embed->SetInputData(PolyData(shapes::Bumpy(4)));
  Listener listener(embed);
  embed->Update();
  EXPECT_GT(listener.Progress.size(), 50u);
}

TEST(Pipeline, AbortEmptiesTheOutputWithoutAnError)
{
  for (const auto& filter : EveryFilterOn(PolyData(shapes::Bumpy(4))))
  {
    {
      Listener listener(filter);
      listener.AbortAt(0.0);
      filter->Update();
      EXPECT_EQ(listener.Errors, "") << NameOf(filter);
      EXPECT_EQ(filter->GetErrorCode(), 0u) << NameOf(filter);
      EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0) << NameOf(filter);
    }
    // Once modified, the filter works as if nothing had happened.
    filter->Modified();
    filter->Update();
    EXPECT_GT(filter->GetOutput()->GetNumberOfPoints(), 0) << NameOf(filter);
  }
}

TEST(Pipeline, AbortInTheMiddleOfEmbedding)
{
  vtkNew<vtkSpectralWatermarkEmbed> embed;
  embed->SetSchemeToPaperSlots();
  embed->SetInputData(PolyData(shapes::Bumpy(4)));
  Listener listener(embed);
  listener.AbortAt(0.5);
  embed->Update();
  EXPECT_LT(listener.Progress.back(), 0.6);
  EXPECT_EQ(embed->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_EQ(embed->GetConverged(), 0);
  EXPECT_STREQ(embed->GetExtractedMessage(), "");
}

TEST(Pipeline, RepeatedRunsGiveTheSameBytes)
{
  const auto mesh = PolyData(shapes::Bumpy(3));
  const BytesByName first = BytesOfEveryFilter(mesh);
  const int runs = QuickOrFull(4, 20);
  for (int run = 1; run < runs; ++run)
  {
    vtkSMPTools::Initialize(1 + run % 2);
    SCOPED_TRACE("run " + std::to_string(run));
    ExpectSame(first, BytesOfEveryFilter(mesh));
  }
}

TEST(Pipeline, OneAndTwoThreadsGiveTheSameBytes)
{
  // A soup too: which of its coincident points VTK's locator meets first depends on the threads.
  for (const auto& mesh : { PolyData(shapes::Bumpy(4), true), Soup(shapes::Bumpy(4)) })
  {
    vtkSMPTools::Initialize(1);
    const BytesByName one = BytesOfEveryFilter(mesh);
    vtkSMPTools::Initialize(2);
    ExpectSame(one, BytesOfEveryFilter(mesh));
  }
}

// The solver takes a second thread from 16,384 vertices on.
TEST(Pipeline, TwoThreadsInASolveGiveTheSameBytes)
{
  const auto mesh = PolyData(shapes::Rectangle(140, 140, 1.0, 0.7));
  ASSERT_GE(mesh->GetNumberOfPoints(), 16384);
  const auto bytesOn = [&mesh](int threads)
  {
    vtkSMPTools::Initialize(threads);
    vtkNew<vtkManifoldHarmonics> harmonics;
    harmonics->SetInputData(mesh);
    harmonics->SetNumberOfHarmonics(20);
    return BytesOf(harmonics);
  };
  const std::string one = bytesOn(1);
  const std::string two = bytesOn(2);
  if (vtkSMPTools::GetEstimatedNumberOfThreads() != 2)
  {
    GTEST_SKIP() << "VTK has one thread here";
  }
  EXPECT_TRUE(one == two); // too many to print
}

TEST(Pipeline, InputIsNotTouched)
{
  const auto mesh = PolyData(shapes::Bumpy(4));
  const std::string before = BytesOf(mesh);
  const vtkMTimeType time = mesh->GetMTime();
  BytesOfEveryFilter(mesh);
  EXPECT_EQ(BytesOf(mesh), before);
  EXPECT_EQ(mesh->GetMTime(), time);
  EXPECT_EQ(mesh->GetPointData()->GetNumberOfArrays(), 0);
}

TEST(Pipeline, NothingRunsTwice)
{
  vtkNew<vtkManifoldHarmonics> harmonics;
  harmonics->SetInputData(PolyData(shapes::Bumpy(3)));
  harmonics->Update();
  Listener listener(harmonics);
  harmonics->Update();
  EXPECT_TRUE(listener.Progress.empty());
  harmonics->SetNumberOfHarmonics(50);
  harmonics->Update();
  EXPECT_FALSE(listener.Progress.empty());
}

TEST(Pipeline, CompositeDataGoesBlockByBlock)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, PolyData(shapes::Bumpy(3)));
  blocks->SetBlock(1, PolyData(shapes::Icosphere(3)));
  vtkNew<vtkManifoldHarmonics> harmonics;
  harmonics->SetInputDataObject(blocks);
  harmonics->SetNumberOfHarmonics(75);
  harmonics->Update();
  auto* output = vtkMultiBlockDataSet::SafeDownCast(harmonics->GetOutputDataObject(0));
  ASSERT_NE(output, nullptr);
  for (unsigned int i = 0; i < 2; ++i)
  {
    auto* block = vtkPolyData::SafeDownCast(output->GetBlock(i));
    ASSERT_NE(block, nullptr);
    EXPECT_NE(PointArray(block, "ManifoldHarmonics"), nullptr);
  }

  vtkNew<vtkSpectralWatermarkEmbed> embed;
  embed->SetSchemeToPaperSlots();
  embed->SetInputConnection(harmonics->GetOutputPort());
  embed->Update();
  auto* marked = vtkMultiBlockDataSet::SafeDownCast(embed->GetOutputDataObject(0));
  auto* tables = vtkMultiBlockDataSet::SafeDownCast(embed->GetOutputDataObject(1));
  ASSERT_NE(marked, nullptr);
  ASSERT_NE(tables, nullptr);
  EXPECT_NE(PointArray(vtkPolyData::SafeDownCast(marked->GetBlock(0)), "GeometricDistortion"),
    nullptr);
  EXPECT_GT(vtkTable::SafeDownCast(tables->GetBlock(0))->GetNumberOfRows(), 0);
}

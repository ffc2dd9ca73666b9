// SPDX-License-Identifier: BSD-3-Clause
// Progress, abort, determinism, threads and composite data: what pipelines rely on.
#include "Support/FilterTesting.h"

#include <vtkCompositeDataIterator.h>
#include <vtkDataArray.h>
#include <vtkManifoldHarmonics.h>
#include <vtkMeshAttack.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>
#include <vtkSpectralWatermarkEmbed.h>
#include <vtkTable.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

using namespace filtertesting;

namespace
{

using Filters = std::vector<vtkSmartPointer<vtkPolyDataAlgorithm>>;

Filters EveryFilterOn(vtkPolyData* mesh)
{
  Filters filters = EveryFilter();
  for (const auto& filter : filters)
  {
    SetEveryInput(filter, mesh);
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

// Every point coordinate and every point array, byte by byte.
std::string BytesOf(vtkPolyData* mesh)
{
  std::string bytes;
  const auto append = [&bytes](vtkDataArray* array)
  {
    bytes.append(static_cast<const char*>(array->GetVoidPointer(0)),
      static_cast<std::size_t>(array->GetNumberOfValues() * array->GetDataTypeSize()));
  };
  append(mesh->GetPoints()->GetData());
  for (int i = 0; i < mesh->GetPointData()->GetNumberOfArrays(); ++i)
  {
    append(mesh->GetPointData()->GetArray(i));
  }
  return bytes;
}

std::vector<std::string> BytesOfEveryFilter(vtkPolyData* mesh)
{
  std::vector<std::string> bytes;
  for (const auto& filter : EveryFilterOn(mesh))
  {
    filter->Update();
    EXPECT_GT(filter->GetOutput()->GetNumberOfPoints(), 0) << NameOf(filter);
    bytes.push_back(BytesOf(filter->GetOutput()));
  }
  return bytes;
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

TEST(Pipeline, TwentyRunsGiveTheSameBytes)
{
  const auto mesh = PolyData(shapes::Bumpy(4));
  const std::vector<std::string> first = BytesOfEveryFilter(mesh);
  for (int run = 1; run < 20; ++run)
  {
    vtkSMPTools::Initialize(1 + run % 2);
    ASSERT_EQ(BytesOfEveryFilter(mesh), first) << "run " << run;
  }
}

TEST(Pipeline, OneAndTwoThreadsGiveTheSameBytes)
{
  // A soup too: which of its coincident points VTK's locator meets first depends on the threads.
  for (const auto& mesh : { PolyData(shapes::Bumpy(4), true), Soup(shapes::Bumpy(4)) })
  {
    vtkSMPTools::Initialize(1);
    const std::vector<std::string> one = BytesOfEveryFilter(mesh);
    vtkSMPTools::Initialize(2);
    EXPECT_EQ(one, BytesOfEveryFilter(mesh));
  }
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

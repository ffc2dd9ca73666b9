// SPDX-License-Identifier: BSD-3-Clause
// Pipelines in several threads at once give what they give one after the other.
#include "Support/FilterTesting.h"

#include <vtkErrorCode.h>
#include <vtkManifoldHarmonics.h>
#include <vtkMeshAttack.h>
#include <vtkMeshDistortion.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSpectralWatermarkDetect.h>
#include <vtkSpectralWatermarkEmbed.h>

#include <gtest/gtest.h>

#include <thread>

using namespace filtertesting;

namespace
{

shapes::TriangleMesh Host(int number)
{
  shapes::TriangleMesh mesh = shapes::Bumpy(4);
  mesh.Points.col(number % 3) *= 1.0 + 0.1 * number;
  return mesh;
}

// What one owner does, from a mesh to a verdict and to figures.
struct Result
{
  vtkSmartPointer<vtkPolyData> Marked;
  std::string Read;
  double PValue = 1.0;
  double Distortion = -1.0;
  double LastEigenvalue = -1.0;
  double BasisValue = -1.0;
};

Result RunPipeline(int number)
{
  const std::string secret = "owner " + std::to_string(number);
  vtkNew<vtkSpectralWatermarkEmbed> embed;
  embed->SetInputData(PolyData(Host(number)));
  embed->SetSecretKey(secret.c_str());
  embed->SetNumberOfBits(16);
  vtkNew<vtkMeshAttack> attack;
  attack->SetInputConnection(embed->GetOutputPort());
  attack->SetAttackToNoiseUniform();
  attack->SetNoisePercent(0.1);
  vtkNew<vtkSpectralWatermarkDetect> detect;
  detect->SetInputConnection(attack->GetOutputPort());
  detect->SetSecretKey(secret.c_str());
  detect->SetNumberOfBits(16);
  detect->UseDerivedMessageOn();
  detect->Update();
  vtkNew<vtkMeshDistortion> distortion;
  distortion->SetInputData(0, embed->GetInput());
  distortion->SetInputData(1, embed->GetOutput());
  distortion->Update();
  vtkNew<vtkManifoldHarmonics> harmonics;
  harmonics->SetInputData(embed->GetOutput());
  harmonics->SetNumberOfHarmonics(60);
  harmonics->Update();

  Result result;
  result.Marked = vtkSmartPointer<vtkPolyData>::New();
  result.Marked->DeepCopy(embed->GetOutput());
  result.Read = detect->GetExtractedMessage();
  result.PValue = detect->GetPValue();
  result.Distortion = distortion->GetMSDM2();
  result.LastEigenvalue = FieldArray(harmonics->GetOutput(), "Eigenvalues")->GetTuple1(59);
  result.BasisValue = PointArray(harmonics->GetOutput(), "ManifoldHarmonics")->GetComponent(17, 42);
  return result;
}

void ExpectSame(const Result& a, const Result& b)
{
  EXPECT_TRUE(SamePoints(a.Marked, b.Marked));
  EXPECT_EQ(a.Read, b.Read);
  EXPECT_EQ(a.PValue, b.PValue);
  EXPECT_EQ(a.Distortion, b.Distortion);
  EXPECT_EQ(a.LastEigenvalue, b.LastEigenvalue);
  EXPECT_EQ(a.BasisValue, b.BasisValue);
}

} // namespace

TEST(Concurrency, PipelinesSideBySide)
{
  constexpr int count = 3;
  std::vector<Result> alone;
  for (int number = 0; number < count; ++number)
  {
    alone.push_back(RunPipeline(number));
    EXPECT_LE(alone.back().PValue, 1e-6) << number;
  }
  std::vector<Result> together(count);
  std::vector<std::thread> threads;
  for (int number = 0; number < count; ++number)
  {
    threads.emplace_back(
      [&together, number]() { together[static_cast<std::size_t>(number)] = RunPipeline(number); });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  for (std::size_t number = 0; number < count; ++number)
  {
    ExpectSame(together[number], alone[number]);
  }
}

// The same mesh goes into all: nobody writes to an input.
TEST(Concurrency, OneInputForMany)
{
  const auto mesh = PolyData(Host(1));
  std::vector<double> values(4);
  std::vector<std::thread> threads;
  for (double& value : values)
  {
    threads.emplace_back(
      [&mesh, &value]()
      {
        vtkNew<vtkPolyData> copy; // VTK counts references of its own, without a lock for pipelines
        copy->ShallowCopy(mesh);
        vtkNew<vtkManifoldHarmonics> harmonics;
        harmonics->SetInputData(copy);
        harmonics->SetNumberOfHarmonics(40);
        harmonics->Update();
        value = FieldArray(harmonics->GetOutput(), "Eigenvalues")->GetTuple1(39);
      });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  for (const double value : values)
  {
    EXPECT_EQ(value, values[0]);
    EXPECT_GT(value, 0.0);
  }
}

// A filter that ran in one thread runs in another, with other properties and after an error.
TEST(Concurrency, AFilterThatMovesFromThreadToThread)
{
  vtkNew<vtkSpectralWatermarkEmbed> embed;
  embed->SetInputData(PolyData(Host(0)));
  embed->SetSecretKey("an owner");
  embed->SetNumberOfBits(16);
  embed->Update();
  const std::string first = embed->GetExtractedMessage();
  std::thread(
    [&embed]()
    {
      Listener listener(embed);
      embed->SetSecretKey("");
      embed->Update();
      EXPECT_EQ(embed->GetErrorCode(), vtkErrorCode::UserError);
    })
    .join();
  std::thread(
    [&embed]()
    {
      embed->SetSecretKey("an owner");
      embed->Update();
    })
    .join();
  EXPECT_EQ(embed->GetErrorCode(), vtkErrorCode::NoError);
  EXPECT_EQ(embed->GetExtractedMessage(), first);
}

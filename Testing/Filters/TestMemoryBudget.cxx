// SPDX-License-Identifier: BSD-3-Clause
// What does not fit into memory is refused before the work, and the filter works once it fits.
#include "Support/AddressSpace.h"
#include "Support/FilterTesting.h"
#include "Support/FullTests.h"

#include <vtkErrorCode.h>
#include <vtkManifoldHarmonics.h>
#include <vtkManifoldHarmonicsReconstruction.h>
#include <vtkMeshAttack.h>
#include <vtkMeshDistortion.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSpectralWatermarkDetect.h>
#include <vtkSpectralWatermarkEmbed.h>
#include <vtkType.h>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <memory>
#include <new>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

// Counts of points, and of entries of matrices, go beyond an int.
static_assert(sizeof(vtkIdType) >= 8 && sizeof(Eigen::Index) >= 8);

#ifndef SPECTRALWATERMARK_NO_ADDRESS_LIMIT

using namespace filtertesting;

namespace
{

constexpr double Little = 60e6;

void ExpectRefusal(vtkPolyDataAlgorithm* filter, const std::string& work, const std::string& advice,
  double free = Little, const std::string& parameter = "")
{
  Listener listener(filter);
  {
    const AddressSpaceLimit limit(free);
    ASSERT_TRUE(limit.Holds());
    filter->Update();
  }
  EXPECT_EQ(filter->GetErrorCode(), vtkErrorCode::UserError);
  EXPECT_EQ(vtkTriangleMeshAlgorithm::SafeDownCast(filter)->GetErrorParameter(), parameter);
  EXPECT_NE(listener.Errors.find(work + " need about "), std::string::npos) << listener.Errors;
  EXPECT_NE(listener.Errors.find(" are free; " + advice), std::string::npos) << listener.Errors;
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
}

vtkSmartPointer<vtkPolyData> LargeSphere()
{
  return PolyData(shapes::Icosphere(6)); // 40,962 vertices
}

vtkSmartPointer<vtkPolyData> HugeSphere()
{
  return PolyData(shapes::Icosphere(7)); // 327,680 triangles
}

vtkSmartPointer<vtkManifoldHarmonics> HarmonicsOf(vtkPolyData* mesh, int count = 100)
{
  auto harmonics = vtkSmartPointer<vtkManifoldHarmonics>::New();
  harmonics->SetInputData(mesh);
  harmonics->SetNumberOfHarmonics(count);
  return harmonics;
}

vtkSmartPointer<vtkPolyDataAlgorithm> LargeHarmonics()
{
  return HarmonicsOf(LargeSphere());
}

vtkSmartPointer<vtkPolyDataAlgorithm> DenseHarmonics()
{
  const auto harmonics = HarmonicsOf(PolyData(shapes::Icosphere(4)));
  harmonics->SetSolverToDense();
  return harmonics;
}

vtkSmartPointer<vtkPolyDataAlgorithm> ReconstructionFromABasis()
{
  const auto harmonics = HarmonicsOf(LargeSphere(), 60);
  harmonics->Update();
  auto reconstruction = vtkSmartPointer<vtkManifoldHarmonicsReconstruction>::New();
  reconstruction->SetInputData(harmonics->GetOutput());
  return reconstruction;
}

vtkSmartPointer<vtkPolyDataAlgorithm> LargeEmbedding()
{
  auto embed = vtkSmartPointer<vtkSpectralWatermarkEmbed>::New();
  embed->SetInputData(LargeSphere());
  embed->SetSecretKey("an owner");
  return embed;
}

vtkSmartPointer<vtkPolyDataAlgorithm> LargeEmbeddingInPaperSlots()
{
  auto embed = vtkSmartPointer<vtkSpectralWatermarkEmbed>::New();
  embed->SetInputData(LargeSphere());
  embed->SetSchemeToPaperSlots();
  embed->SetMessage("1011001110001111");
  return embed;
}

vtkSmartPointer<vtkPolyDataAlgorithm> HugeDetection()
{
  auto detect = vtkSmartPointer<vtkSpectralWatermarkDetect>::New();
  detect->SetInputData(HugeSphere());
  detect->SetSecretKey("an owner");
  return detect;
}

vtkSmartPointer<vtkMeshDistortion> HugeDistortion()
{
  auto distortion = vtkSmartPointer<vtkMeshDistortion>::New();
  distortion->SetInputData(0, HugeSphere());
  distortion->SetInputData(1, HugeSphere());
  return distortion;
}

vtkSmartPointer<vtkPolyDataAlgorithm> AttackOnManyTriangles()
{
  shapes::TriangleMesh mesh = shapes::Icosphere(0);
  mesh.Triangles = mesh.Triangles.row(0).replicate(1000000, 1).eval();
  auto attack = vtkSmartPointer<vtkMeshAttack>::New();
  attack->SetInputData(PolyData(mesh));
  return attack;
}

struct Case
{
  const char* Name;
  vtkSmartPointer<vtkPolyDataAlgorithm> (*Filter)();
  const char* Work;
  const char* Advice;
  double Free = Little;
};

void PrintTo(const Case& that, std::ostream* os)
{
  *os << that.Name;
}

const Case Cases[] = {
  { "Harmonics", LargeHarmonics, "100 harmonics of 40962 vertices", "ask for fewer harmonics" },
  { "DenseSolver", DenseHarmonics, "100 harmonics of 2562 vertices", "choose another solver" },
  { "ExistingBasis", ReconstructionFromABasis, "60 harmonics of 40962 vertices",
    "ask for fewer harmonics" },
  { "Embedding", LargeEmbedding, "64 bits in 40962 vertices", "embed fewer bits" },
  // One basis would fit; the second is computed beside it.
  { "EmbeddingInPaperSlots", LargeEmbeddingInPaperSlots, "180 harmonics of 40962 vertices",
    "ask for fewer harmonics (or bits)", 40962 * (3900 + 20 * 180) },
  { "Detection", HugeDetection, "327680 triangles", "simplify the mesh first" },
  { "Distortion", [] { return vtkSmartPointer<vtkPolyDataAlgorithm>(HugeDistortion()); },
    "655360 triangles", "simplify the mesh first" },
  { "AnyMesh", AttackOnManyTriangles, "1000000 triangles", "simplify the mesh first" },
  { "Smoothing",
    []
    {
      return vtkSmartPointer<vtkPolyDataAlgorithm>(
        AttackOn(HugeSphere(), vtkMeshAttack::LaplacianSmoothing));
    },
    "327680 triangles", "simplify the mesh first" },
  { "Simplification",
    []
    {
      return vtkSmartPointer<vtkPolyDataAlgorithm>(
        AttackOn(HugeSphere(), vtkMeshAttack::Simplification));
    },
    "327680 triangles", "simplify the mesh first" },
};

class WorkThatDoesNotFit : public testing::TestWithParam<Case>
{
};

} // namespace

TEST_P(WorkThatDoesNotFit, IsRefused)
{
  const Case& that = GetParam();
  ExpectRefusal(that.Filter(), that.Work, that.Advice, that.Free);
}

INSTANTIATE_TEST_SUITE_P(Filters, WorkThatDoesNotFit, testing::ValuesIn(Cases),
  [](const testing::TestParamInfo<Case>& refused) { return std::string(refused.param.Name); });

TEST(MemoryBudget, AFilterWorksOnceItsWorkFits)
{
  const auto harmonics = LargeHarmonics();
  ExpectRefusal(harmonics, "100 harmonics of 40962 vertices", "ask for fewer harmonics");
  harmonics->Modified();
  harmonics->Update();
  EXPECT_EQ(harmonics->GetErrorCode(), vtkErrorCode::NoError);
  EXPECT_EQ(PointArray(harmonics->GetOutput(), "ManifoldHarmonics")->GetNumberOfComponents(), 100);
}

TEST(MemoryBudget, ARefusedDistortionIsUnknown)
{
  const auto distortion = HugeDistortion();
  ExpectRefusal(distortion, "655360 triangles", "simplify the mesh first");
  EXPECT_EQ(distortion->GetMSDM2(), -1.0);
}

namespace
{

vtkSmartPointer<vtkPolyDataAlgorithm> DetectionIn(vtkPolyData* mesh)
{
  auto detect = vtkSmartPointer<vtkSpectralWatermarkDetect>::New();
  detect->SetInputData(mesh);
  detect->SetSecretKey("an owner");
  detect->SetNumberOfBits(2); // is done soon
  return detect;
}

// 9.7 pieces for each of its triangles, and a grid of 94 cells along each side.
constexpr double BytesToRemeshLargeSphere = 81920.0 * 9.7 * 400.0 + 94.0 * 94.0 * 94.0 * 100.0;

// A grid of 257 nodes along each side, and the squares of its steps on the surface.
constexpr double BytesOfIsosurface = 257.0 * 257.0 * 257.0 * 6.0 + 12.56 * 125.0 * 125.0 * 1000.0;

vtkSmartPointer<vtkPolyDataAlgorithm> IsosurfaceOf(vtkPolyData* mesh)
{
  const auto attack = AttackOn(mesh, vtkMeshAttack::Remeshing);
  attack->SetRemeshingMethodToIsosurface();
  attack->SetIsosurfaceResolution(250);
  return attack;
}

bool Succeeds(vtkPolyDataAlgorithm* filter, double free)
{
  Listener listener(filter);
  const AddressSpaceLimit limit(free);
  filter->Modified();
  filter->Update();
  return filter->GetErrorCode() == vtkErrorCode::NoError;
}

} // namespace

// The estimates: a little less is refused, and with what they ask for the work comes to its end.
TEST(MemoryBudget, WhatIsAskedForSuffices)
{
  SPECTRALWATERMARK_SKIP_UNLESS_FULL();
  const auto sphere = HugeSphere();
  const auto torus = PolyData(shapes::Torus(400, 160));
  const auto ofSphere = static_cast<double>(sphere->GetNumberOfPolys());
  const auto ofTorus = static_cast<double>(torus->GetNumberOfPolys());
  constexpr double vertices = 40962.0;
  const std::vector<std::pair<vtkSmartPointer<vtkPolyDataAlgorithm>, double>> asked = {
    { DetectionIn(torus), 455.0 * ofTorus },
    { AttackOn(sphere, vtkMeshAttack::LaplacianSmoothing), 225.0 * ofSphere },
    { AttackOn(torus, vtkMeshAttack::Simplification), 565.0 * ofTorus },
    { AttackOn(torus, vtkMeshAttack::Subdivision), 165.0 * 4.0 * ofTorus },
    { AttackOn(LargeSphere(), vtkMeshAttack::Remeshing), BytesToRemeshLargeSphere },
    { IsosurfaceOf(LargeSphere()), BytesOfIsosurface },
    { LargeHarmonics(), vertices * (3900.0 + 17.0 * 100.0) },
  };
  for (const auto& [filter, bytes] : asked)
  {
    SCOPED_TRACE(filter->GetClassName());
    EXPECT_FALSE(Succeeds(filter, 0.9 * bytes));
    EXPECT_TRUE(Succeeds(filter, 1.1 * bytes));
  }
}

// Too little for what no estimate asks about.
TEST(MemoryBudget, AnAllocationThatFailsIsReported)
{
  vtkNew<vtkMeshAttack> attack;
  attack->SetInputData(LargeSphere());
  attack->SetAttackToNoiseUniform();
  Listener listener(attack);
  {
    const AddressSpaceLimit limit(0.0);
    ASSERT_TRUE(limit.Holds());
    constexpr std::size_t piece = 1 << 18;               // less than any array of this mesh
    std::vector<std::unique_ptr<char[]>> taken(1 << 12); // what is free inside the process
    for (auto& bytes : taken)
    {
      bytes.reset(new (std::nothrow) char[piece]);
    }
    ASSERT_EQ(taken.back(), nullptr);
    attack->Update();
  }
  EXPECT_EQ(attack->GetErrorCode(), vtkErrorCode::UnknownError);
  EXPECT_NE(listener.Errors.find("not enough memory; close other programs, or simplify"),
    std::string::npos)
    << listener.Errors;
  EXPECT_EQ(attack->GetOutput()->GetNumberOfPoints(), 0);
}

TEST(MemoryBudget, FreeMemoryIsReported)
{
  const AddressSpaceLimit limit(Little);
  ASSERT_TRUE(limit.Holds());
  EXPECT_LE(vtkSpectralWatermarkAlgorithm::GetAvailableMemory(), Little);
  EXPECT_GT(vtkSpectralWatermarkAlgorithm::GetAvailableMemory(), 0.5 * Little);
}

TEST(MemoryBudget, AttacksNameTheirParameter)
{
  vtkNew<vtkMeshAttack> attack;
  attack->SetInputData(LargeSphere());
  attack->SetAttackToSubdivision();
  attack->SetNumberOfSubdivisions(6);
  ExpectRefusal(attack, "335544320 triangles", "lower it", Little, "NumberOfSubdivisions");
  attack->SetSubdivisionTypeToSqrt3();
  ExpectRefusal(attack, "59719680 triangles", "lower it", Little, "NumberOfSubdivisions");
  attack->SetAttackToRemeshing();
  attack->SetRemeshingPercent(1000.0);
  ExpectRefusal(attack, "409620 vertices", "lower it", Little, "RemeshingPercent");
  attack->SetRemeshingMethodToIsosurface();
  attack->SetIsosurfaceResolution(1024);
  ExpectRefusal(attack, "1024 steps along the longest side", "lower it", Little,
    "IsosurfaceResolution");
}

#endif

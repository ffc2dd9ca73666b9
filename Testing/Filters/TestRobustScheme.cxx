// SPDX-License-Identifier: BSD-3-Clause
// The scheme Robust as a user of the filters meets it.
#include "Support/FilterTesting.h"

#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkMeshAttack.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSpectralWatermarkDetect.h>
#include <vtkSpectralWatermarkEmbed.h>
#include <vtkTable.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <sstream>

using namespace filtertesting;

namespace
{

// A solid with three different axes and no symmetry.
vtkSmartPointer<vtkPolyData> Host(int level, bool storesFloat = false)
{
  shapes::TriangleMesh mesh = shapes::Bumpy(level);
  mesh.Points *= Eigen::Vector3d(1.5, 1.0, 0.7).asDiagonal();
  return PolyData(mesh, storesFloat);
}

vtkSmartPointer<vtkSpectralWatermarkEmbed> EmbedIn(vtkPolyData* mesh, const char* secret)
{
  auto embed = vtkSmartPointer<vtkSpectralWatermarkEmbed>::New();
  embed->SetInputData(mesh);
  embed->SetSecretKey(secret);
  return embed;
}

// Whose mark is it? Asks without knowing the message.
vtkSmartPointer<vtkSpectralWatermarkDetect> DetectIn(vtkPolyData* mesh, const char* secret)
{
  auto detect = vtkSmartPointer<vtkSpectralWatermarkDetect>::New();
  detect->SetInputData(mesh);
  detect->SetSecretKey(secret);
  detect->UseDerivedMessageOn();
  return detect;
}

// A figure in the field data of the table, as an application without getters sees it.
double Result(vtkAlgorithm* filter, const char* name)
{
  vtkDataArray* array = filter->GetOutputDataObject(1)->GetFieldData()->GetArray(name);
  return array != nullptr ? array->GetComponent(0, 0) : NAN;
}

using Attack = std::function<void(vtkMeshAttack*)>;

std::vector<std::pair<const char*, Attack>> Attacks()
{
  return {
    { "similarity", [](vtkMeshAttack* a) { a->SetAttackToSimilarity(); } },
    { "reordering", [](vtkMeshAttack* a) { a->SetAttackToVertexReordering(); } },
    { "noise", [](vtkMeshAttack* a) { a->SetAttackToNoiseUniform(); } },
    { "smoothing", [](vtkMeshAttack* a) { a->SetAttackToLaplacianSmoothing(); } },
    { "quantization", [](vtkMeshAttack* a) { a->SetAttackToQuantization(); } },
    { "simplification", [](vtkMeshAttack* a) { a->SetAttackToSimplification(); } },
    { "midpoint", [](vtkMeshAttack* a) { a->SetAttackToSubdivision(); } },
    { "Loop",
      [](vtkMeshAttack* a)
      {
        a->SetAttackToSubdivision();
        a->SetSubdivisionTypeToLoop();
      } },
    { "sqrt3",
      [](vtkMeshAttack* a)
      {
        a->SetAttackToSubdivision();
        a->SetSubdivisionTypeToSqrt3();
      } },
    { "remeshing", [](vtkMeshAttack* a) { a->SetAttackToRemeshing(); } },
    { "isosurface",
      [](vtkMeshAttack* a)
      {
        a->SetAttackToRemeshing();
        a->SetRemeshingMethodToIsosurface();
        a->SetIsosurfaceResolution(128);
      } },
  };
}

void ExpectMineAfterEveryAttack(vtkPolyData* marked, double largest)
{
  for (const auto& [name, set] : Attacks())
  {
    SCOPED_TRACE(name);
    vtkNew<vtkMeshAttack> attack;
    attack->SetInputData(marked);
    set(attack);
    attack->Update();
    const auto detect = DetectIn(attack->GetOutput(), "mine");
    detect->Update();
    EXPECT_LE(detect->GetPValue(), largest);
    EXPECT_EQ(detect->GetDetected(), 1);
    EXPECT_EQ(detect->GetMessageIsValid(), 1);
    EXPECT_EQ(detect->GetBitErrorRate(), 0.0);
  }
}

} // namespace

TEST(RobustScheme, IsTheDefaultAndHasItsOwnDefaults)
{
  vtkNew<vtkSpectralWatermarkEmbed> embed;
  EXPECT_EQ(vtkNew<vtkSpectralWatermarkDetect>()->GetScheme(), vtkSpectralWatermarkDetect::Robust);
  EXPECT_EQ(embed->GetScheme(), vtkSpectralWatermarkEmbed::Robust);
  EXPECT_STREQ(embed->GetSchemeAsString(), "Robust");
  EXPECT_STREQ(embed->GetMessage(), "");
  EXPECT_EQ(embed->GetNumberOfBits(), 64);
  EXPECT_EQ(embed->GetMaximumDistortion(), 0.07);
  embed->SetMessage("10110");
  EXPECT_STREQ(embed->GetMessage(),
    "10110"); // set is set, whatever the default of the other scheme
  embed->SetNumberOfBits(32);
  EXPECT_EQ(embed->GetNumberOfBits(), 32);
  embed->SetNumberOfBits(0);
  EXPECT_EQ(embed->GetNumberOfBits(), 64);

  vtkNew<vtkSpectralWatermarkEmbed> papers;
  papers->SetSchemeToPaperSlots();
  EXPECT_STREQ(papers->GetMessage(), "10110");
  EXPECT_EQ(papers->GetNumberOfBits(), 5);
}

TEST(RobustScheme, ReportsTheCapacityWhenAsked)
{
  const auto embed = EmbedIn(Host(3), "mine");
  embed->SetNumberOfBits(16);
  embed->Update();
  EXPECT_EQ(embed->GetCapacity(), 0);
  embed->ReportCapacityOn();
  embed->Update();
  EXPECT_GE(embed->GetCapacity(), 16);
  EXPECT_LE(embed->GetCapacity(), 1024);
  EXPECT_EQ(embed->GetConverged(), 1);
}

TEST(RobustScheme, MarksWithSixtyFourBitsOfTheKey)
{
  const auto mesh = Host(5);
  const auto embed = EmbedIn(mesh, "mine");
  Listener listener(embed);
  embed->Update();
  EXPECT_EQ(listener.Errors, "");
  EXPECT_EQ(listener.Warnings, "");
  EXPECT_EQ(embed->GetConverged(), 1);
  EXPECT_EQ(std::string(embed->GetExtractedMessage()).size(), 64u);
  EXPECT_LE(embed->GetDistortion(), 0.07);
  EXPECT_GT(embed->GetDistortion(), 0.03);
  EXPECT_GT(embed->GetMargin(), 0.9);
  EXPECT_EQ(embed->GetOutput()->GetNumberOfPoints(), mesh->GetNumberOfPoints());
  EXPECT_NE(PointArray(embed->GetOutput(), "GeometricDistortion"), nullptr);
  auto* rounds = vtkTable::SafeDownCast(embed->GetOutputDataObject(1));
  EXPECT_EQ(rounds->GetNumberOfRows(), embed->GetNumberOfIterationsUsed() + 1);
  EXPECT_LT(rounds->GetValueByName(rounds->GetNumberOfRows() - 1, "LargestError").ToDouble(), 0.01);

  const auto detect = DetectIn(embed->GetOutput(), "mine");
  detect->Update();
  EXPECT_EQ(detect->GetDetected(), 1);
  EXPECT_EQ(detect->GetMessageIsValid(), 1);
  EXPECT_EQ(detect->GetBitErrorRate(), 0.0);
  EXPECT_LT(detect->GetPValue(), 1e-25); // 2^-84
  EXPECT_STREQ(detect->GetExtractedMessage(), embed->GetExtractedMessage());
  EXPECT_EQ(Result(embed, "Margin"), embed->GetMargin());
  EXPECT_EQ(Result(embed, "Distortion"), embed->GetDistortion());
  EXPECT_EQ(Result(detect, "PValue"), detect->GetPValue());
  EXPECT_EQ(Result(detect, "Detected"), 1.0);
  EXPECT_EQ(vtkTable::SafeDownCast(detect->GetOutputDataObject(1))->GetNumberOfRows(), 168);

  const auto other = DetectIn(embed->GetOutput(), "yours");
  other->Update();
  EXPECT_EQ(other->GetDetected(), 0);
  EXPECT_EQ(other->GetMessageIsValid(), 0);
  EXPECT_GT(other->GetPValue(), 1e-4);
  const auto unmarked = DetectIn(mesh, "mine");
  unmarked->Update();
  EXPECT_EQ(unmarked->GetDetected(), 0);
  EXPECT_EQ(unmarked->GetMessageIsValid(), 0);
}

TEST(RobustScheme, SurvivesEveryAttack)
{
  const auto embed = EmbedIn(Host(5), "mine");
  embed->Update();
  ExpectMineAfterEveryAttack(embed->GetOutput(), 1e-20);
}

TEST(RobustScheme, CarriesAMessageForEveryoneWithoutAKey)
{
  vtkNew<vtkSpectralWatermarkEmbed> embed;
  embed->SetInputData(Host(4, true));
  embed->SetMessage("110010111");
  embed->Update();
  EXPECT_EQ(embed->GetConverged(), 1);
  vtkNew<vtkSpectralWatermarkDetect> detect;
  detect->SetInputConnection(embed->GetOutputPort());
  detect->SetNumberOfBits(9);
  detect->Update();
  EXPECT_STREQ(detect->GetExtractedMessage(), "110010111");
  EXPECT_EQ(detect->GetMessageIsValid(), 1);
  EXPECT_EQ(detect->GetPValue(), 1.0); // nothing was expected
  detect->SetExpectedMessage("110010111");
  detect->Update();
  EXPECT_EQ(detect->GetDetected(), 1);
  EXPECT_EQ(detect->GetBitErrorRate(), 0.0);
}

// A model with a hole still encloses its volume, all but a little.
TEST(RobustScheme, SmallHolesDoNoHarm)
{
  vtkNew<vtkMeshAttack> open;
  open->SetInputData(Host(4));
  open->SetAttackToCropping();
  open->SetCroppingPercent(1.0);
  open->Update();
  const auto embed = EmbedIn(open->GetOutput(), "mine");
  embed->Update();
  EXPECT_EQ(embed->GetConverged(), 1);
  vtkNew<vtkMeshAttack> moved;
  moved->SetInputConnection(embed->GetOutputPort());
  moved->SetAttackToSimilarity();
  moved->Update();
  const auto detect = DetectIn(moved->GetOutput(), "mine");
  detect->Update();
  EXPECT_EQ(detect->GetMessageIsValid(), 1);
  EXPECT_EQ(detect->GetDetected(), 1);
}

TEST(RobustScheme, SaysWhatItCannotDo)
{
  const auto expectError = [](vtkAlgorithm* filter, const char* part)
  {
    Listener listener(filter);
    filter->Update();
    EXPECT_NE(listener.Errors.find(part), std::string::npos) << listener.Errors;
  };
  const auto sheet = PolyData(shapes::Rectangle(6, 6, 1.0, 1.0));
  expectError(EmbedIn(sheet, "mine"), "encloses no volume");
  expectError(DetectIn(sheet, "mine"), "encloses no volume");
  shapes::TriangleMesh fold; // a positive volume, and a negative extent
  fold.Points.resize(5, 3);
  fold.Points << 1.0, 2.0, 2.0, 0.0, 0.0, 3.0, 3.0, 3.0, 2.0, 3.0, 1.0, 1.0, 3.0, 0.0, 1.0;
  fold.Triangles.resize(3, 3);
  fold.Triangles << 0, 1, 2, 1, 2, 3, 2, 3, 4;
  expectError(EmbedIn(PolyData(fold), "mine"), "too open to have an inside");
  expectError(DetectIn(PolyData(fold), "mine"), "too open to have an inside");
  const auto mesh = Host(3);
  auto embed = EmbedIn(mesh, "mine");
  embed->SetMaximumDistortion(1e-5);
  expectError(embed, "64 bits would move the surface by");
  embed = EmbedIn(mesh, "mine");
  embed->SetNumberOfBits(5000);
  expectError(embed, "takes messages of 1 to 1024 bits, not 5000");
  embed = EmbedIn(mesh, "");
  expectError(embed, "the message is empty");
  embed = EmbedIn(mesh, "mine");
  embed->SetMessage("10x");
  expectError(embed, "0 and 1");
  const auto detect = DetectIn(mesh, "");
  expectError(detect, "UseDerivedMessage: there is no secret key");
}

// Far from the origin, float has steps as large as the distortion that is allowed.
TEST(RobustScheme, WarnsOfAMarkThatRoundingSpoils)
{
  const auto mesh = Host(3);
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    double p[3];
    mesh->GetPoint(i, p);
    mesh->GetPoints()->SetPoint(i, p[0] + 1e5, p[1] + 1e5, p[2] + 1e5);
  }
  const auto embed = EmbedIn(mesh, "mine");
  embed->SetMessage("10110");
  embed->SetOutputPointsPrecision(vtkAlgorithm::SINGLE_PRECISION);
  Listener listener(embed);
  embed->Update();
  EXPECT_EQ(embed->GetConverged(), 0);
  EXPECT_EQ(listener.Errors, "");
  for (const char* part : { "embedding did not succeed", "or store double points" })
  {
    EXPECT_NE(listener.Warnings.find(part), std::string::npos) << listener.Warnings;
  }
}

TEST(RobustScheme, PrintsItsProperties)
{
  std::ostringstream text;
  EmbedIn(Host(2), "mine")->Print(text);
  for (const char* name :
    { "Scheme: Robust", "MaximumDistortion: 0.07", "Distortion: 0", "Margin: 0" })
  {
    EXPECT_NE(text.str().find(name), std::string::npos) << name;
  }
  EXPECT_EQ(text.str().find("mine"), std::string::npos);
}

class RobustScan : public testing::TestWithParam<const char*>
{
};

// Sixty-four bits in real scans, under the budget, read after each attack.
TEST_P(RobustScan, IsMineAfterEveryAttack)
{
  const auto mesh = ReadScan(GetParam());
  if (const std::string reason = WhyToSkip(GetParam(), mesh); !reason.empty())
  {
    GTEST_SKIP() << reason;
  }
  const auto embed = EmbedIn(mesh, "mine");
  embed->Update();
  EXPECT_EQ(embed->GetConverged(), 1);
  EXPECT_LE(embed->GetDistortion(), 0.07);
  ExpectMineAfterEveryAttack(embed->GetOutput(), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Scans, RobustScan, testing::Values("elephant", "bunny"));

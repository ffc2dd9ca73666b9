// SPDX-License-Identifier: BSD-3-Clause
// Who has the key reads the mark; who has another, or none, reads coin flips.
#include "Support/FilterTesting.h"
#include "Support/FullTests.h"

#include <vtkErrorCode.h>
#include <vtkManifoldHarmonics.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSpectralWatermarkDetect.h>
#include <vtkSpectralWatermarkEmbed.h>
#include <vtkTable.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <set>
#include <sstream>

using namespace filtertesting;

namespace
{

// A mesh with its basis, so that detections cost next to nothing.
vtkSmartPointer<vtkPolyData> WithBasis(vtkPolyData* mesh, int count)
{
  vtkNew<vtkManifoldHarmonics> harmonics;
  harmonics->SetInputData(mesh);
  harmonics->SetNumberOfHarmonics(count);
  harmonics->Update();
  return harmonics->GetOutput();
}

class TextFile
{
public:
  explicit TextFile(const std::string& content)
    : Path(testing::TempDir() + "spectralwatermark-test.key")
  {
    std::ofstream(this->Path, std::ios::binary) << content;
  }
  ~TextFile() { std::remove(this->Path.c_str()); }

  std::string Path;
};

class SecretKeys : public testing::Test
{
protected:
  SecretKeys()
  {
    this->Embed->SetSchemeToPaperSlots();
    this->Detect->SetSchemeToPaperSlots();
    this->Embed->SetInputData(PolyData(shapes::Bumpy(4)));
    this->Embed->SetSecretKey("the right key");
    this->Embed->SetMessage("");
    this->Embed->SetNumberOfBits(12);
    this->Detect->SetInputConnection(this->Embed->GetOutputPort());
    this->Detect->SetNumberOfBits(12);
  }

  std::string ErrorOf(vtkAlgorithm* filter)
  {
    Listener listener(filter);
    filter->Update();
    EXPECT_EQ(filter->GetErrorCode(), vtkErrorCode::UserError);
    return listener.Errors;
  }

  vtkNew<vtkSpectralWatermarkEmbed> Embed;
  vtkNew<vtkSpectralWatermarkDetect> Detect;
};

} // namespace

TEST_F(SecretKeys, DerivedMessageIsFoundWithNothingButTheKey)
{
  this->Detect->SetSecretKey("the right key");
  this->Detect->UseDerivedMessageOn();
  this->Detect->SetFalsePositiveRate(1e-3);
  this->Detect->Update();
  ASSERT_EQ(this->Embed->GetConverged(), 1);
  EXPECT_EQ(std::string(this->Embed->GetExtractedMessage()).size(), 12u);
  EXPECT_STREQ(this->Detect->GetExtractedMessage(), this->Embed->GetExtractedMessage());
  EXPECT_EQ(this->Detect->GetBitErrorRate(), 0.0);
  EXPECT_NEAR(this->Detect->GetPValue(), std::ldexp(1.0, -12), 1e-12);
  EXPECT_EQ(this->Detect->GetDetected(), 1);
  EXPECT_GT(this->Detect->GetLogLikelihoodRatio(), 0.0);
}

TEST_F(SecretKeys, GivenMessageIsReadWithTheKey)
{
  this->Embed->SetMessage("1100101");
  this->Detect->SetSecretKey("the right key");
  this->Detect->SetNumberOfBits(7);
  this->Detect->Update();
  ASSERT_EQ(this->Embed->GetConverged(), 1);
  EXPECT_STREQ(this->Detect->GetExtractedMessage(), "1100101");
}

// Every bit under a wrong key is a fair coin: over 400 keys, within four standard deviations.
TEST_F(SecretKeys, WrongKeysReadAtChance)
{
  this->Embed->Update();
  ASSERT_EQ(this->Embed->GetConverged(), 1);
  const auto marked = WithBasis(this->Embed->GetOutput(), 140);
  this->Detect->SetInputData(marked);
  this->Detect->UseDerivedMessageOn();
  this->Detect->SetFalsePositiveRate(0.02);
  constexpr int keys = 400;
  double errors = 0.0;
  int claims = 0;
  for (int i = 0; i < keys; ++i)
  {
    this->Detect->SetSecretKey(("wrong key " + std::to_string(i)).c_str());
    this->Detect->Update();
    ASSERT_EQ(this->Detect->GetNumberOfEigensolves(), 0);
    errors += this->Detect->GetBitErrorRate();
    claims += this->Detect->GetDetected();
  }
  EXPECT_NEAR(errors / keys, 0.5, 4.0 * 0.5 / std::sqrt(12.0 * keys));
  EXPECT_LE(claims, 0.02 * keys + 4.0 * std::sqrt(0.02 * keys));
}

TEST_F(SecretKeys, NoKeyReadsAtChanceToo)
{
  const int keys = QuickOrFull(5, 12); // an embedding each, some with all its iterations
  int errors = 0;
  this->Embed->SetInputData(PolyData(shapes::Bumpy(3)));
  this->Embed->SetMaximumNumberOfIterations(4);
  Listener listener(this->Embed); // some do not converge
  for (int i = 0; i < keys; ++i)
  {
    this->Embed->SetSecretKey(("owner " + std::to_string(i)).c_str());
    this->Embed->SetMessage("111111111111");
    this->Detect->Update();
    for (const char bit : std::string(this->Detect->GetExtractedMessage()))
    {
      errors += bit == '0' ? 1 : 0;
    }
  }
  EXPECT_NEAR(errors, 6.0 * keys, 5.0 * std::sqrt(3.0 * keys));
}

TEST_F(SecretKeys, CarriersMoveWithTheKeyAndStayInTheirSlots)
{
  std::set<int> positions;
  for (const char* secret : { "one", "two", "three" })
  {
    this->Detect->SetInputData(WithBasis(PolyData(shapes::Bumpy(3)), 140));
    this->Detect->SetSecretKey(secret);
    this->Detect->Update();
    auto* table = vtkTable::SafeDownCast(this->Detect->GetOutputDataObject(1));
    ASSERT_EQ(table->GetNumberOfRows(), 12);
    for (vtkIdType slot = 0; slot < 12; ++slot)
    {
      const int component = table->GetValueByName(slot, "Component").ToInt();
      const int position = component - (21 + 10 * static_cast<int>(slot)) + 1;
      EXPECT_GE(position, 2);
      EXPECT_LE(position, 9);
      positions.insert(position);
    }
  }
  EXPECT_GT(positions.size(), 5u);
}

TEST_F(SecretKeys, TheFileIsTheSameAsItsText)
{
  const TextFile file("the right key\n");
  this->Embed->SetSecretKey("");
  this->Embed->SetSecretKeyFile(file.Path.c_str());
  this->Detect->SetSecretKey("the right key");
  this->Detect->UseDerivedMessageOn();
  this->Detect->SetFalsePositiveRate(1e-3);
  this->Detect->Update();
  EXPECT_EQ(this->Embed->GetHasSecretKey(), 1);
  EXPECT_EQ(this->Detect->GetDetected(), 1);
}

TEST_F(SecretKeys, FilesThatCannotBeUsedAreErrors)
{
  this->Embed->SetSecretKey(nullptr);
  this->Embed->SetSecretKeyFile("/no/such/file.key");
  EXPECT_NE(
    this->ErrorOf(this->Embed).find("SecretKeyFile: the file \"/no/such/file.key\" cannot be read"),
    std::string::npos);
  this->Embed->SetSecretKeyFile(testing::TempDir().c_str());
  EXPECT_NE(this->ErrorOf(this->Embed).find("cannot be read"), std::string::npos);
  const TextFile empty("\r\n");
  this->Embed->SetSecretKeyFile(empty.Path.c_str());
  EXPECT_NE(this->ErrorOf(this->Embed).find("is empty"), std::string::npos);
  const TextFile large(std::string((1 << 20) + 1, 'x'));
  this->Embed->SetSecretKeyFile(large.Path.c_str());
  this->Embed->Modified();
  EXPECT_NE(this->ErrorOf(this->Embed).find("over 1 MiB"), std::string::npos);
  this->Embed->SetSecretKey("and a key");
  EXPECT_NE(this->ErrorOf(this->Embed).find("a secret key is set as well"), std::string::npos);
}

TEST_F(SecretKeys, ContradictionsAreErrors)
{
  this->Detect->SetInputData(PolyData(shapes::Bumpy(3)));
  this->Detect->UseDerivedMessageOn();
  EXPECT_NE(this->ErrorOf(this->Detect).find("no secret key to derive a message from"),
    std::string::npos);
  this->Detect->SetSecretKey("a key");
  this->Detect->SetExpectedMessage("101");
  EXPECT_NE(this->ErrorOf(this->Detect).find("only one message"), std::string::npos);
  this->Embed->SetSecretKey("");
  EXPECT_NE(this->ErrorOf(this->Embed).find("or a secret key to derive a message from"),
    std::string::npos);
}

TEST_F(SecretKeys, TheSecretIsNeverPrinted)
{
  Listener listener(this->Detect);
  this->Detect->SetSecretKey("the right key");
  this->Detect->SetExpectedMessage("101010101010");
  this->Detect->Update();
  std::ostringstream text;
  this->Embed->Print(text);
  this->Detect->Print(text);
  this->Embed->GetOutput()->Print(text);
  this->Detect->GetOutput()->Print(text);
  text << listener.Errors << listener.Warnings;
  EXPECT_EQ(text.str().find("the right key"), std::string::npos);
  EXPECT_NE(text.str().find("HasSecretKey: 1"), std::string::npos);
}

// The likelihood detector reads the same bits and gives a p-value that enumeration confirms.
TEST_F(SecretKeys, LikelihoodWeighsWhatHardDecisionsCount)
{
  this->Embed->SetMessage("110010");
  this->Detect->SetSecretKey("the right key");
  this->Detect->SetExpectedMessage("110011");
  this->Detect->SetFalsePositiveRate(1.0);
  this->Detect->SetDetectorToLikelihood();
  this->Detect->Update();
  ASSERT_EQ(this->Embed->GetConverged(), 1);
  EXPECT_STREQ(this->Detect->GetDetectorAsString(), "Likelihood");
  EXPECT_STREQ(this->Detect->GetExtractedMessage(), "110010");
  auto* table = vtkTable::SafeDownCast(this->Detect->GetOutputDataObject(1));
  std::vector<double> weights;
  double ratio = 0.0;
  for (int slot = 0; slot < 6; ++slot)
  {
    const double zero = table->GetValueByName(slot, "LogLikelihoodRatio0").ToDouble();
    const double one = table->GetValueByName(slot, "LogLikelihoodRatio1").ToDouble();
    const int bit = table->GetValueByName(slot, "Bit").ToInt();
    weights.push_back(std::max(0.0, bit == 1 ? one - zero : zero - one));
    ratio += "110011"[slot] == '1' ? one : zero;
    EXPECT_NEAR(table->GetValueByName(slot, "Confidence").ToDouble(),
      1.0 / (1.0 + std::exp(bit == 1 ? zero - one : one - zero)), 1e-12);
  }
  EXPECT_NEAR(this->Detect->GetLogLikelihoodRatio(), ratio, 1e-9);
  double reached = 0.0;
  for (std::size_t slot = 0; slot < 5; ++slot) // all but the last agree
  {
    reached += weights[slot];
  }
  int sets = 0;
  for (int set = 0; set < 64; ++set)
  {
    double weight = 0.0;
    for (std::size_t slot = 0; slot < 6; ++slot)
    {
      weight += (set >> slot) % 2 == 1 ? weights[slot] : 0.0;
    }
    sets += weight >= reached - 1e-6 ? 1 : 0;
  }
  EXPECT_NEAR(this->Detect->GetPValue(), sets / 64.0, 1e-12);
}

// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Attacks/Attacks.h"
#include "Core/Mesh/Measures.h"
#include "Core/RobustScheme/CarrierSet.h"
#include "Core/RobustScheme/RobustEmbedding.h"
#include "Core/RobustScheme/RobustReader.h"
#include "Core/Support/Errors.h"
#include "Core/Support/Progress.h"
#include "Support/CoreTesting.h"
#include "Support/RobustTesting.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

using namespace spectralwatermark;
using namespace robusttesting;

TEST(RobustEmbedding, KeepsItsBudgetAndIsReadBackBlind)
{
  const SecretKey key("secret");
  const TriangleMesh mesh = Host(4);
  const RobustEmbeddingResult result = Marked(mesh, key);
  EXPECT_TRUE(result.Converged);
  EXPECT_EQ(result.ExtractedMessage, Message);
  EXPECT_LE(result.Distortion, 0.0007);
  EXPECT_GT(result.Distortion, 0.0003); // it is spent
  EXPECT_GT(result.Margin, 0.9);
  EXPECT_LT(result.Rounds.back().LargestError, 0.01);

  // By a second construction: the areas' mean of the squared displacement.
  const Eigen::VectorXd areas = VertexAreas(mesh);
  const double square =
    areas.dot((result.Points - mesh.Points).rowwise().squaredNorm()) / areas.sum();
  const double diagonal =
    (mesh.Points.colwise().maxCoeff() - mesh.Points.colwise().minCoeff()).norm();
  EXPECT_NEAR(std::sqrt(square) / diagonal, result.Distortion, 1e-12);

  const RobustReading reading = ReadRobust(With(mesh, result.Points), key, 16, 2, Progress());
  EXPECT_TRUE(reading.IsValid);
  EXPECT_EQ(reading.Message, Message);
  EXPECT_GT(reading.Fit, 0.99);
  const std::string data = DataOf(Message, key, CheckBitsOf(16));
  EXPECT_EQ(reading.Data, data);
  EXPECT_EQ(data.size(), 36u); // three words
  EXPECT_NEAR(PValueOf(reading, data), std::pow(0.5, 36), 1e-15);
  EXPECT_EQ(reading.Hypothesis.Smoothing, 0);
}

TEST(RobustEmbedding, IsReadByItsKeyOnly)
{
  const SecretKey key("secret");
  const TriangleMesh mesh = Host(4);
  const TriangleMesh marked = With(mesh, Marked(mesh, key).Points);
  const auto expectNothing = [](const TriangleMesh& read, const SecretKey& with)
  {
    const RobustReading reading = ReadRobust(read, with, 16, 2, Progress());
    EXPECT_FALSE(reading.IsValid);
    EXPECT_GT(PValueOf(reading, DataOf(Message, with, CheckBitsOf(16))), 1e-3);
  };
  expectNothing(marked, SecretKey("Secret"));
  expectNothing(marked, SecretKey("x"));
  expectNothing(mesh, key);
}

TEST(RobustEmbedding, SurvivesWhatLeavesTheSolid)
{
  const SecretKey key("secret");
  const TriangleMesh mesh = Host(4);
  const TriangleMesh marked = With(mesh, Marked(mesh, key).Points);
  const auto expectRead = [&](const char* what, const TriangleMesh& attacked)
  {
    const RobustReading reading = ReadRobust(attacked, key, 16, 2, Progress());
    EXPECT_TRUE(reading.IsValid) << what;
    EXPECT_EQ(reading.Message, Message) << what;
  };
  for (int seed = 0; seed < 3; ++seed)
  {
    const SimilarityTransform t = RandomSimilarity(marked, static_cast<std::uint64_t>(seed));
    expectRead("similarity",
      With(marked,
        (t.Scale * marked.Points * t.Rotation.transpose()).rowwise() + t.Translation.transpose()));
  }
  expectRead("noise", With(marked, NoiseUniform(marked, 0.003, 1)));
  expectRead("quantization", With(marked, Quantize(marked, 9)));
  TriangleMesh inverted = marked;
  inverted.Triangles.col(0).swap(inverted.Triangles.col(1));
  expectRead("inversion", inverted);
}

TEST(RobustEmbedding, RefusesWhatDoesNotFit)
{
  const auto refusal = [](const TriangleMesh& mesh, std::size_t bits, double distortion)
  {
    return coretesting::RefusalOf(
      [&] { Marked(mesh, SecretKey("secret"), std::string(bits, '1'), distortion); });
  };
  const std::string budget = refusal(Host(3), 64, 1e-7);
  EXPECT_NE(budget.find("64 bits would move the surface by"), std::string::npos) << budget;
  EXPECT_NE(budget.find("and 1e-05 % are allowed"), std::string::npos) << budget;
  EXPECT_NE(budget.find("; raise it: not even one bit fits"), std::string::npos) << budget;
  const std::string capacity = refusal(Host(3), 400, 0.0007); // 840 carriers, 642 vertices
  EXPECT_NE(capacity.find("too small or too simple for so many bits"), std::string::npos)
    << capacity;
}

TEST(RobustEmbedding, IsTheSameForAnyNumberOfThreads)
{
  const SecretKey key("secret");
  const TriangleMesh mesh = Host(3);
  RobustEmbeddingOptions options;
  options.Message = Message;
  options.Threads = 1;
  const RobustEmbeddingResult alone = EmbedRobust(mesh, key, options, Progress());
  options.Threads = 3;
  EXPECT_EQ(EmbedRobust(mesh, key, options, Progress()).Points, alone.Points);
}

TEST(RobustEmbedding, ProgressRisesAndAbortStops)
{
  const TriangleMesh mesh = Host(2);
  const SecretKey key("secret");
  RobustEmbeddingOptions options;
  options.Message = "10110";
  double last = 0.0;
  const Progress rising(
    [&last](double fraction)
    {
      EXPECT_GE(fraction, last);
      last = fraction;
      return true;
    });
  EmbedRobust(mesh, key, options, rising);
  EXPECT_EQ(last, 1.0);
  const Progress stopping([](double fraction) { return fraction < 0.6; });
  EXPECT_THROW(EmbedRobust(mesh, key, options, stopping), Aborted);
}

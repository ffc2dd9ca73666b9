// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Harmonics/ManifoldHarmonics.h"
#include "Core/Harmonics/Transform.h"
#include "Core/Mesh/RoundTrip.h"
#include "Core/PaperScheme/SlotEmbedding.h"
#include "Core/PaperScheme/Slots.h"
#include "Core/Payload/Bits.h"
#include "Core/Support/Errors.h"
#include "Support/CoreTesting.h"
#include "Support/Shapes.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>

using namespace spectralwatermark;
using coretesting::ExpectRefusal;

namespace
{

SlotEmbeddingOptions MessageOptions(const std::string& message)
{
  SlotEmbeddingOptions options;
  options.Message = message;
  return options;
}

std::string ReadBlind(const TriangleMesh& mesh, const SlotOptions& slots, Index bits)
{
  HarmonicsOptions options;
  options.Count = ComponentsNeeded(slots, bits);
  const ManifoldHarmonics harmonics = ComputeManifoldHarmonics(mesh, options);
  return MessageOf(ReadSlots(Magnitudes(ForwardTransform(harmonics, mesh.Points)), slots, bits));
}

// Stores squares of two triangles each, (a, b, c) and (a, c, d), with the shorter diagonal.
RoundTrip ShorterDiagonals(const TriangleMesh& mesh)
{
  return [&mesh](const TriangleMesh::PointMatrix& points)
  {
    RoundTripResult stored = ExactRoundTrip(mesh)(points);
    for (Index t = 0; t < mesh.NumberOfTriangles(); t += 2)
    {
      const Index a = mesh.Triangles(t, 0);
      const Index b = mesh.Triangles(t, 1);
      const Index c = mesh.Triangles(t, 2);
      const Index d = mesh.Triangles(t + 1, 2);
      if ((points.row(b) - points.row(d)).norm() < (points.row(a) - points.row(c)).norm())
      {
        stored.Mesh.Triangles.row(t) << a, b, d;
        stored.Mesh.Triangles.row(t + 1) << b, c, d;
      }
    }
    return stored;
  };
}

} // namespace

TEST(SlotEmbedding, EveryModeIsReadBackBlindOrSaysThatItDidNotConverge)
{
  const TriangleMesh mesh = shapes::Bumpy(4);
  for (const SlotDivision division : { SlotDivision::Normal, SlotDivision::InterleavedNarrow })
  {
    for (const BitEmbedding embedding : { BitEmbedding::Aggressive, BitEmbedding::NonAggressive })
    {
      SlotEmbeddingOptions options = MessageOptions("10110");
      options.Slots.Division = division;
      options.Slots.Embedding = embedding;
      const SlotEmbeddingResult result = EmbedMessageInSlots(mesh, options, std::nullopt);
      TriangleMesh marked = mesh;
      marked.Points = result.Points;
      EXPECT_EQ(ReadBlind(marked, options.Slots, 5), result.ExtractedMessage);
      EXPECT_EQ(result.Converged, result.ExtractedMessage == "10110");
      EXPECT_EQ(result.History.size(), static_cast<std::size_t>(result.Eigensolves));
      if (division == SlotDivision::Normal)
      {
        EXPECT_TRUE(result.Converged);
      }
    }
  }
}

TEST(SlotEmbedding, MessagesOfEveryKindAreReadBack)
{
  const TriangleMesh mesh = shapes::Bumpy(4);
  for (const std::string message : { "0", "00000", "11111", "01001", "1010011" })
  {
    const SlotEmbeddingResult result =
      EmbedMessageInSlots(mesh, MessageOptions(message), std::nullopt);
    EXPECT_TRUE(result.Converged) << message;
    EXPECT_EQ(result.ExtractedMessage, message);
    EXPECT_GE(result.Iterations, 1);
  }
}

TEST(SlotEmbedding, FloatPointsAreWhatWasVerified)
{
  const TriangleMesh mesh = shapes::Bumpy(3);
  SlotEmbeddingOptions options = MessageOptions("10110");
  options.Store = [&mesh](const TriangleMesh::PointMatrix& points)
  { return ExactRoundTrip(mesh)(points.cast<float>().cast<double>()); };
  const SlotEmbeddingResult result = EmbedMessageInSlots(mesh, options, std::nullopt);
  EXPECT_EQ((result.Points.cast<float>().cast<double>() - result.Points).norm(), 0.0);
  TriangleMesh marked = mesh;
  marked.Points = result.Points;
  EXPECT_EQ(ReadBlind(marked, options.Slots, 5), result.ExtractedMessage);
}

// Some diagonals change with the mark, and with them what some messages read.
TEST(SlotEmbedding, BitsAreReadFromWhatIsStored)
{
  const TriangleMesh squares = shapes::SquaresOnABall(6);
  const RoundTrip store = ShorterDiagonals(squares);
  const TriangleMesh mesh = store(squares.Points).Mesh;
  int misread = 0;
  for (const char* message : { "1", "1011", "0110", "01101", "10011", "10110010" })
  {
    SlotEmbeddingOptions options = MessageOptions(message);
    const auto bits = static_cast<Index>(options.Message.size());
    options.Store = store;
    const SlotEmbeddingResult result = EmbedMessageInSlots(mesh, options, std::nullopt);
    EXPECT_TRUE(result.Converged) << message;
    EXPECT_EQ(ReadBlind(store(result.Points).Mesh, options.Slots, bits), message);
    misread += ReadBlind({ result.Points, mesh.Triangles }, options.Slots, bits) != message ? 1 : 0;
  }
  EXPECT_GT(misread, 0);
}

// A mesh that cannot be read any more ends the search, with the best that there was.
TEST(SlotEmbedding, AMeshThatIsRefusedOnceStoredEndsTheSearch)
{
  const TriangleMesh mesh = shapes::Bumpy(3);
  SlotEmbeddingOptions options = MessageOptions("1111111");
  options.Slots.TurbulenceFactor = 0.0; // never read back
  int left = 2;
  options.Store = [&](const TriangleMesh::PointMatrix& points)
  {
    if (left-- == 0)
    {
      throw InvalidInput("", "there is nothing left", "");
    }
    return ExactRoundTrip(mesh)(points);
  };
  const SlotEmbeddingResult result = EmbedMessageInSlots(mesh, options, std::nullopt);
  EXPECT_FALSE(result.Converged);
  EXPECT_EQ(result.History.size(), 3u);
  EXPECT_EQ(ReadBlind({ result.Points, mesh.Triangles }, options.Slots, 7),
    result.ExtractedMessage);
  left = 0;
  ExpectRefusal([&]() { EmbedMessageInSlots(mesh, options, std::nullopt); },
    "there is nothing left");
}

TEST(SlotEmbedding, GivenBasisSavesOneSolveAndChangesNothing)
{
  const TriangleMesh mesh = shapes::Bumpy(3);
  HarmonicsOptions harmonicsOptions;
  harmonicsOptions.Count = 70;
  const ManifoldHarmonics basis = ComputeManifoldHarmonics(mesh, harmonicsOptions);
  const SlotEmbeddingResult own = EmbedMessageInSlots(mesh, MessageOptions("10110"), std::nullopt);
  const SlotEmbeddingResult given = EmbedMessageInSlots(mesh, MessageOptions("10110"), basis);
  EXPECT_EQ(given.Eigensolves, own.Eigensolves - 1);
  EXPECT_EQ((given.Points - own.Points).norm(), 0.0);
}

TEST(SlotEmbedding, ThresholdStopsEarlier)
{
  const TriangleMesh mesh = shapes::Bumpy(4);
  SlotEmbeddingOptions all = MessageOptions("1011001");
  all.Slots.Division = SlotDivision::InterleavedNarrow;
  SlotEmbeddingOptions some = all;
  some.RequiredBits = 4;
  const SlotEmbeddingResult strict = EmbedMessageInSlots(mesh, all, std::nullopt);
  const SlotEmbeddingResult loose = EmbedMessageInSlots(mesh, some, std::nullopt);
  EXPECT_TRUE(loose.Converged);
  EXPECT_GE(CountAgreements(loose.ExtractedMessage, all.Message), 4);
  EXPECT_LE(loose.History.size(), strict.History.size());
}

// s = 0 puts carriers on the average: they cannot be read back, and that is said.
TEST(SlotEmbedding, NonConvergenceIsReported)
{
  SlotEmbeddingOptions options = MessageOptions("1111111");
  options.Slots.TurbulenceFactor = 0.0;
  options.MaximumIterations = 1;
  const TriangleMesh mesh = shapes::Bumpy(3);
  const SlotEmbeddingResult result = EmbedMessageInSlots(mesh, options, std::nullopt);
  EXPECT_FALSE(result.Converged);
  EXPECT_NE(result.ExtractedMessage, options.Message);
  EXPECT_EQ(result.Iterations, 1);
  EXPECT_EQ(result.Points.rows(), mesh.NumberOfVertices());
}

TEST(SlotEmbedding, MessageOverTheSpectrumIsRefused)
{
  const TriangleMesh mesh = shapes::Bumpy(2); // 162 vertices: 14 bits at most
  EXPECT_THROW(EmbedMessageInSlots(mesh, MessageOptions(std::string(15, '1')), std::nullopt),
    InvalidInput);
}

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

#include <cmath>

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

TEST(SlotWatermark, PaperSlotsAreComponents21To70)
{
  const SlotOptions slots;
  EXPECT_EQ(ComponentsNeeded(slots, 5), 70);
  // Magnitude k is k: carriers 25, 35, ...; references 21..29 without 25.
  const Eigen::VectorXd magnitudes = Eigen::VectorXd::LinSpaced(70, 1.0, 70.0);
  const std::vector<SlotReading> readings = ReadSlots(magnitudes, slots, 5);
  ASSERT_EQ(readings.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i)
  {
    EXPECT_EQ(readings[i].Component, 25 + 10 * static_cast<Index>(i));
    EXPECT_DOUBLE_EQ(readings[i].Magnitude, 25.0 + 10.0 * static_cast<double>(i));
    EXPECT_DOUBLE_EQ(readings[i].Average, readings[i].Magnitude);
    EXPECT_NEAR(readings[i].Deviation, std::sqrt(60.0 / 8.0), 1e-12);
    EXPECT_EQ(readings[i].Bit(), 0); // c = a reads 0
  }
}

TEST(SlotWatermark, NarrowSlotsUseTheNeighboursOnly)
{
  SlotOptions slots;
  slots.Division = SlotDivision::InterleavedNarrow;
  Eigen::VectorXd magnitudes = Eigen::VectorXd::Constant(70, 100.0);
  magnitudes[23] = 3.0; // components 24 and 26
  magnitudes[25] = 7.0;
  magnitudes[24] = 6.0;
  const SlotReading reading = ReadSlots(magnitudes, slots, 5).front();
  EXPECT_DOUBLE_EQ(reading.Average, 5.0);
  EXPECT_DOUBLE_EQ(reading.Deviation, 2.0);
  EXPECT_DOUBLE_EQ(reading.Margin(), 0.5);
  EXPECT_EQ(reading.Bit(), 1);
}

// Figure 8: components 45 to 54, carrier 50.
TEST(SlotWatermark, FigureEightSlot)
{
  SlotOptions slots;
  slots.FirstComponent = 45;
  slots.CarrierPosition = 6;
  EXPECT_EQ(ReadSlots(Eigen::VectorXd::Ones(54), slots, 1).front().Component, 50);
  EXPECT_EQ(ComponentsNeeded(slots, 1), 54);
}

TEST(SlotWatermark, TargetsFollowEquations10And11)
{
  SlotReading reading;
  reading.Average = 10.0;
  reading.Deviation = 2.0;
  SlotOptions aggressive;
  SlotOptions gentle;
  gentle.Embedding = BitEmbedding::NonAggressive;
  const auto target = [&reading](double magnitude, int bit, const SlotOptions& options)
  {
    reading.Magnitude = magnitude;
    return TargetMagnitude(reading, bit, options);
  };
  EXPECT_EQ(target(13.0, 1, aggressive), 13.0); // c > a + s d stays
  EXPECT_EQ(target(11.0, 1, aggressive), 12.0); // a < c < a + s d moves
  EXPECT_EQ(target(9.0, 0, aggressive), 8.0);
  EXPECT_EQ(target(7.0, 0, aggressive), 7.0);
  EXPECT_EQ(target(11.0, 1, gentle), 11.0); // right side already: stays
  EXPECT_EQ(target(9.0, 1, gentle), 12.0);
  EXPECT_EQ(target(9.0, 0, gentle), 9.0);
  EXPECT_EQ(target(11.0, 0, gentle), 8.0);
  aggressive.TurbulenceFactor = 6.0;
  EXPECT_EQ(target(9.0, 0, aggressive), 0.0); // a magnitude is not negative
}

TEST(SlotWatermark, ChangeKeepsTheDirectionAndMovesTheMagnitude)
{
  Spectrum spectrum = Spectrum::Random(30, 3);
  spectrum.row(24) *= 0.01;
  SlotOptions slots;
  const std::vector<SlotReading> readings = ReadSlots(Magnitudes(spectrum), slots, 1);
  const Spectrum changed = spectrum + SpectrumChange(spectrum, readings, "1", slots);
  EXPECT_NEAR(changed.row(24).norm(), readings[0].Average + readings[0].Deviation, 1e-14);
  EXPECT_NEAR(changed.row(24).normalized().dot(spectrum.row(24).normalized()), 1.0, 1e-12);
  for (Index k = 0; k < 30; ++k)
  {
    if (k != 24)
    {
      EXPECT_EQ((changed.row(k) - spectrum.row(k)).norm(), 0.0);
    }
  }
  spectrum.row(24).setZero();
  const Spectrum fromZero =
    SpectrumChange(spectrum, ReadSlots(Magnitudes(spectrum), slots, 1), "1", slots);
  EXPECT_EQ(fromZero(24, 0), fromZero(24, 1));
  EXPECT_GT(fromZero(24, 2), 0.0);
}

TEST(SlotWatermark, ContradictoryOptionsAreRefused)
{
  SlotOptions slots;
  const auto expectRefusal = [&slots](Index bits, const std::string& piece)
  { ExpectRefusal([&] { CheckSlots(slots, bits); }, piece); };
  expectRefusal(0, "the message is empty");
  for (const int position : { 1, 10 })
  {
    slots.CarrierPosition = position;
    expectRefusal(5,
      "position " + std::to_string(position) + " is not inside a slot of 10 components");
  }
  slots = SlotOptions();
  slots.SlotSize = 3;
  slots.CarrierPosition = 2;
  expectRefusal(5, "slots of 3 components have no room for references");
  slots = SlotOptions();
  slots.FirstComponent = 1;
  expectRefusal(5, "component 1 is constant");
  slots = SlotOptions();
  slots.TurbulenceFactor = std::nan("");
  expectRefusal(5, "the value is negative or not finite");
  ExpectRefusal([] { CheckMessage("10x10"); }, "a character other than 0 and 1 at position 3");
  ExpectRefusal([] { CheckSlotsAboveKernel(SlotOptions(), 44); }, "the mesh has 44 components");
  EXPECT_NO_THROW(CheckSlotsAboveKernel(SlotOptions(), 20));
}

TEST(IterativeEmbedding, EveryModeIsReadBackBlindOrSaysThatItDidNotConverge)
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

TEST(IterativeEmbedding, MessagesOfEveryKindAreReadBack)
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

TEST(IterativeEmbedding, FloatPointsAreWhatWasVerified)
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
TEST(IterativeEmbedding, BitsAreReadFromWhatIsStored)
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

TEST(IterativeEmbedding, VerticesMayComeTogetherOrGetLost)
{
  const RoundTripResult stored{ {}, { 1, -1, 0, 1 }, {} };
  TriangleMesh::PointMatrix rows(2, 3);
  rows << 1.0, 2.0, 3.0, 4.0, 5.0, 6.0;
  TriangleMesh::PointMatrix expected(4, 3);
  expected << 4.0, 5.0, 6.0, 0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0;
  EXPECT_EQ(stored.ToStored(rows), expected);
}

// A mesh that cannot be read any more ends the search, with the best that there was.
TEST(IterativeEmbedding, AMeshThatIsRefusedOnceStored)
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

TEST(IterativeEmbedding, GivenBasisSavesOneSolveAndChangesNothing)
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

TEST(IterativeEmbedding, ThresholdStopsEarlier)
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
TEST(IterativeEmbedding, NonConvergenceIsReported)
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

TEST(IterativeEmbedding, MessageOverTheSpectrumIsRefused)
{
  const TriangleMesh mesh = shapes::Bumpy(2); // 162 vertices: 14 bits at most
  EXPECT_THROW(EmbedMessageInSlots(mesh, MessageOptions(std::string(15, '1')), std::nullopt),
    InvalidInput);
}

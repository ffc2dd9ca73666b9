// SPDX-License-Identifier: BSD-3-Clause
// The solid's Fourier transform and frame, and the code, against what is known of them.
#include "Core/Attacks/Attacks.h"
#include "Core/Mesh/Measures.h"
#include "Core/Mesh/Orientation.h"
#include "Core/Payload/GolayCode.h"
#include "Core/RobustScheme/SolidFrame.h"
#include "Core/RobustScheme/SolidSpectrum.h"
#include "Core/Support/Errors.h"
#include "Core/Support/Random.h"
#include "Support/Shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <vector>

using namespace spectralwatermark;

namespace
{

// Centred, with these sides: twelve triangles.
TriangleMesh Box(double a, double b, double c)
{
  TriangleMesh box;
  box.Points.resize(8, 3);
  box.Points << 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 1;
  box.Points = (box.Points.array() - 0.5).matrix() * Eigen::Vector3d(a, b, c).asDiagonal();
  box.Triangles.resize(12, 3);
  box.Triangles << 0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2,
    2, 4, 6, 1, 3, 5, 3, 7, 5;
  return box;
}

double Sinc(double x)
{
  return x == 0.0 ? 1.0 : std::sin(x) / x;
}

Eigen::MatrixXd SomeWaves(Index count, double length)
{
  Eigen::MatrixXd waves(count, 3);
  for (Index k = 0; k < waves.size(); ++k)
  {
    waves.data()[k] = NormalRandom(11, static_cast<std::uint64_t>(k));
  }
  return length * waves.rowwise().normalized();
}

TriangleMesh Moved(TriangleMesh mesh, const SimilarityTransform& t)
{
  mesh.Points =
    (t.Scale * mesh.Points * t.Rotation.transpose()).rowwise() + t.Translation.transpose();
  return mesh;
}

// Every third triangle the other way round.
TriangleMesh Disoriented(TriangleMesh mesh)
{
  for (Index t = 0; t < mesh.NumberOfTriangles(); t += 3)
  {
    std::swap(mesh.Triangles(t, 0), mesh.Triangles(t, 1));
  }
  return mesh;
}

int WeightOf(std::uint32_t word)
{
  int weight = 0;
  for (; word != 0; word &= word - 1)
  {
    ++weight;
  }
  return weight;
}

} // namespace

// A box is a product: its transform is that of three intervals. Its triangles are far larger than
// the waves.
TEST(Solid, TheTransformOfABoxIsAProductOfSincs)
{
  const TriangleMesh box = Box(2.0, 1.0, 0.5);
  Eigen::MatrixXd waves = SomeWaves(20, 15.0);
  waves.row(0) << 7.0, 0.0, 0.0;
  waves.row(1) << 0.0, 2.0 * Pi, 0.0; // a whole wave: 0
  const Eigen::VectorXd spectrum = SolidSpectrum(box, waves, 2);
  for (Index w = 0; w < waves.rows(); ++w)
  {
    const double expected = Sinc(waves(w, 0)) * Sinc(0.5 * waves(w, 1)) * Sinc(0.25 * waves(w, 2));
    EXPECT_NEAR(spectrum[w], expected, 1e-6);
    EXPECT_NEAR(spectrum[waves.rows() + w], 0.0, 1e-6); // even
  }
  EXPECT_EQ(spectrum, SolidSpectrum(box, waves, 1));
}

// Triangles thousands of waves long take no longer than others.
TEST(Solid, TheTransformOfANeedleIsKnownToo)
{
  const double length = 1e5;
  const TriangleMesh needle = Box(length, 1e-3, 2e-3);
  Eigen::MatrixXd waves = SomeWaves(20, 5.0);
  waves.row(0) << 0.0, 5.0, 0.0;
  waves.row(1) << 1e-4, 3.0, 4.0;
  const Eigen::VectorXd spectrum = SolidSpectrum(needle, waves, 1);
  const double volume = length * 1e-3 * 2e-3;
  for (Index w = 0; w < waves.rows(); ++w)
  {
    const double expected = volume * Sinc(0.5 * length * waves(w, 0)) * Sinc(0.5e-3 * waves(w, 1)) *
      Sinc(1e-3 * waves(w, 2));
    EXPECT_NEAR(spectrum[w], expected, 1e-9 * volume);
    EXPECT_NEAR(spectrum[waves.rows() + w], 0.0, 1e-9 * volume);
  }
}

TEST(Solid, TheTransformOfASphereIsKnown)
{
  const TriangleMesh sphere = shapes::Icosphere(5);
  for (const double k : { 1.0, 5.0, 12.0 })
  {
    const double expected = 4.0 * Pi * (std::sin(k) - k * std::cos(k)) / (k * k * k);
    const Eigen::VectorXd spectrum = SolidSpectrum(sphere, SomeWaves(3, k), 2);
    EXPECT_LT((spectrum.head(3).array() - expected).abs().maxCoeff(), 0.005);
    EXPECT_LT(spectrum.tail(3).cwiseAbs().maxCoeff(), 1e-9);
  }
}

TEST(Solid, AFrameGoesWithItsSolid)
{
  const TriangleMesh mesh = shapes::Bumpy(4);
  const TriangleMesh::PointMatrix inFrame = FrameOf(mesh).ToFrame(mesh.Points);
  for (int seed = 0; seed < 20; ++seed)
  {
    const TriangleMesh moved =
      Moved(mesh, RandomSimilarity(mesh, static_cast<std::uint64_t>(seed)));
    const SolidFrame frame = FrameOf(moved);
    EXPECT_LT((frame.ToFrame(moved.Points) - inFrame).cwiseAbs().maxCoeff(), 1e-9);
    const TriangleMesh::PointMatrix changes = TriangleMesh::PointMatrix::Random(5, 3);
    TriangleMesh::PointMatrix shifted = moved.Points.topRows(5);
    shifted += frame.DifferencesFromFrame(changes);
    EXPECT_LT((frame.ToFrame(shifted) - inFrame.topRows(5) - changes).norm(), 1e-9);
  }
}

TEST(Solid, AFrameIsWhatItsMomentsSay)
{
  // Of a box with sides a > b > c: variances a^2 / 12 and so on, and no skewness.
  TriangleMesh box = Box(3.0, 2.0, 1.0);
  box.Points.rowwise() += Eigen::RowVector3d(1e4, -5.0, 7.0);
  const SolidFrame frame = FrameOf(box);
  EXPECT_LT((frame.Origin - Eigen::RowVector3d(1e4, -5.0, 7.0)).norm(), 1e-8);
  EXPECT_NEAR(frame.Scale, std::sqrt(14.0 / 12.0), 1e-10);
  EXPECT_LT((frame.Axes.cwiseAbs() - Eigen::Matrix3d::Identity()).norm(), 1e-9);
  EXPECT_LT(frame.Clearness, 1e-6);
  EXPECT_GT(FrameOf(shapes::Bumpy(4)).Clearness, 1e-3);
}

TEST(Solid, TurnsAreHalfTurns)
{
  const SolidFrame frame = FrameOf(shapes::Bumpy(3));
  EXPECT_EQ(RotatedByPi(frame, 0).Axes, frame.Axes);
  for (int turn = 1; turn < NumberOfTurns; ++turn)
  {
    const Eigen::Matrix3d rotation = RotatedByPi(frame, turn).Axes * frame.Axes.transpose();
    EXPECT_NEAR(rotation(turn - 1, turn - 1), 1.0, 1e-12);
    EXPECT_NEAR(rotation.trace(), -1.0, 1e-12);
  }
}

TEST(Solid, OrientationsAreMended)
{
  const TriangleMesh one = shapes::Bumpy(2);
  const TriangleMesh two = shapes::Union({ one, one }, 5.0);
  const Eigen::MatrixXd waves = SomeWaves(5, 4.0);
  const Eigen::VectorXd expected = SolidSpectrum(two, waves, 1);
  EXPECT_LT((SolidSpectrum(Oriented(Disoriented(two)), waves, 1) - expected).norm(),
    1e-9 * expected.norm());
  TriangleMesh inverted = two;
  inverted.Triangles.col(0).swap(inverted.Triangles.col(1));
  EXPECT_LT((SolidSpectrum(Oriented(inverted), waves, 1) - expected).norm(),
    1e-9 * expected.norm());
}

TEST(Solid, ASheetIsNone)
{
  EXPECT_THROW(FrameOf(shapes::Rectangle(4, 4, 1.0, 1.0)), InvalidInput);
}

TriangleMesh PointsInARow(Index count, const Eigen::RowVector3d& direction)
{
  TriangleMesh row;
  row.Points.resize(count, 3);
  row.Triangles.resize(count - 2, 3);
  for (Index v = 0; v < count; ++v)
  {
    row.Points.row(v) = static_cast<double>(v * v) * direction;
  }
  for (Index t = 0; t < count - 2; ++t)
  {
    row.Triangles.row(t) << t, t + 1, t + 2;
  }
  return row;
}

// The volume of the last is one of rounding.
TEST(Solid, PointsInARowAreNone)
{
  for (Index count = 4; count < 60; ++count)
  {
    EXPECT_FALSE(FrameIfAny(PointsInARow(count, { 3.0, 7.0, 11.0 })).has_value()) << count;
  }
  EXPECT_FALSE(FrameIfAny(Oriented(PointsInARow(6, { 24.0, 1.0, 10.0 }))).has_value());
}

TEST(Solid, VertexAreasAddUp)
{
  const TriangleMesh box = Box(2.0, 1.0, 0.5);
  EXPECT_NEAR(VertexAreas(box).sum(), 2.0 * (2.0 + 1.0 + 0.5), 1e-12);
}

// The weights of its words identify the extended Golay code.
TEST(GolayCode, HasTheWeightsOfTheGolayCode)
{
  std::map<int, int> weights;
  for (std::uint32_t data = 0; data < 4096; ++data)
  {
    EXPECT_EQ(GolayEncode(data) & 0xfffU, data);
    ++weights[WeightOf(GolayEncode(data))];
  }
  const std::map<int, int> expected = { { 0, 1 }, { 8, 759 }, { 12, 2576 }, { 16, 759 },
    { 24, 1 } };
  EXPECT_EQ(weights, expected);
}

// 1 for each 0 of a word, -1 for each 1.
Eigen::RowVectorXf SignsOf(std::uint32_t data)
{
  Eigen::RowVectorXf signs(GolayCodeBits);
  for (int bit = 0; bit < GolayCodeBits; ++bit)
  {
    signs[bit] = (GolayEncode(data) >> bit & 1U) != 0 ? -1.0F : 1.0F;
  }
  return signs;
}

TEST(GolayCode, DecodesToTheWordThatFitsBest)
{
  for (int trial = 0; trial < 40; ++trial)
  {
    const Eigen::RowVectorXf soft = Eigen::RowVectorXf::Random(GolayCodeBits);
    float best = -24.0F;
    for (std::uint32_t data = 0; data < 1U << GolayDataBits; ++data)
    {
      best = std::max(best, soft.dot(SignsOf(data)));
    }
    float fit = 0.0F;
    const std::uint32_t decoded = GolayDecode(soft, fit);
    EXPECT_NEAR(fit, best, 1e-5F);
    EXPECT_NEAR(soft.dot(SignsOf(decoded)), best, 1e-5F);
  }
}

TEST(GolayCode, FitsOfManyAreTheFitsOfEach)
{
  const Eigen::MatrixXf all = Eigen::MatrixXf::Random(7, 2 * GolayCodeBits);
  const Eigen::Map<const Eigen::MatrixXf, 0, Eigen::OuterStride<>> everyOther(all.data(), 7,
    GolayCodeBits, Eigen::OuterStride<>(14));
  const Eigen::VectorXf fits = GolayFits(everyOther);
  for (Index row = 0; row < 7; ++row)
  {
    float fit = 0.0F;
    GolayDecode(everyOther.row(row), fit);
    EXPECT_EQ(fits[row], fit);
  }
}

TEST(GolayCode, MendsThreeWrongBitsAndMoreWhenTheyAreWeak)
{
  for (const std::uint32_t data : { 0U, 1U, 0xabcU, 0xfffU })
  {
    const Eigen::RowVectorXf right = SignsOf(data);
    float score = 0.0F;
    EXPECT_EQ(GolayDecode(right, score), data);
    EXPECT_EQ(score, 24.0F);
    for (Index a = 0; a < right.size(); ++a)
    {
      for (Index b = 0; b < a; ++b)
      {
        for (Index c = 0; c < b; ++c)
        {
          Eigen::RowVectorXf wrong = right;
          wrong[a] *= -1.0F;
          wrong[b] *= -1.0F;
          wrong[c] *= -1.0F;
          ASSERT_EQ(GolayDecode(wrong, score), data);
        }
      }
    }
    Eigen::RowVectorXf weak = right;
    weak.head(6) *= -0.1F; // six wrong, but weakly
    EXPECT_EQ(GolayDecode(weak, score), data);
  }
}

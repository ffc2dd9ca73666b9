// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Attacks/Attacks.h"
#include "Core/Mesh/Measures.h"
#include "Core/Mesh/Orientation.h"
#include "Core/Payload/Bits.h"
#include "Core/Payload/SecretKey.h"
#include "Core/RobustScheme/Capacity.h"
#include "Core/RobustScheme/CarrierSet.h"
#include "Core/RobustScheme/FrameAlignment.h"
#include "Core/RobustScheme/RobustEmbedding.h"
#include "Core/RobustScheme/RobustReader.h"
#include "Core/RobustScheme/SolidFrame.h"
#include "Core/RobustScheme/SolidSpectrum.h"
#include "Core/Support/Errors.h"
#include "Core/Support/Progress.h"
#include "Support/CoreTesting.h"
#include "Support/PValues.h"
#include "Support/Shapes.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

using namespace spectralwatermark;

namespace
{

const std::string Message = "1011001110001011";

// A solid without symmetry and with three different axes.
TriangleMesh Host(int level)
{
  TriangleMesh mesh = shapes::Bumpy(level);
  mesh.Points *= Eigen::Vector3d(1.5, 1.0, 0.7).asDiagonal();
  return mesh;
}

RobustEmbeddingResult Marked(const TriangleMesh& mesh, const SecretKey& key,
  const std::string& message = Message, double distortion = 0.0007)
{
  RobustEmbeddingOptions options;
  options.Message = message;
  options.MaximumDistortion = distortion;
  options.Threads = 2;
  return EmbedRobust(mesh, key, options, Progress());
}

TriangleMesh With(TriangleMesh mesh, const TriangleMesh::PointMatrix& points)
{
  mesh.Points = points;
  return mesh;
}

} // namespace

TEST(SolidWatermark, CarriersAreEvenlySpreadAndHangOnTheKey)
{
  const SecretKey key("one");
  const CarrierSet carriers = CarriersOf(key, 64);
  EXPECT_EQ(carriers.Count(), 168); // 7 words of the code
  EXPECT_EQ(carriers.CheckBits, 20);
  EXPECT_EQ(carriers.Waves.rows(), 84);
  double nearest = 1e9;
  for (Index a = 0; a < carriers.Waves.rows(); ++a)
  {
    EXPECT_GT(carriers.Waves.row(a).norm(), 2.99);
    for (Index b = 0; b < a; ++b)
    {
      nearest = std::min({ nearest, (carriers.Waves.row(a) - carriers.Waves.row(b)).norm(),
        (carriers.Waves.row(a) + carriers.Waves.row(b)).norm() });
    }
  }
  EXPECT_GT(nearest, 2.0);
  EXPECT_GE(carriers.Dither.minCoeff(), 0.0);
  EXPECT_LT(carriers.Dither.maxCoeff(), 1.0);
  EXPECT_EQ(CarriersOf(SecretKey("one"), 64).Waves, carriers.Waves);
  EXPECT_NE(CarriersOf(SecretKey("two"), 64).Waves, carriers.Waves);
  EXPECT_NE(CarriersOf(SecretKey("two"), 64).Dither, carriers.Dither);
  EXPECT_NE(CarriersOf(SecretKey("two"), 64).Whitening, carriers.Whitening);
  EXPECT_THROW(CarriersOf(key, 0), InvalidInput);
  EXPECT_THROW(CarriersOf(key, LargestMessage + 1), InvalidInput);
  EXPECT_EQ(CarriersOf(key, LargestMessage).Count(), 24 * 87);
}

TEST(SolidWatermark, EmbedsWithinItsBudgetAndReadsBackBlind)
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

TEST(SolidWatermark, OnlyItsKeyReadsIt)
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

TEST(SolidWatermark, SurvivesWhatLeavesTheSolid)
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

// What the benchmark's smoothing takes away comes back when it is undone.
TEST(SolidWatermark, UndoesSmoothing)
{
  const SecretKey key("secret");
  const TriangleMesh mesh = Host(4);
  const TriangleMesh marked = With(mesh, Marked(mesh, key).Points);
  for (const int iterations : { 10, 30 })
  {
    const RobustReading reading =
      ReadRobust(With(marked, LaplacianSmoothing(marked, 0.1, iterations, Progress())), key, 16, 2,
        Progress());
    EXPECT_TRUE(reading.IsValid);
    EXPECT_EQ(reading.Message, Message);
    EXPECT_NEAR(reading.Hypothesis.Smoothing, iterations, 5);
  }
}

TEST(SolidWatermark, RefusesWhatDoesNotFit)
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

// What is said to fit is embedded, and two words of the code more are refused.
TEST(SolidWatermark, CapacityIsWhatFits)
{
  const SecretKey key("secret");
  const TriangleMesh mesh = Host(3);
  const double distortion = 2e-5;
  const Index capacity = CapacityOf(mesh, key, distortion, 2, Progress());
  ASSERT_GE(capacity, 16);
  ASSERT_LT(capacity, 200);
  EXPECT_LE(Marked(mesh, key, key.Message(capacity), distortion).Distortion, distortion);
  EXPECT_THROW(Marked(mesh, key, key.Message(capacity + 24), distortion), InvalidInput);
  EXPECT_EQ(CapacityOf(mesh, key, 1e-9, 2, Progress()), 0);
}

// For a mesh without the mark every bit is a fair coin of the key: at one step, with one frame, the
// agreements of many keys are binomial.
TEST(SolidWatermark, BitsOfUnmarkedMeshesAreFairCoins)
{
  constexpr int keys = 400;
  const TriangleMesh mesh = Host(2);
  TriangleMesh inFrame = mesh;
  inFrame.Points = FrameOf(mesh).ToFrame(mesh.Points);
  double agreements = 0.0;
  double squares = 0.0;
  double count = 0.0;
  for (int k = 0; k < keys; ++k)
  {
    const SecretKey key("key " + std::to_string(k));
    const CarrierSet carriers = CarriersOf(key, 4); // 48 carriers
    const std::string code = CodeOf(DataOf("1010", key, carriers.CheckBits));
    const Eigen::VectorXd values = SolidSpectrum(inFrame, carriers.Waves, 1);
    count = static_cast<double>(carriers.Count());
    double agree = 0.0;
    for (Index j = 0; j < carriers.Count(); ++j)
    {
      const auto at = static_cast<std::size_t>(j);
      // Nearest to a point of the lattice for 0 or of the one for 1?
      const double place = values[j] / StepOfNumber(12) - carriers.Dither[j];
      const bool one = std::abs(place - std::round(place)) > 0.25;
      agree += (one != (carriers.Whitening[at] == '1')) == (code[at] == '1') ? 1.0 : 0.0;
    }
    agreements += agree / keys;
    squares += agree * agree / keys;
  }
  EXPECT_NEAR(agreements, 0.5 * count, 5.0 * std::sqrt(0.25 * count / keys));
  const double variance = squares - agreements * agreements;
  EXPECT_NEAR(variance, 0.25 * count, 5.0 * 0.25 * count * std::sqrt(2.0 / keys));
}

// A frame that is a little off, in every way at once, is found again where nothing else is left.
TEST(FrameAlignment, FindsTheFrame)
{
  const SecretKey key("secret");
  const std::string message = key.Message(64);
  const CarrierSet carriers = CarriersOf(key, 64);
  const TriangleMesh mesh = Host(4);
  TriangleMesh marked = With(mesh, Marked(mesh, key, message).Points);
  const double step = StepOfNumber(ReadRobust(marked, key, 64, 2, Progress()).Hypothesis.Step);
  marked.Points = FrameOf(marked).ToFrame(marked.Points);
  const Eigen::VectorXd values = SolidSpectrum(marked, carriers.Waves, 2);
  const Eigen::MatrixXd response = FrameResponse(marked, values, carriers, 2);
  Eigen::VectorXd off(7); // in steps, of the carriers' root mean square
  off << 0.12, -0.06, 0.1, 0.05, -0.1, 0.06, 0.2;
  const Eigen::VectorXd moved = values + step * response * off;
  double fit = 0.0;
  EXPECT_NE(Decode(SoftBits(moved, carriers, step), fit), DataOf(message, key, carriers.CheckBits));
  EXPECT_LT(fit, 0.6);
  const auto& [aligned, cost] = Align(moved, response, carriers, step);
  EXPECT_NEAR(cost, 0.2 * off.squaredNorm(), 0.005);
  EXPECT_LT((aligned - values).cwiseAbs().maxCoeff(), 0.03 * step);
  EXPECT_EQ(Decode(SoftBits(aligned, carriers, step), fit),
    DataOf(message, key, carriers.CheckBits));
  EXPECT_GT(fit, 0.98);
}

// The response is the derivative of what moving, turning and scaling the solid does, each in its
// column, at a size of 1.
TEST(FrameAlignment, ResponseIsTheDerivative)
{
  TriangleMesh mesh = Host(3);
  const CarrierSet carriers = CarriersOf(SecretKey("secret"), 16);
  const Eigen::VectorXd values = SolidSpectrum(mesh, carriers.Waves, 2);
  const Eigen::MatrixXd response = FrameResponse(mesh, values, carriers, 2);
  ASSERT_EQ(response.rows(), carriers.Count());
  ASSERT_EQ(response.cols(), 7);
  const double small = 1e-4;
  const Eigen::Vector3d axes[3] = { Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(),
    Eigen::Vector3d::UnitZ() };
  for (Index freedom = 0; freedom < 7; ++freedom)
  {
    TriangleMesh moved = mesh;
    if (freedom < 3)
    {
      moved.Points.col(freedom).array() += small;
    }
    else if (freedom < 6)
    {
      const Eigen::Matrix3d turn = Eigen::AngleAxisd(small, axes[freedom - 3]).toRotationMatrix();
      moved.Points = mesh.Points * turn.transpose();
    }
    else
    {
      moved.Points *= 1.0 + small;
    }
    const Eigen::VectorXd change = SolidSpectrum(moved, carriers.Waves, 2) - values;
    const double along = std::abs(change.normalized().dot(response.col(freedom).normalized()));
    EXPECT_GT(along, 0.9999) << freedom;
    EXPECT_NEAR(response.col(freedom).squaredNorm(), static_cast<double>(carriers.Count()), 1e-6);
  }
}

namespace
{

std::string Exclusive(std::string a, const std::string& b)
{
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    a[i] = a[i] == b[i] ? '0' : '1';
  }
  return a;
}

// Whose frame is any: the axes of a sphere are rounding, and others have no direction. The plate is closed,
// and all but without volume.
std::vector<TriangleMesh> SymmetricSolids()
{
  TriangleMesh plate = shapes::Cube(3);
  plate.Points *= Eigen::Vector3d(1.0, 1.0, 1e-3).asDiagonal();
  return { shapes::Icosphere(1), shapes::Torus(12, 6), shapes::Cube(4), plate };
}

// Of each mesh. A reading of a mesh without the mark tries everything, and takes a quarter of a second.
int NumberOfKeys()
{
  return std::getenv("SPECTRALWATERMARK_FULL_TESTS") != nullptr ? 80 : 8;
}

} // namespace

// Points in a row: no area, but once they are centred, by rounding, a little of it and a volume.
TEST(SolidReader, ASolidOfRoundingIsReadAsAnyOther)
{
  TriangleMesh row;
  row.Points.resize(12, 3);
  row.Triangles.resize(10, 3);
  for (Index v = 0; v < 12; ++v)
  {
    row.Points.row(v) = static_cast<double>(v * v * v * v) * Eigen::RowVector3d(14.0, 5.0, 17.0);
  }
  for (Index t = 0; t < 10; ++t)
  {
    row.Triangles.row(t) << t, t + 1, t + 2;
  }
  ASSERT_TRUE(FrameIfAny(Oriented(row)).has_value());
  EXPECT_FALSE(ReadRobust(row, SecretKey("owner"), 4, 2, Progress()).IsValid);
}

// Why a keystream makes what an unmarked mesh reads uniform, whatever is tried to read it.
TEST(SolidReader, FlippingTheKeystreamUnderAWordFlipsThatWord)
{
  const SecretKey key("owner");
  const CarrierSet carriers = CarriersOf(key, 4);
  std::vector<TriangleMesh> meshes = SymmetricSolids();
  meshes.push_back(With(Host(2), Marked(Host(2), SecretKey("another"), "1100110011").Points));
  for (std::size_t k = 0; k < meshes.size(); ++k)
  {
    SCOPED_TRACE("mesh " + std::to_string(k));
    const TriangleMesh& mesh = meshes[k];
    const RobustReading reading = ReadCarriers(mesh, carriers, 2, Progress());
    const std::string flips = key.Message(static_cast<Index>(reading.Data.size()));
    CarrierSet flipped = carriers;
    flipped.Whitening = Exclusive(carriers.Whitening, CodeOf(flips));
    const RobustReading other = ReadCarriers(mesh, flipped, 2, Progress());
    EXPECT_EQ(other.Data, Exclusive(reading.Data, flips));
    EXPECT_NEAR(other.Fit, reading.Fit, 1e-6); // sums of floats
    EXPECT_EQ(other.Hypothesis.Step, reading.Hypothesis.Step);
    EXPECT_EQ(other.Values, reading.Values);
  }
}

// What meshes without the mark read under a key is uniform over all data, whatever was tried to read it: of
// the data that the key derives, the bits that agree are binomial, and P(p <= alpha) <= alpha.
TEST(SolidReader, UnmarkedMeshesAgreeBinomially)
{
  constexpr double bits = 24.0; // of data, with a message of 4
  double sum = 0.0;
  double squares = 0.0;
  std::vector<double> pValues;
  std::vector<TriangleMesh> meshes = SymmetricSolids();
  meshes.push_back(Host(1));
  for (const TriangleMesh& mesh : meshes)
  {
    for (int k = 0; k < NumberOfKeys(); ++k)
    {
      const SecretKey key("trial " + std::to_string(pValues.size())); // never twice the same
      const RobustReading reading = ReadRobust(mesh, key, 4, 2, Progress());
      const std::string expected = DataOf(key.Message(4), key, CheckBitsOf(4));
      ASSERT_EQ(static_cast<double>(expected.size()), bits);
      const double off = static_cast<double>(CountAgreements(reading.Data, expected)) - 0.5 * bits;
      sum += off;
      squares += off * off;
      pValues.push_back(PValueOf(reading, expected));
    }
  }
  const auto count = static_cast<double>(pValues.size());
  EXPECT_NEAR(sum, 0.0, 5.0 * std::sqrt(0.25 * bits * count));
  EXPECT_NEAR(squares, 0.25 * bits * count, 5.0 * 0.25 * bits * std::sqrt(2.0 * count));
  pvalues::ExpectValid(pValues);
}

TEST(SolidWatermark, IsTheSameForAnyNumberOfThreads)
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

TEST(SolidWatermark, ProgressRisesAndAbortStops)
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
  last = 0.0;
  CapacityOf(mesh, key, options.MaximumDistortion, 2, rising);
  EXPECT_EQ(last, 1.0);
  const Progress stopping([](double fraction) { return fraction < 0.6; });
  EXPECT_THROW(EmbedRobust(mesh, key, options, stopping), Aborted);
  EXPECT_THROW(CapacityOf(mesh, key, options.MaximumDistortion, 2, stopping), Aborted);
}

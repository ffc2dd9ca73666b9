// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Attacks/Attacks.h"
#include "Core/Mesh/Orientation.h"
#include "Core/Payload/Bits.h"
#include "Core/RobustScheme/CarrierSet.h"
#include "Core/RobustScheme/RobustReader.h"
#include "Core/RobustScheme/SolidFrame.h"
#include "Core/Support/Progress.h"
#include "Support/FullTests.h"
#include "Support/PValues.h"
#include "Support/RobustTesting.h"
#include "Support/Shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

using namespace spectralwatermark;
using namespace robusttesting;

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
  return QuickOrFull(8, 80);
}

} // namespace

// What the benchmark's smoothing takes away comes back when it is undone.
TEST(RobustReader, UndoesSmoothing)
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

// Points in a row: no area, but once they are centred, by rounding, a little of it and a volume.
TEST(RobustReader, ReadsASolidOfRoundingAsAnyOther)
{
  const TriangleMesh row = shapes::PointsInARow(12, 4, { 14.0, 5.0, 17.0 });
  ASSERT_TRUE(FrameIfAny(Oriented(row)).has_value());
  EXPECT_FALSE(ReadRobust(row, SecretKey("owner"), 4, 2, Progress()).IsValid);
}

// Why a keystream makes what an unmarked mesh reads uniform, whatever is tried to read it.
TEST(RobustReader, FlippingTheKeystreamUnderAWordFlipsThatWord)
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
TEST(RobustReader, UnmarkedMeshesAgreeBinomially)
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

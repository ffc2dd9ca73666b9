// SPDX-License-Identifier: BSD-3-Clause
#include "Core/RobustScheme/SolidSpectrum.h"
#include "Support/RobustTesting.h"
#include "Support/Shapes.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace spectralwatermark;
using robusttesting::RandomWaves;

namespace
{

double Sinc(double x)
{
  return x == 0.0 ? 1.0 : std::sin(x) / x;
}

} // namespace

// A box is a product: its transform is that of three intervals. Its triangles are far larger than
// the waves.
TEST(SolidSpectrum, OfABoxIsAProductOfSincs)
{
  const TriangleMesh box = shapes::Box(2.0, 1.0, 0.5);
  Eigen::MatrixXd waves = RandomWaves(20, 15.0);
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
TEST(SolidSpectrum, OfANeedleIsAProductOfSincs)
{
  const double length = 1e5;
  const TriangleMesh needle = shapes::Box(length, 1e-3, 2e-3);
  Eigen::MatrixXd waves = RandomWaves(20, 5.0);
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

TEST(SolidSpectrum, OfASphereIsKnown)
{
  const TriangleMesh sphere = shapes::Icosphere(5);
  for (const double k : { 1.0, 5.0, 12.0 })
  {
    const double expected = 4.0 * Pi * (std::sin(k) - k * std::cos(k)) / (k * k * k);
    const Eigen::VectorXd spectrum = SolidSpectrum(sphere, RandomWaves(3, k), 2);
    EXPECT_LT((spectrum.head(3).array() - expected).abs().maxCoeff(), 0.005);
    EXPECT_LT(spectrum.tail(3).cwiseAbs().maxCoeff(), 1e-9);
  }
}

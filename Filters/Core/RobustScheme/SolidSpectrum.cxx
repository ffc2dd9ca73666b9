// SPDX-License-Identifier: BSD-3-Clause
#include "Core/RobustScheme/SolidSpectrum.h"

#include "Core/Mesh/Measures.h"
#include "Core/Support/Parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numeric>
#include <vector>

namespace spectralwatermark
{

namespace
{

using Eigen::RowVector3d;

// The number of partial sums over the triangles. It is fixed, so that the result does not depend on
// the number of threads.
constexpr Index Parts = 64;

// The largest deviation of the phases at a triangle's corners from their mean at which the integral
// is taken from a series.
constexpr double LargestPhase = 1.0;

// The mean of exp(i x) from a to b.
std::complex<double> MeanBetween(double a, double b)
{
  // Below this, two terms of the series of sin(x) / x are enough: the third is under 1e-18.
  constexpr double small = 1e-4;
  const double half = 0.5 * (b - a);
  const double sinc = half < small ? 1.0 - half * half / 6.0 : std::sin(half) / half;
  return sinc * std::polar(1.0, 0.5 * (a + b));
}

// Half the mean of exp(i x) over a triangle with these phases x at its corners: the second divided
// difference of -exp(i x) at the phases (Hermite and Genocchi). The phases must not all be close to
// each other.
std::complex<double> HalfMeanOfFarPhases(std::array<double, 3> phase)
{
  std::sort(phase.begin(), phase.end());
  const std::complex<double> change =
    MeanBetween(phase[1], phase[2]) - MeanBetween(phase[0], phase[1]);
  return std::complex<double>(0.0, -1.0) * change / (phase[2] - phase[0]);
}

// Half the mean of exp(i k . x) over a triangle. It is exp(i m), where m is the mean of the phases
// at the corners, times a series of complete homogeneous polynomials of the deviations from m; the
// first term left out is under 1e-6 of the whole.
std::complex<double> HalfMean(const RowVector3d& k, const Corners& c)
{
  const std::array<double, 3> phases = { k.dot(c[0]), k.dot(c[1]), k.dot(c[2]) };
  const double mean = (phases[0] + phases[1] + phases[2]) / 3.0;
  double second = 0.0;
  double third = 0.0;
  double fourth = 0.0;
  double largest = 0.0;
  for (const double phase : phases)
  {
    const double p = phase - mean;
    second += p * p;
    third += p * p * p;
    fourth += p * p * p * p;
    largest = std::max(largest, std::abs(p));
  }
  if (largest > LargestPhase)
  {
    return HalfMeanOfFarPhases(phases);
  }
  const std::complex<double> series(
    0.5 - second / 48.0 + (second * second / 8.0 + fourth / 4.0) / 720.0, -third / 360.0);
  return std::polar(1.0, mean) * series;
}

} // namespace

Eigen::VectorXd SolidSpectrum(const TriangleMesh& oriented, const Eigen::MatrixXd& waves,
  int threads)
{
  const Index count = waves.rows();
  const Index triangles = oriented.NumberOfTriangles();
  std::vector<Eigen::VectorXcd> sums(Parts);
  ForEachTask(threads, Parts,
    [&](Index part)
    {
      Eigen::VectorXcd& sum = sums[part];
      sum.setZero(count);
      for (Index t = part * triangles / Parts; t < (part + 1) * triangles / Parts; ++t)
      {
        const Corners corners = CornersOf(oriented, t);
        const RowVector3d twiceArea = AreaVector(oriented, t);
        for (Index w = 0; w < count; ++w)
        {
          const RowVector3d k = waves.row(w);
          sum[w] += k.dot(twiceArea) * HalfMean(k, corners);
        }
      }
    });
  const Eigen::VectorXcd sum = std::accumulate(sums.begin() + 1, sums.end(), sums.front()).eval();
  Eigen::VectorXd spectrum(2 * count);
  for (Index w = 0; w < count; ++w)
  {
    const std::complex<double> value =
      std::complex<double>(0.0, -1.0) * sum[w] / waves.row(w).squaredNorm();
    spectrum[w] = value.real();
    spectrum[count + w] = value.imag();
  }
  return spectrum;
}

} // namespace spectralwatermark

// SPDX-License-Identifier: BSD-3-Clause
#include "Solid.h"

#include "Errors.h"
#include "Parallel.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <map>
#include <numeric>
#include <vector>

namespace spectralwatermark
{

namespace
{

using Eigen::Matrix3d;
using Eigen::RowVector3d;
using Corners = std::array<RowVector3d, 3>;

// Sums over triangles are made in so many parts, whatever the number of threads.
constexpr Index Parts = 64;

// Phases at a triangle's corners may differ from their mean by this where a series is taken.
constexpr double LargestPhase = 1.0;

// A volume under this share of area^1.5 is that of rounding. A sphere's is 0.094.
constexpr double SmallestSolidity = 1e-6;

Corners CornersOf(const TriangleMesh& mesh, Index t)
{
  return { mesh.Points.row(mesh.Triangles(t, 0)), mesh.Points.row(mesh.Triangles(t, 1)),
    mesh.Points.row(mesh.Triangles(t, 2)) };
}

// Of the tetrahedron with the origin.
double Volume(const Corners& c)
{
  return c[0].dot(c[1].cross(c[2])) / 6.0;
}

struct Neighbour
{
  Index Triangle;
  bool TurnedAlike;
};

std::vector<std::vector<Neighbour>> NeighboursAcrossEdges(const TriangleMesh& mesh)
{
  std::vector<std::vector<Neighbour>> neighbours(
    static_cast<std::size_t>(mesh.NumberOfTriangles()));
  for (const auto& [edge, sides] : TrianglesOfEdges(mesh))
  {
    if (sides.size() == 2)
    {
      const bool alike = GoesAlong(mesh, sides[0], edge.first, edge.second) !=
        GoesAlong(mesh, sides[1], edge.first, edge.second);
      neighbours[static_cast<std::size_t>(sides[0])].push_back({ sides[1], alike });
      neighbours[static_cast<std::size_t>(sides[1])].push_back({ sides[0], alike });
    }
  }
  return neighbours;
}

void Turn(TriangleMesh& mesh, Index t)
{
  std::swap(mesh.Triangles(t, 1), mesh.Triangles(t, 2));
}

// Moments of the solid about the origin.
struct Moments
{
  double Volume = 0.0;
  RowVector3d First = RowVector3d::Zero();
  Matrix3d Second = Matrix3d::Zero();
};

Moments MomentsOf(const TriangleMesh& mesh)
{
  Moments moments;
  for (Index t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    const Corners c = CornersOf(mesh, t);
    const double volume = Volume(c);
    const RowVector3d sum = c[0] + c[1] + c[2];
    moments.Volume += volume;
    moments.First += volume / 4.0 * sum;
    moments.Second += volume / 20.0 *
      (sum.transpose() * sum + c[0].transpose() * c[0] + c[1].transpose() * c[1] +
        c[2].transpose() * c[2]);
  }
  return moments;
}

// The integrals of x^3, y^3 and z^3 over the solid: V / 20 times the complete homogeneous
// polynomial of each tetrahedron's corners.
Eigen::Array3d ThirdMoments(const TriangleMesh& mesh)
{
  Eigen::Array3d moments = Eigen::Array3d::Zero();
  for (Index t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    const Corners c = CornersOf(mesh, t);
    const Eigen::Array3d a = c[0].transpose().array();
    const Eigen::Array3d b = c[1].transpose().array();
    const Eigen::Array3d d = c[2].transpose().array();
    const Eigen::Array3d first = a + b + d;
    const Eigen::Array3d second = a.square() + b.square() + d.square();
    const Eigen::Array3d third = a.cube() + b.cube() + d.cube();
    moments += Volume(c) / 20.0 * (first.cube() + 3.0 * first * second + 2.0 * third) / 6.0;
  }
  return moments;
}

// The mean of exp(i x) from a to b.
std::complex<double> MeanBetween(double a, double b)
{
  constexpr double nothing = 1e-4; // the series' next term is under 1e-18
  const double half = 0.5 * (b - a);
  const double sinc = half < nothing ? 1.0 - half * half / 6.0 : std::sin(half) / half;
  return sinc * std::polar(1.0, 0.5 * (a + b));
}

// The same over a triangle, halved: the second divided difference of -exp(i x) at its corners' phases
// (Hermite and Genocchi), which are not all close to each other.
std::complex<double> HalfMeanOfFarPhases(std::array<double, 3> phase)
{
  std::sort(phase.begin(), phase.end());
  const std::complex<double> change =
    MeanBetween(phase[1], phase[2]) - MeanBetween(phase[0], phase[1]);
  return std::complex<double>(0.0, -1.0) * change / (phase[2] - phase[0]);
}

// The mean of exp(i k . x) over a triangle, halved. With phases about their mean m, exp(i m) times the
// series of complete homogeneous polynomials; the term left out is under 1e-6 of the whole.
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

TriangleMesh Oriented(const TriangleMesh& mesh)
{
  TriangleMesh oriented = mesh;
  const std::vector<std::vector<Neighbour>> neighbours = NeighboursAcrossEdges(mesh);
  const RowVector3d centre = mesh.Points.colwise().mean();
  std::vector<signed char> turned(neighbours.size(), -1);
  for (std::size_t seed = 0; seed < turned.size(); ++seed)
  {
    if (turned[seed] >= 0)
    {
      continue;
    }
    turned[seed] = 0;
    std::vector<Index> component = { static_cast<Index>(seed) };
    double volume = 0.0;
    for (std::size_t next = 0; next < component.size(); ++next)
    {
      const Index t = component[next];
      const auto at = static_cast<std::size_t>(t);
      if (turned[at] == 1)
      {
        Turn(oriented, t);
      }
      Corners c = CornersOf(oriented, t);
      volume += Volume({ c[0] - centre, c[1] - centre, c[2] - centre });
      for (const Neighbour& neighbour : neighbours[at])
      {
        signed char& other = turned[static_cast<std::size_t>(neighbour.Triangle)];
        if (other < 0)
        {
          other = neighbour.TurnedAlike ? turned[at] : static_cast<signed char>(1 - turned[at]);
          component.push_back(neighbour.Triangle);
        }
      }
    }
    if (volume < 0.0)
    {
      std::for_each(component.begin(), component.end(), [&](Index t) { Turn(oriented, t); });
    }
  }
  return oriented;
}

TriangleMesh::PointMatrix SolidFrame::ToFrame(const TriangleMesh::PointMatrix& points) const
{
  return (points.rowwise() - this->Origin) * this->Axes.transpose() / this->Scale;
}

TriangleMesh::PointMatrix SolidFrame::DifferencesFromFrame(
  const TriangleMesh::PointMatrix& changes) const
{
  return this->Scale * changes * this->Axes;
}

std::optional<SolidFrame> FrameIfAny(const TriangleMesh& oriented)
{
  // About a point within first: moments about a far origin would cancel.
  const RowVector3d centre = oriented.Points.colwise().mean();
  TriangleMesh mesh = oriented;
  mesh.Points.rowwise() -= centre;
  const Moments moments = MomentsOf(mesh);
  const double area = VertexAreas(mesh).sum();
  if (!(area > 0.0) || !(moments.Volume > SmallestSolidity * std::pow(area, 1.5)))
  {
    return std::nullopt;
  }
  const RowVector3d centroid = moments.First / moments.Volume;
  const Eigen::SelfAdjointEigenSolver<Matrix3d> principal(
    moments.Second / moments.Volume - centroid.transpose() * centroid);
  const Eigen::Vector3d variances = principal.eigenvalues().reverse();
  if (!(variances[2] > 0.0))
  {
    return std::nullopt;
  }
  SolidFrame frame;
  frame.Origin = centre + centroid;
  frame.Axes = principal.eigenvectors().rowwise().reverse().transpose();
  frame.Axes.row(2) *= frame.Axes.determinant() < 0.0 ? -1.0 : 1.0; // a mirrored solid is another
  frame.Scale = std::sqrt(variances.sum());
  mesh.Points = frame.ToFrame(oriented.Points);
  const Eigen::Array3d skewness = ThirdMoments(mesh) /
    (moments.Volume / std::pow(frame.Scale, 3) * (variances.array() / variances.sum()).pow(1.5));
  for (Index axis = 0; axis < 3; ++axis)
  {
    frame.Axes.row(axis) *= skewness[axis] < 0.0 ? -1.0 : 1.0;
  }
  const bool isLeftHanded = frame.Axes.determinant() < 0.0;
  if (isLeftHanded)
  {
    Index unclear = 0;
    skewness.abs().minCoeff(&unclear);
    frame.Axes.row(unclear) *= -1.0;
  }
  std::array<double, 3> clear = { std::abs(skewness[0]), std::abs(skewness[1]),
    std::abs(skewness[2]) };
  std::sort(clear.begin(), clear.end());
  // Which axis gives way must be clear as well.
  frame.Clearness = isLeftHanded ? clear[1] - clear[0] : clear[1];
  return frame;
}

SolidFrame FrameOf(const TriangleMesh& oriented)
{
  const std::optional<SolidFrame> frame = FrameIfAny(oriented);
  if (!frame)
  {
    throw InvalidInput(
      "the surface encloses no volume, or is too open to have an inside, which the "
      "robust scheme needs: close it, or use the scheme PaperSlots");
  }
  return *frame;
}

SolidFrame Turned(const SolidFrame& frame, int turn)
{
  SolidFrame turned = frame;
  for (Index axis = 0; axis < 3; ++axis)
  {
    turned.Axes.row(axis) *= turn == 0 || axis == turn - 1 ? 1.0 : -1.0;
  }
  return turned;
}

Eigen::VectorXd SolidSpectrum(const TriangleMesh& oriented, const Eigen::MatrixXd& waves,
  int threads)
{
  const Index count = waves.rows();
  const Index triangles = oriented.NumberOfTriangles();
  std::vector<Eigen::VectorXcd> sums(Parts);
  ForEachTask(threads, Parts,
    [&](Index part)
    {
      Eigen::VectorXcd& sum = sums[static_cast<std::size_t>(part)];
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

Eigen::VectorXd VertexAreas(const TriangleMesh& mesh)
{
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(mesh.NumberOfVertices());
  for (Index t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    const double third = AreaVector(mesh, t).norm() / 6.0;
    for (int corner = 0; corner < 3; ++corner)
    {
      areas[mesh.Triangles(t, corner)] += third;
    }
  }
  return areas;
}

} // namespace spectralwatermark

// SPDX-License-Identifier: BSD-3-Clause
#include "Noise.h"

#include <cmath>

namespace spectralwatermark
{

namespace
{

// SplitMix64 (Steele, Lea and Flood, "Fast Splittable Pseudorandom Number Generators", 2014):
// its output function turns a counter into well mixed bits.
std::uint64_t Mix(std::uint64_t x)
{
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

// In (0, 1): 53 bits, never 0.
double UniformOfBits(std::uint64_t bits)
{
  return (static_cast<double>(bits >> 11) + 0.5) * 0x1.0p-53;
}

} // namespace

double UniformRandom(std::uint64_t seed, std::uint64_t element)
{
  return UniformOfBits(Mix(Mix(seed) ^ element));
}

// Box-Muller; the standard library's distributions differ between implementations.
double NormalRandom(std::uint64_t seed, std::uint64_t element)
{
  const std::uint64_t first = Mix(Mix(seed) ^ element);
  const double radius = std::sqrt(-2.0 * std::log(UniformOfBits(first)));
  const double angle = 2.0 * 3.14159265358979323846 * UniformOfBits(Mix(first));
  return radius * std::cos(angle);
}

TriangleMesh::PointMatrix NoiseAlongNormals(const TriangleMesh& mesh, double factor,
  std::uint64_t seed)
{
  const double scale = factor * MeanEdgeLength(mesh);
  TriangleMesh::PointMatrix points = mesh.Points;
  const TriangleMesh::PointMatrix normals = VertexNormals(mesh);
  for (Index v = 0; v < points.rows(); ++v)
  {
    points.row(v) += scale * NormalRandom(seed, static_cast<std::uint64_t>(v)) * normals.row(v);
  }
  return points;
}

} // namespace spectralwatermark

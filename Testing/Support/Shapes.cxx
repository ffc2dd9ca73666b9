// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Mesh/TriangleMesh.h"

#include "Support/Shapes.h"

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <map>

namespace shapes
{

namespace
{

using Triangle = std::array<Index, 3>;

TriangleMesh Assemble(const std::vector<Eigen::RowVector3d>& points,
  const std::vector<Triangle>& triangles)
{
  TriangleMesh mesh;
  mesh.Points.resize(static_cast<Index>(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    mesh.Points.row(static_cast<Index>(i)) = points[i];
  }
  mesh.Triangles = spectralwatermark::ToTriangleMatrix(triangles);
  return mesh;
}

} // namespace

TriangleMesh Icosphere(int level, double radius)
{
  const double golden = 0.5 * (1.0 + std::sqrt(5.0));
  std::vector<Eigen::RowVector3d> points;
  for (const double one : { -1.0, 1.0 })
  {
    for (const double g : { -golden, golden })
    {
      points.emplace_back(0.0, one, g);
      points.emplace_back(one, g, 0.0);
      points.emplace_back(g, 0.0, one);
    }
  }
  // Faces: every triple of mutually nearest vertices (distance 2), outward.
  std::vector<Triangle> triangles;
  const auto adjacent = [&points](Index a, Index b)
  {
    return std::abs(
             (points[static_cast<std::size_t>(a)] - points[static_cast<std::size_t>(b)]).norm() -
             2.0) < 1e-9;
  };
  for (Index a = 0; a < 12; ++a)
  {
    for (Index b = a + 1; b < 12; ++b)
    {
      for (Index c = b + 1; c < 12; ++c)
      {
        if (adjacent(a, b) && adjacent(b, c) && adjacent(a, c))
        {
          const auto& p = points[static_cast<std::size_t>(a)];
          const auto& q = points[static_cast<std::size_t>(b)];
          const auto& r = points[static_cast<std::size_t>(c)];
          const bool outward = (q - p).cross(r - p).dot(p) > 0.0;
          triangles.push_back(outward ? Triangle{ a, b, c } : Triangle{ a, c, b });
        }
      }
    }
  }
  for (int step = 0; step < level; ++step)
  {
    std::map<std::pair<Index, Index>, Index> middles;
    const auto middle = [&](Index a, Index b)
    {
      const auto key = std::make_pair(std::min(a, b), std::max(a, b));
      const auto [entry, isNew] = middles.emplace(key, static_cast<Index>(points.size()));
      if (isNew)
      {
        points.push_back(points[static_cast<std::size_t>(a)].normalized() +
          points[static_cast<std::size_t>(b)].normalized());
      }
      return entry->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : triangles)
    {
      const Index ab = middle(a, b);
      const Index bc = middle(b, c);
      const Index ca = middle(c, a);
      finer.insert(finer.end(), { { a, ab, ca }, { ab, b, bc }, { ca, bc, c }, { ab, bc, ca } });
    }
    triangles.swap(finer);
  }
  for (auto& point : points)
  {
    point = radius * point.normalized();
  }
  return Assemble(points, triangles);
}

TriangleMesh Rectangle(Index nx, Index ny, double a, double b)
{
  std::vector<Eigen::RowVector3d> points;
  std::vector<Triangle> triangles;
  for (Index j = 0; j <= ny; ++j)
  {
    for (Index i = 0; i <= nx; ++i)
    {
      points.emplace_back(a * static_cast<double>(i) / static_cast<double>(nx),
        b * static_cast<double>(j) / static_cast<double>(ny), 0.0);
    }
  }
  for (Index j = 0; j < ny; ++j)
  {
    for (Index i = 0; i < nx; ++i)
    {
      const Index corner = j * (nx + 1) + i;
      const Index above = corner + nx + 1;
      triangles.push_back({ corner, corner + 1, above + 1 });
      triangles.push_back({ corner, above + 1, above });
    }
  }
  return Assemble(points, triangles);
}

TriangleMesh Torus(Index around, Index across)
{
  constexpr double twoPi = 6.28318530717958647693;
  std::vector<Eigen::RowVector3d> points;
  std::vector<Triangle> triangles;
  for (Index i = 0; i < around; ++i)
  {
    for (Index j = 0; j < across; ++j)
    {
      const double big = twoPi * static_cast<double>(i) / static_cast<double>(around);
      const double small = twoPi * static_cast<double>(j) / static_cast<double>(across);
      const double radius = 1.0 + 0.4 * std::cos(small);
      points.emplace_back(radius * std::cos(big), radius * std::sin(big), 0.4 * std::sin(small));
      const Index next = (i + 1) % around * across;
      const Index here = i * across;
      const Index above = (j + 1) % across;
      triangles.push_back({ here + j, next + j, next + above });
      triangles.push_back({ here + j, next + above, here + above });
    }
  }
  return Assemble(points, triangles);
}

TriangleMesh Cube(Index steps)
{
  std::vector<Eigen::RowVector3d> points;
  std::vector<Triangle> triangles;
  std::map<std::array<Index, 3>, Index> numbers;
  const auto vertex = [&](const std::array<Index, 3>& place)
  {
    const auto [known, isNew] = numbers.emplace(place, static_cast<Index>(points.size()));
    if (isNew)
    {
      points.emplace_back(
        Eigen::Map<const Eigen::Matrix<Index, 1, 3>>(place.data()).cast<double>() /
        static_cast<double>(steps));
    }
    return known->second;
  };
  for (std::size_t side = 0; side < 6; ++side)
  {
    const bool isFar = side >= 3;
    const auto at = [&](Index u, Index v)
    {
      std::array<Index, 3> place{};
      place[side % 3] = isFar ? steps : 0;
      place[(side + 1) % 3] = isFar ? u : v; // outwards
      place[(side + 2) % 3] = isFar ? v : u;
      return vertex(place);
    };
    for (Index u = 0; u < steps; ++u)
    {
      for (Index v = 0; v < steps; ++v)
      {
        triangles.push_back({ at(u, v), at(u + 1, v), at(u + 1, v + 1) });
        triangles.push_back({ at(u, v), at(u + 1, v + 1), at(u, v + 1) });
      }
    }
  }
  return Assemble(points, triangles);
}

TriangleMesh SquaresOnABall(Index steps)
{
  TriangleMesh ball = Cube(steps);
  for (Index v = 0; v < ball.NumberOfVertices(); ++v)
  {
    const Eigen::RowVector3d fromCentre = ball.Points.row(v).array() - 0.5;
    const Eigen::RowVector3d p = fromCentre.normalized();
    const double height = 1.0 + 0.2 * p[0] * p[1] + 0.15 * std::pow(p[2], 3) + 0.1 * p[0];
    ball.Points.row(v) << height * p[0], 0.8 * height * p[1], 0.6 * height * p[2];
  }
  return ball;
}

TriangleMesh Bumpy(int level)
{
  TriangleMesh mesh = Icosphere(level);
  for (Index v = 0; v < mesh.NumberOfVertices(); ++v)
  {
    const Eigen::RowVector3d p = mesh.Points.row(v);
    const double bump = 0.15 * std::sin(3.1 * p.x() + 0.7) + 0.1 * std::sin(5.3 * p.y() - 1.1) +
      0.08 * std::cos(7.7 * p.z() + 2.3 * p.x()) +
      0.04 * std::sin(11.0 * p.x() * p.y() + 13.0 * p.z());
    mesh.Points.row(v) = (1.0 + bump) * p.cwiseProduct(Eigen::RowVector3d(1.0, 1.2, 0.85));
  }
  return mesh;
}

TriangleMesh Union(const std::vector<TriangleMesh>& parts, double offset)
{
  std::vector<Eigen::RowVector3d> points;
  std::vector<Triangle> triangles;
  for (std::size_t k = 0; k < parts.size(); ++k)
  {
    const Index first = static_cast<Index>(points.size());
    const Eigen::RowVector3d move(offset * static_cast<double>(k), 0.0, 0.0);
    for (Index v = 0; v < parts[k].NumberOfVertices(); ++v)
    {
      points.emplace_back(parts[k].Points.row(v) + move);
    }
    for (Index t = 0; t < parts[k].NumberOfTriangles(); ++t)
    {
      const auto corners = parts[k].Triangles.row(t);
      triangles.push_back({ first + corners[0], first + corners[1], first + corners[2] });
    }
  }
  return Assemble(points, triangles);
}

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

TriangleMesh PointsInARow(Index count, int power, const Eigen::RowVector3d& direction)
{
  TriangleMesh row;
  row.Points.resize(count, 3);
  row.Triangles.resize(count - 2, 3);
  for (Index v = 0; v < count; ++v)
  {
    row.Points.row(v) = std::pow(static_cast<double>(v), power) * direction;
  }
  for (Index t = 0; t < count - 2; ++t)
  {
    row.Triangles.row(t) << t, t + 1, t + 2;
  }
  return row;
}

TriangleMesh WithTriangles(TriangleMesh mesh, const std::vector<Eigen::RowVector3d>& points,
  const std::vector<std::vector<Index>>& triangles)
{
  const Index firstPoint = mesh.NumberOfVertices();
  mesh.Points.conservativeResize(firstPoint + static_cast<Index>(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    mesh.Points.row(firstPoint + static_cast<Index>(i)) = points[i];
  }
  const Index firstTriangle = mesh.NumberOfTriangles();
  mesh.Triangles.conservativeResize(firstTriangle + static_cast<Index>(triangles.size()), 3);
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      mesh.Triangles(firstTriangle + static_cast<Index>(t), corner) =
        triangles[t][static_cast<std::size_t>(corner)];
    }
  }
  return mesh;
}

} // namespace shapes

// SPDX-License-Identifier: BSD-3-Clause
#include "Core/RobustScheme/CarrierSet.h"
#include "Core/RobustScheme/FrameAlignment.h"
#include "Core/RobustScheme/RobustReader.h"
#include "Core/RobustScheme/SolidFrame.h"
#include "Core/RobustScheme/SolidSpectrum.h"
#include "Core/Support/Progress.h"
#include "Support/RobustTesting.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

using namespace spectralwatermark;
using namespace robusttesting;

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

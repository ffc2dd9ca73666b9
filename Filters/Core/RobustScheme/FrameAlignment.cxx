// SPDX-License-Identifier: BSD-3-Clause
#include "Core/RobustScheme/FrameAlignment.h"

#include "Core/Payload/GolayCode.h"
#include "Core/RobustScheme/SolidSpectrum.h"

#include <Eigen/Cholesky>

#include <array>
#include <cmath>

namespace spectralwatermark
{

namespace
{

using Eigen::MatrixXd;
using Eigen::MatrixXf;
using Eigen::VectorXd;

// The degrees of freedom of a frame: three translations, three rotations and the scale.
constexpr Index Freedoms = 7;

// The rotation (in radians) and the relative scaling from which finite differences give the
// response of the carriers to the frame.
constexpr double SmallChange = 1e-5;

// The moves that the pattern search tries along each degree of freedom, in steps of the lattice.
constexpr std::array<double, 3> Moves = { 0.1, 0.2, 0.4 };

// The factor on the moves below which the pattern search ends. It begins with 1 and is halved each
// time no move helps.
constexpr double SmallestScale = 0.25;

// The largest number of rounds of the pattern search.
constexpr int MostMoves = 16;

// The smallest gain in fit that counts as progress; less is rounding error.
constexpr double LeastGain = 1e-5;

// The cost of a change of the frame, in fit per squared step. Attacks change the frame by a few
// tenths of a step.
constexpr double Reluctance = 0.2;

// The regularisation of the changes in the least-squares problem, per carrier.
constexpr double Regularization = 1e-4;

// The distance from its lattice point, in steps, beyond which a carrier has little weight in the
// least-squares problem.
constexpr double Doubtful = 0.25;

// The number of least-squares problems solved one after another.
constexpr int Refinements = 5;

// The soft bits of code word b, a row per candidate: every `blocks`-th column of `soft` from b on.
auto WordOf(const MatrixXf& soft, Index b)
{
  const Index blocks = soft.cols() / GolayCodeBits;
  return Eigen::Map<const MatrixXf, 0, Eigen::OuterStride<>>(soft.data() + b * soft.rows(),
    soft.rows(), GolayCodeBits, Eigen::OuterStride<>(blocks * soft.rows()));
}

// How well each row fits the code, from 0 to 1.
VectorXd Fits(const MatrixXf& soft)
{
  VectorXd fits = VectorXd::Zero(soft.rows());
  for (Index b = 0; b < soft.cols() / GolayCodeBits; ++b)
  {
    fits += GolayFits(WordOf(soft, b)).cast<double>();
  }
  return fits / static_cast<double>(soft.cols());
}

// The factor by which the whitening multiplies the soft bit of each carrier.
VectorXd Signs(const CarrierSet& carriers)
{
  VectorXd signs(carriers.Count());
  for (Index j = 0; j < signs.size(); ++j)
  {
    signs[j] = carriers.Whitening[j] == '1' ? -1.0 : 1.0;
  }
  return signs;
}

// Searches for the change of the frame, in steps, that fits the code best.
class PatternSearch
{
public:
  // `places` are the carrier values in steps, relative to a lattice point for a 0.
  PatternSearch(const VectorXd& places, const MatrixXd& response, const VectorXd& signs)
    : Places(places)
    , Response(response)
    , Sign(signs)
  {
  }

  VectorXd Run() const
  {
    VectorXd change = VectorXd::Zero(Freedoms);
    double best = this->FitsOf(change.transpose())[0];
    double scale = 1.0;
    for (int move = 0; move < MostMoves && scale >= SmallestScale; ++move)
    {
      const MatrixXd candidates = MovesFrom(change, scale);
      Index found = 0;
      const double fit = this->FitsOf(candidates).maxCoeff(&found);
      if (fit > best + LeastGain)
      {
        best = fit;
        change = candidates.row(found);
      }
      else
      {
        scale *= 0.5;
      }
    }
    return change;
  }

private:
  static MatrixXd MovesFrom(const VectorXd& change, double scale)
  {
    MatrixXd candidates =
      change.transpose().replicate(2 * Freedoms * static_cast<Index>(Moves.size()), 1);
    Index row = 0;
    for (const double size : Moves)
    {
      for (Index freedom = 0; freedom < Freedoms; ++freedom)
      {
        candidates(row++, freedom) += scale * size;
        candidates(row++, freedom) -= scale * size;
      }
    }
    return candidates;
  }

  // The fit after each change (a row each), less its cost.
  VectorXd FitsOf(const MatrixXd& changes) const
  {
    const MatrixXd places =
      this->Places.transpose().replicate(changes.rows(), 1) - changes * this->Response.transpose();
    const MatrixXd soft = (2.0 * Pi * places.array()).cos().matrix() * this->Sign.asDiagonal();
    return Fits(soft.cast<float>()) - Reluctance * changes.rowwise().squaredNorm();
  }

  const VectorXd& Places;
  const MatrixXd& Response;
  const VectorXd& Sign;
};

// The offset of each place from the nearest lattice point that holds the decided code bit, in
// steps.
VectorXd Misses(const VectorXd& places, const std::string& code, const CarrierSet& carriers)
{
  VectorXd misses(places.size());
  for (Index j = 0; j < places.size(); ++j)
  {
    const double offset = code[j] != carriers.Whitening[j] ? 0.5 : 0.0;
    misses[j] = places[j] - offset - std::round(places[j] - offset);
  }
  return misses;
}

} // namespace

VectorXd SoftBits(const VectorXd& values, const CarrierSet& carriers, double step)
{
  return (2.0 * Pi * (values / step - carriers.Dither).array()).cos() * Signs(carriers).array();
}

std::string Decode(const VectorXd& soft, double& fit)
{
  const MatrixXf row = soft.transpose().cast<float>();
  std::string data;
  fit = 0.0;
  for (Index b = 0; b < soft.size() / GolayCodeBits; ++b)
  {
    float fitOfWord = 0.0F;
    const std::uint32_t word = GolayDecode(WordOf(row, b), fitOfWord);
    fit += static_cast<double>(fitOfWord) / static_cast<double>(soft.size());
    for (int bit = 0; bit < GolayDataBits; ++bit)
    {
      data += (word >> bit & 1U) != 0 ? '1' : '0';
    }
  }
  return data;
}

MatrixXd FrameResponse(const TriangleMesh& inFrame, const VectorXd& values,
  const CarrierSet& carriers, int threads)
{
  const Index waves = carriers.Waves.rows();
  MatrixXd response(values.size(), Freedoms);
  const auto respond = [&](Index freedom, const TriangleMesh::PointMatrix& direction)
  {
    TriangleMesh moved = inFrame;
    moved.Points += SmallChange * direction;
    response.col(freedom) = SolidSpectrum(moved, carriers.Waves, threads) - values;
  };
  for (Index axis = 0; axis < 3; ++axis)
  {
    // A translation by d multiplies the transform by exp(i k . d).
    response.col(axis).head(waves) = -carriers.Waves.col(axis).cwiseProduct(values.tail(waves));
    response.col(axis).tail(waves) = carriers.Waves.col(axis).cwiseProduct(values.head(waves));
    TriangleMesh::PointMatrix around = TriangleMesh::PointMatrix::Zero(inFrame.Points.rows(), 3);
    around.col((axis + 1) % 3) = inFrame.Points.col((axis + 2) % 3);
    around.col((axis + 2) % 3) = -inFrame.Points.col((axis + 1) % 3);
    respond(3 + axis, around);
  }
  respond(6, inFrame.Points);
  for (Index freedom = 0; freedom < Freedoms; ++freedom)
  {
    const double size =
      response.col(freedom).norm() / std::sqrt(static_cast<double>(values.size()));
    // A column may be zero: a rotation does not change a ball.
    response.col(freedom) /= size > 0.0 ? size : 1.0;
  }
  return response;
}

Alignment Align(const VectorXd& values, const MatrixXd& response, const CarrierSet& carriers,
  double step)
{
  const VectorXd signs = Signs(carriers);
  const VectorXd places = values / step - carriers.Dither;
  VectorXd change = PatternSearch(places, response, signs).Run();
  for (int k = 0; k < Refinements; ++k)
  {
    const VectorXd now = places - response * change;
    double fit = 0.0;
    const VectorXd soft = (2.0 * Pi * now.array()).cos() * signs.array();
    const VectorXd misses = Misses(now, CodeOf(Decode(soft, fit)), carriers);
    const VectorXd trust = (-(misses / Doubtful).array().square()).exp();
    MatrixXd normal = response.transpose() * trust.asDiagonal() * response;
    normal.diagonal().array() += Regularization * static_cast<double>(values.size());
    change +=
      Eigen::LDLT<MatrixXd>(normal).solve(response.transpose() * trust.cwiseProduct(misses));
  }
  return { values - step * response * change, Reluctance * change.squaredNorm() };
}

} // namespace spectralwatermark

// SPDX-License-Identifier: BSD-3-Clause
#include "SolidWatermark.h"

#include "Distortion.h"
#include "Errors.h"
#include "GolayCode.h"
#include "Parallel.h"
#include "SlotWatermark.h"
#include "Solid.h"
#include "SolidReader.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <optional>
#include <sstream>
#include <utility>

namespace spectralwatermark
{

namespace
{

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double Pi = 3.14159265358979323846;

// A random message passes this many bits of check once in a million.
constexpr Index LeastCheckBits = 20;

// Wave vectors fill a shell evenly. Under its inner radius the solid itself is large in the
// transform, and what moves or turns the frame a little changes much; waves nearer to each other
// than these volumes are too much alike on the surface.
constexpr double InnerRadius = 3.0;
constexpr double VolumePerWave = 220.0;
constexpr Index CandidatesPerWave = 64;

constexpr double SmallestStep = 2.5e-4;
constexpr double StepRatio = 1.0905077326652577; // 2^(1/8)

// Of a carrier, in steps: embedded well enough.
constexpr double GoodError = 0.005;
constexpr int MostRounds = 12;
constexpr int MostAttempts = 4;

// Rounds reuse the response of the original mesh, which is most of the work, as long as each leaves
// no more of the error than this.
constexpr double SlowRound = 0.2;

// Parts of the budget that the plan may use: what is measured differs a little.
constexpr double PlannedPart = 0.97;

// And for a message that is not known yet: what it costs depends on its bits by some percent.
constexpr double SafePart = 0.9;

// Of the waves' Gram matrix, relative to the largest: less is rounding.
constexpr double SmallestPivot = 1e-10;

// Rows of the moments that must not move, see FixedMoments().
constexpr Index Moments = 13;

Index BlocksOf(Index messageBits)
{
  return (messageBits + LeastCheckBits + GolayDataBits - 1) / GolayDataBits;
}

// Best-candidate sampling (Mitchell, 1991): each wave is the candidate farthest from all before, a
// vector and its opposite being the same wave.
MatrixXd EvenWaves(const std::vector<double>& numbers, Index count)
{
  const double inner = std::pow(InnerRadius, 3);
  const double shell = VolumePerWave * static_cast<double>(count) * 3.0 / (4.0 * Pi);
  MatrixXd waves(count, 3);
  auto number = numbers.begin();
  for (Index w = 0; w < count; ++w)
  {
    double farthest = -1.0;
    for (Index candidate = 0; candidate < CandidatesPerWave; ++candidate)
    {
      const double radius = std::cbrt(inner + shell * *number++);
      const double height = 2.0 * *number++ - 1.0;
      const double angle = 2.0 * Pi * *number++;
      const double around = std::sqrt(1.0 - height * height);
      const Eigen::RowVector3d wave =
        radius * Eigen::RowVector3d(around * std::cos(angle), around * std::sin(angle), height);
      double nearest = 4.0 * wave.squaredNorm(); // its own opposite
      for (Index other = 0; other < w; ++other)
      {
        nearest = std::min({ nearest, (waves.row(other) - wave).squaredNorm(),
          (waves.row(other) + wave).squaredNorm() });
      }
      if (nearest > farthest)
      {
        farthest = nearest;
        waves.row(w) = wave;
      }
    }
  }
  return waves;
}

// Values that a carrier with this bit may have are Offset + step * integer.
VectorXd Offsets(const std::string& code, const Carriers& carriers, double step)
{
  VectorXd offsets(carriers.Count());
  for (Index j = 0; j < carriers.Count(); ++j)
  {
    const auto at = static_cast<std::size_t>(j);
    const bool bit = code[at] != carriers.Whitening[at];
    offsets[j] = step * ((bit ? 0.5 : 0.0) + carriers.Dither[j]);
  }
  return offsets;
}

// The volume, its centre, and the second and third moments that the frame is made from: a
// displacement along the normals that is orthogonal to these functions leaves them as they are.
MatrixXd FixedMoments(const TriangleMesh::PointMatrix& points)
{
  MatrixXd rows(points.rows(), Moments);
  const auto x = points.col(0).array();
  const auto y = points.col(1).array();
  const auto z = points.col(2).array();
  rows.col(0).setOnes();
  rows.middleCols<3>(1) = points;
  rows.col(4) = x.square();
  rows.col(5) = y.square();
  rows.col(6) = z.square();
  rows.col(7) = x * y;
  rows.col(8) = y * z;
  rows.col(9) = z * x;
  rows.col(10) = x.cube();
  rows.col(11) = y.cube();
  rows.col(12) = z.cube();
  return rows;
}

// The solid as the carriers see it.
struct View
{
  View(const TriangleMesh& oriented, const SolidFrame& frame)
    : Frame(frame)
    , Mesh(oriented)
  {
    this->Mesh.Points = frame.ToFrame(oriented.Points);
  }
  explicit View(const TriangleMesh& oriented)
    : View(oriented, FrameOf(oriented))
  {
  }

  SolidFrame Frame;
  TriangleMesh Mesh; // in the frame
};

// The lower triangle of patterns^T diag(weights) patterns; what is above it is not set.
MatrixXd LowerGram(const VectorXd& weights, const MatrixXd& patterns, int threads)
{
  constexpr Index columns = 32; // of a task: the sums are the same on any number of threads
  const Index size = patterns.cols();
  MatrixXd gram(size, size);
  ForEachTask(threads, (size + columns - 1) / columns,
    [&](Index task)
    {
      const Index first = task * columns;
      const Index count = std::min(columns, size - first);
      gram.block(first, first, size - first, count).noalias() =
        patterns.rightCols(size - first).transpose() *
        (weights.asDiagonal() * patterns.middleCols(first, count)).eval();
    });
  return gram;
}

// Displacements along the normals that change the carriers, to first order, by what is asked for and
// the moments not at all: the smallest ones in mean square over the surface.
class Response
{
public:
  Response(const View& view, const Carriers& carriers, int threads)
    : Areas(VertexAreas(view.Mesh))
    , Patterns(view.Mesh.NumberOfVertices(), carriers.Count() + Moments)
  {
    const Index waves = carriers.Waves.rows();
    const MatrixXd phases = view.Mesh.Points * carriers.Waves.transpose();
    this->Patterns.leftCols(waves) = phases.array().cos();
    this->Patterns.middleCols(waves, waves) = phases.array().sin();
    this->Patterns.rightCols<Moments>() = FixedMoments(view.Mesh.Points);
    const Eigen::LDLT<MatrixXd> factors(LowerGram(this->Areas, this->Patterns, threads));
    const VectorXd pivots = factors.vectorD();
    if (!(pivots.minCoeff() > SmallestPivot * pivots.maxCoeff()))
    {
      throw InvalidInput("the mesh is too small or too simple for so many bits: " +
        std::to_string(carriers.Count()) + " waves cannot be told apart on it. Embed fewer bits");
    }
    this->Inverse = factors.solve(MatrixXd::Identity(this->Patterns.cols(), this->Patterns.cols()));
    this->Inverse = (0.5 * (this->Inverse + this->Inverse.transpose())).eval();
  }

  VectorXd Displacements(const VectorXd& changes) const
  {
    return this->Patterns * (this->Inverse.leftCols(changes.size()) * changes);
  }

  // Of the carriers' changes: the square of the displacements' root mean square is r^T Cost r.
  MatrixXd Cost(Index carriers) const
  {
    return this->Inverse.topLeftCorner(carriers, carriers) / this->Areas.sum();
  }

private:
  VectorXd Areas;
  MatrixXd Patterns; // a column for each carrier and moment
  MatrixXd Inverse;  // of their Gram matrix
};

// Other points of the lattice than the nearest may cost less together: one step at a time, as long
// as that helps. `changes` are the carriers' changes.
void CheapenChanges(const MatrixXd& cost, double step, VectorXd& changes)
{
  constexpr int most = 2000;
  VectorXd gradient = cost * changes;
  for (int move = 0; move < most; ++move)
  {
    Index carrier = -1;
    double direction = 0.0;
    double gain = -1e-9 * changes.dot(gradient);
    for (Index j = 0; j < changes.size(); ++j)
    {
      const double sign = gradient[j] > 0.0 ? -1.0 : 1.0;
      const double change = 2.0 * sign * step * gradient[j] + step * step * cost(j, j);
      if (change < gain)
      {
        gain = change;
        carrier = j;
        direction = sign;
      }
    }
    if (carrier < 0)
    {
      return;
    }
    changes[carrier] += direction * step;
    gradient += direction * step * cost.col(carrier);
  }
}

// What it takes to embed with some step.
struct Plan
{
  int Step = -1;
  VectorXd Targets;
  double Distortion = 0.0; // root mean square, in the frame's scale
};

Plan PlanWithStep(int number, const VectorXd& values, const std::string& code,
  const Carriers& carriers, const MatrixXd& cost)
{
  const double step = StepOfNumber(number);
  const VectorXd offsets = Offsets(code, carriers, step);
  VectorXd changes = offsets + step * ((values - offsets) / step).array().round().matrix() - values;
  CheapenChanges(cost, step, changes);
  return { number, values + changes, std::sqrt(std::max(0.0, changes.dot(cost * changes))) };
}

double RootMeanSquare(const TriangleMesh& mesh, const TriangleMesh::PointMatrix& moved)
{
  const VectorXd areas = VertexAreas(mesh);
  return std::sqrt(areas.dot((moved - mesh.Points).rowwise().squaredNorm()) / areas.sum());
}

TriangleMesh::PointMatrix Stored(const TriangleMesh::PointMatrix& points, bool asFloat)
{
  return asFloat ? TriangleMesh::PointMatrix(points.cast<float>().cast<double>()) : points;
}

// What the plans of an embedding are made from.
struct Payload
{
  Payload(const View& view, const SecretKey& key, Index bits, int threads)
    : Carrier(CarriersOf(key, bits))
    , Values(SolidSpectrum(view.Mesh, this->Carrier.Waves, threads))
    , Responding(view, this->Carrier, threads)
    , Cost(this->Responding.Cost(this->Carrier.Count()))
  {
  }

  Carriers Carrier;
  VectorXd Values;
  Response Responding;
  MatrixXd Cost;
};

// The largest step that the budget allows.
Plan LargestAffordable(const Payload& payload, const std::string& code, double budget)
{
  Plan plan;
  for (int number = NumberOfSteps - 1; number >= 0; --number)
  {
    plan = PlanWithStep(number, payload.Values, code, payload.Carrier, payload.Cost);
    if (plan.Distortion <= budget)
    {
      return plan;
    }
  }
  plan.Step = -1;
  return plan;
}

// Moves the points until the carriers are at their targets.
class Embedding
{
public:
  Embedding(const TriangleMesh& oriented, const Payload& payload, int threads)
    : Original(oriented)
    , Content(payload)
    , Threads(threads)
    , Diagonal(BoundingBoxDiagonal(oriented.Points))
  {
  }

  SolidEmbeddingResult Run(const Plan& plan, const SolidEmbeddingOptions& options,
    const Progress& progress) const;

private:
  VectorXd Spectrum(const View& view) const
  {
    return SolidSpectrum(view.Mesh, this->Content.Carrier.Waves, this->Threads);
  }

  const TriangleMesh& Original;
  const Payload& Content;
  int Threads;
  double Diagonal;
};

SolidEmbeddingResult Embedding::Run(const Plan& plan, const SolidEmbeddingOptions& options,
  const Progress& progress) const
{
  SolidEmbeddingResult result;
  result.Step = StepOfNumber(plan.Step);
  TriangleMesh mesh = this->Original;
  std::optional<Response> fresh; // where the mesh is by now, once the original's serves no more
  double lastError = std::numeric_limits<double>::infinity();
  for (int round = 0; round <= MostRounds; ++round)
  {
    const View view(mesh);
    const VectorXd changes =
      plan.Targets - (round == 0 ? this->Content.Values : this->Spectrum(view));
    const double error = changes.cwiseAbs().maxCoeff() / result.Step;
    result.Rounds.push_back(
      { RootMeanSquare(this->Original, mesh.Points) / this->Diagonal, error });
    progress.Report(static_cast<double>(round + 1) / (MostRounds + 1));
    const bool diverges = !(error <= lastError);
    if (error < GoodError || diverges || round == MostRounds)
    {
      break;
    }
    if (round > 0 && error > SlowRound * lastError)
    {
      fresh.reset(); // large: not two of them
      fresh.emplace(view, this->Content.Carrier, this->Threads);
    }
    lastError = error;
    const Response& response = fresh ? *fresh : this->Content.Responding;
    const VectorXd heights = response.Displacements(changes);
    mesh.Points += view.Frame.DifferencesFromFrame(heights.asDiagonal() * VertexNormals(view.Mesh));
  }
  result.Points = Stored(mesh.Points, options.RoundToFloat);
  mesh.Points = result.Points;
  result.Distortion = RootMeanSquare(this->Original, result.Points) / this->Diagonal;
  const double worst =
    (this->Spectrum(View(mesh)) - plan.Targets).cwiseAbs().maxCoeff() / result.Step;
  result.Margin = std::max(0.0, 1.0 - 4.0 * worst);
  return result;
}

// Of a message with its check, that fills so many words of the code; 0 when the check alone does.
Index MessageBitsOf(Index words)
{
  return std::clamp<Index>(words * GolayDataBits - LeastCheckBits, 0, LargestMessage);
}

// Which messages fit a mesh and a budget, by embedding one with the smallest step.
class Capacity
{
public:
  Capacity(const TriangleMesh& oriented, const SecretKey& key, double maximumDistortion,
    int threads)
    : Mesh(oriented)
    , Key(key)
    , MaximumDistortion(maximumDistortion)
    , Threads(threads)
    , Seen(oriented)
  {
  }

  // The most words that fit, under `tooMany`. Each look takes longer than all that ask for less:
  // twice as many every time, and halves only from where it was too many.
  Index MostWords(Index tooMany, const Progress& progress) const
  {
    Index most = BlocksOf(1) - 1;
    double begin = 0.0;
    while (tooMany - most > 1)
    {
      const Index words = std::min(2 * most, (most + tooMany) / 2);
      const double end = begin + (1.0 - begin) / 4.0; // how many looks there will be is open
      (this->Fits(words, progress.Part(begin, end)) ? most : tooMany) = words;
      begin = end;
    }
    return most;
  }

private:
  bool Fits(Index words, const Progress& progress) const
  {
    const Index carriers = words * GolayCodeBits;
    if (carriers + Moments >= this->Mesh.NumberOfVertices())
    {
      return false;
    }
    try
    {
      const Payload payload(this->Seen, this->Key, MessageBitsOf(words), this->Threads);
      progress.Report(0.3);
      const std::string code(static_cast<std::size_t>(carriers), '0'); // as good as any, whitened
      const Plan plan = PlanWithStep(0, payload.Values, code, payload.Carrier, payload.Cost);
      const double scale = this->Seen.Frame.Scale / BoundingBoxDiagonal(this->Mesh.Points);
      return plan.Distortion * scale <= this->MaximumDistortion &&
        Embedding(this->Mesh, payload, this->Threads)
          .Run(plan, SolidEmbeddingOptions(), progress.Part(0.3, 1.0))
          .Distortion <= SafePart * this->MaximumDistortion;
    }
    catch (const InvalidInput&)
    {
      return false; // waves that cannot be told apart
    }
  }

  const TriangleMesh& Mesh;
  const SecretKey& Key;
  double MaximumDistortion;
  int Threads;
  View Seen;
};

std::string Percent(double part)
{
  std::ostringstream text;
  text << std::setprecision(3) << 100.0 * part << " %";
  return text.str();
}

} // namespace

double StepOfNumber(int number)
{
  return SmallestStep * std::pow(StepRatio, number);
}

Carriers CarriersOf(const SecretKey& key, Index messageBits)
{
  if (messageBits < 1 || messageBits > LargestMessage)
  {
    throw InvalidInput("the robust scheme takes messages of 1 to " +
      std::to_string(LargestMessage) + " bits, not " + std::to_string(messageBits));
  }
  const Index blocks = BlocksOf(messageBits);
  const Index count = GolayCodeBits * blocks;
  Carriers carriers;
  carriers.MessageBits = messageBits;
  carriers.CheckBits = GolayDataBits * blocks - messageBits;
  carriers.Waves = EvenWaves(key.WaveNumbers(3 * CandidatesPerWave * count / 2), count / 2);
  const std::vector<double> dither = key.Dither(count);
  carriers.Dither = Eigen::Map<const VectorXd>(dither.data(), count);
  carriers.Whitening = key.CarrierKeystream(count);
  return carriers;
}

std::string DataOf(const std::string& message, const SecretKey& key, const Carriers& carriers)
{
  return message + key.Check(message, carriers.CheckBits);
}

std::string CodeOf(const std::string& data)
{
  const std::size_t words = data.size() / GolayDataBits;
  std::string code(words * GolayCodeBits, '0');
  for (std::size_t w = 0; w < words; ++w)
  {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < GolayDataBits; ++i)
    {
      bits |= (data[GolayDataBits * w + i] == '1' ? 1U : 0U) << i;
    }
    const std::uint32_t word = GolayEncode(bits);
    for (std::size_t i = 0; i < GolayCodeBits; ++i)
    {
      code[i * words + w] = (word >> i & 1U) != 0 ? '1' : '0';
    }
  }
  return code;
}

Index CapacityOf(const TriangleMesh& mesh, const SecretKey& key, double maximumDistortion,
  int threads, const Progress& progress)
{
  const TriangleMesh oriented = Oriented(mesh);
  const Index words = Capacity(oriented, key, maximumDistortion, threads)
                        .MostWords(BlocksOf(LargestMessage) + 1, progress);
  progress.Report(1.0);
  return MessageBitsOf(words);
}

SolidEmbeddingResult EmbedInSolid(const TriangleMesh& mesh, const SecretKey& key,
  const SolidEmbeddingOptions& options, const Progress& progress)
{
  CheckMessage(options.Message);
  const auto bits = static_cast<Index>(options.Message.size());
  const TriangleMesh oriented = Oriented(mesh);
  const View view(oriented);
  const Payload payload(view, key, bits, options.Threads);
  const std::string code = CodeOf(DataOf(options.Message, key, payload.Carrier));
  const Embedding embedding(oriented, payload, options.Threads);
  progress.Report(0.1);

  const double scale = view.Frame.Scale / BoundingBoxDiagonal(oriented.Points);
  double budget = PlannedPart * options.MaximumDistortion / scale;
  SolidEmbeddingResult result;
  for (int attempt = 0; attempt < MostAttempts; ++attempt)
  {
    const Plan plan = LargestAffordable(payload, code, budget);
    if (plan.Step < 0)
    {
      const Capacity capacity(oriented, key, options.MaximumDistortion, options.Threads);
      const Index most =
        MessageBitsOf(capacity.MostWords(BlocksOf(bits), progress.Part(0.55, 1.0)));
      throw InvalidInput(std::to_string(bits) + " bits would move the surface by " +
        Percent(attempt == 0 ? plan.Distortion * scale : result.Distortion) +
        " of its diagonal, more than MaximumDistortion, " + Percent(options.MaximumDistortion) +
        ": raise it, or embed fewer bits (" + std::to_string(most) + " would fit)");
    }
    const double begin = 0.1 + 0.45 * attempt / MostAttempts;
    result = embedding.Run(plan, options, progress.Part(begin, begin + 0.45 / MostAttempts));
    if (result.Distortion <= options.MaximumDistortion)
    {
      break;
    }
    // The response is not linear: by so much more than planned.
    budget *= std::min(0.95, options.MaximumDistortion / result.Distortion);
  }
  TriangleMesh marked = mesh;
  marked.Points = result.Points;
  const SolidReading reading =
    ReadSolid(marked, key, bits, options.Threads, progress.Part(0.55, 1.0));
  result.ExtractedMessage = reading.Message;
  result.Converged = reading.IsValid && reading.Message == options.Message &&
    result.Distortion <= options.MaximumDistortion;
  return result;
}

} // namespace spectralwatermark

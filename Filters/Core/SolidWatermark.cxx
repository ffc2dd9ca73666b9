// SPDX-License-Identifier: BSD-3-Clause
#include "SolidWatermark.h"

#include "Distortion.h"
#include "Errors.h"
#include "GolayCode.h"
#include "MemoryLimit.h"
#include "SlotWatermark.h"
#include "Solid.h"
#include "SolidReader.h"
#include "SolidResponse.h"

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

// Of an embedding at its peak: two responses, and what the second is made from.
double MemoryOf(Index vertices, Index carriers)
{
  constexpr double patterns = 2.5;
  return patterns * sizeof(double) * static_cast<double>(vertices) *
    static_cast<double>(carriers + FrameMoments);
}

// What the plans of an embedding are made from.
struct Payload
{
  Payload(const SolidView& view, const SecretKey& key, Index bits, int threads)
    : Carrier(CarriersOf(key, bits))
    , Values(SolidSpectrum(view.Mesh, this->Carrier.Waves, threads))
    , Responding(view, this->Carrier, threads)
    , Cost(this->Responding.Cost(this->Carrier.Count()))
  {
  }

  Carriers Carrier;
  VectorXd Values;
  SolidResponse Responding;
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

  // The points, not yet stored, the step and the rounds.
  SolidEmbeddingResult Run(const Plan& plan, const Progress& progress) const;

  // Root mean square, parts of the diagonal.
  double Distortion(const TriangleMesh::PointMatrix& points) const
  {
    return RootMeanSquare(this->Original, points) / this->Diagonal;
  }

  double Margin(const TriangleMesh& marked, const Plan& plan) const
  {
    const VectorXd misses = this->Spectrum(SolidView(marked)) - plan.Targets;
    return std::max(0.0, 1.0 - 4.0 * misses.cwiseAbs().maxCoeff() / StepOfNumber(plan.Step));
  }

private:
  VectorXd Spectrum(const SolidView& view) const
  {
    return SolidSpectrum(view.Mesh, this->Content.Carrier.Waves, this->Threads);
  }

  const TriangleMesh& Original;
  const Payload& Content;
  int Threads;
  double Diagonal;
};

SolidEmbeddingResult Embedding::Run(const Plan& plan, const Progress& progress) const
{
  SolidEmbeddingResult result;
  result.Step = StepOfNumber(plan.Step);
  TriangleMesh mesh = this->Original;
  std::optional<SolidResponse>
    fresh; // where the mesh is by now, once the original's serves no more
  double lastError = std::numeric_limits<double>::infinity();
  for (int round = 0; round <= MostRounds; ++round)
  {
    const SolidView view(mesh);
    const VectorXd changes =
      plan.Targets - (round == 0 ? this->Content.Values : this->Spectrum(view));
    const double error = changes.cwiseAbs().maxCoeff() / result.Step;
    result.Rounds.push_back({ this->Distortion(mesh.Points), error });
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
    const SolidResponse& response = fresh ? *fresh : this->Content.Responding;
    const VectorXd heights = response.Displacements(changes);
    mesh.Points += view.Frame.DifferencesFromFrame(heights.asDiagonal() * VertexNormals(view.Mesh));
  }
  result.Points = std::move(mesh.Points);
  return result;
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
    Index most = WordsOf(1) - 1;
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
    const Index vertices = this->Mesh.NumberOfVertices();
    if (carriers + FrameMoments >= vertices || MemoryOf(vertices, carriers) > AvailableMemory())
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
          .Run(plan, progress.Part(0.3, 1.0))
          .Rounds.back()
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
  SolidView Seen;
};

std::string Percent(double part)
{
  std::ostringstream text;
  text << std::setprecision(3) << 100.0 * part << " %";
  return text.str();
}

} // namespace

Index CapacityOf(const TriangleMesh& mesh, const SecretKey& key, double maximumDistortion,
  int threads, const Progress& progress)
{
  const TriangleMesh oriented = Oriented(mesh);
  const Index words = Capacity(oriented, key, maximumDistortion, threads)
                        .MostWords(WordsOf(LargestMessage) + 1, progress);
  progress.Report(1.0);
  return MessageBitsOf(words);
}

SolidEmbeddingResult EmbedInSolid(const TriangleMesh& mesh, const SecretKey& key,
  const SolidEmbeddingOptions& options, const Progress& progress)
{
  CheckMessage(options.Message);
  const auto bits = static_cast<Index>(options.Message.size());
  RequireMemory(MemoryOf(mesh.NumberOfVertices(), GolayCodeBits * WordsOf(bits)),
    std::to_string(bits) + " bits in " + std::to_string(mesh.NumberOfVertices()) + " vertices",
    "embed fewer bits, or simplify the mesh first");
  const TriangleMesh oriented = Oriented(mesh);
  const SolidView view(oriented);
  const Payload payload(view, key, bits, options.Threads);
  const std::string code = CodeOf(DataOf(options.Message, key, payload.Carrier));
  const Embedding embedding(oriented, payload, options.Threads);
  const Storage store = options.Store ? options.Store : ExactStorage(mesh);
  progress.Report(0.1);

  const double scale = view.Frame.Scale / BoundingBoxDiagonal(oriented.Points);
  double budget = PlannedPart * options.MaximumDistortion / scale;
  SolidEmbeddingResult result;
  StoredMesh stored;
  Plan plan;
  for (int attempt = 0; attempt < MostAttempts; ++attempt)
  {
    plan = LargestAffordable(payload, code, budget);
    if (plan.Step < 0)
    {
      const Capacity capacity(oriented, key, options.MaximumDistortion, options.Threads);
      const Index most = MessageBitsOf(capacity.MostWords(WordsOf(bits), progress.Part(0.55, 1.0)));
      throw InvalidInput(std::to_string(bits) + " bits would move the surface by " +
        Percent(attempt == 0 ? plan.Distortion * scale : result.Distortion) +
        " of its diagonal, more than MaximumDistortion, " + Percent(options.MaximumDistortion) +
        ": raise it" +
        (most > 0 ? ", or embed fewer bits (" + std::to_string(most) + " would fit)"
                  : "; not even one bit fits"));
    }
    const double begin = 0.1 + 0.45 * attempt / MostAttempts;
    result = embedding.Run(plan, progress.Part(begin, begin + 0.45 / MostAttempts));
    stored = ReadStored([&]() { return store(result.Points); });
    result.Distortion = embedding.Distortion(stored.Points);
    if (result.Distortion <= options.MaximumDistortion)
    {
      break;
    }
    // The response is not linear: by so much more than planned.
    budget *= std::min(0.95, options.MaximumDistortion / result.Distortion);
  }
  result.Points = stored.Points;
  const SolidReading reading = ReadStored(
    [&]()
    {
      result.Margin = embedding.Margin(Oriented(stored.Mesh), plan);
      return ReadSolid(stored.Mesh, key, bits, options.Threads, progress.Part(0.55, 1.0));
    });
  result.ExtractedMessage = reading.Message;
  result.Converged = reading.IsValid && reading.Message == options.Message &&
    result.Distortion <= options.MaximumDistortion;
  return result;
}

} // namespace spectralwatermark

// SPDX-License-Identifier: BSD-3-Clause
#include "Core/PaperScheme/SlotEmbedding.h"

#include "Core/Payload/Bits.h"

#include <cmath>
#include <limits>

namespace spectralwatermark
{

namespace
{

// The share of the remaining progress that each basis gets. The number of bases is not known in
// advance; three are usual.
constexpr double ShareOfRest = 0.35;

// The part of the progress for the basis with this number, counted from 0.
Progress PartOfSolve(const Progress& progress, Index solve)
{
  const double rest = std::pow(1.0 - ShareOfRest, static_cast<double>(solve));
  return progress.Part(1.0 - rest, 1.0 - (1.0 - ShareOfRest) * rest);
}

} // namespace

SlotEmbeddingResult EmbedMessageInSlots(const TriangleMesh& original,
  const SlotEmbeddingOptions& options, const std::optional<ManifoldHarmonics>& firstBasis,
  const Progress& progress)
{
  const Index bits = static_cast<Index>(options.Message.size());
  CheckMessage(options.Message);
  CheckSlots(options.Slots, bits);
  CheckCapacity(options.Slots, bits, original.NumberOfVertices());
  const Index required = options.RequiredBits > 0 ? std::min(options.RequiredBits, bits) : bits;
  HarmonicsOptions harmonicsOptions;
  harmonicsOptions.Count = ComponentsNeeded(options.Slots, bits);
  harmonicsOptions.Tolerance = options.Tolerance;
  harmonicsOptions.Threads = options.Threads;
  // The memory is checked once, for the two bases held at a time, so that no later iteration runs
  // out.
  harmonicsOptions.CheckMemory = false;
  RequireMemoryForHarmonics(original.NumberOfVertices(), harmonicsOptions.Count, 1);

  SlotEmbeddingResult result;
  const RoundTrip store = options.Store ? options.Store : ExactRoundTrip(original);
  RoundTripResult stored = ExactRoundTrip(original)(original.Points);
  // The previous basis is a good initial guess, because each iteration changes the mesh only a
  // little.
  const auto computeBasis = [&](const ManifoldHarmonics* previous)
  {
    const Progress part = PartOfSolve(progress, result.Eigensolves++);
    harmonicsOptions.InitialGuess = previous;
    return ComputeManifoldHarmonics(stored.Mesh, harmonicsOptions, part);
  };
  ManifoldHarmonics basis = firstBasis ? *firstBasis : computeBasis(nullptr);
  CheckSlotsAboveKernel(options.Slots, basis.KernelDimension);

  Spectrum spectrum = ForwardTransform(basis, stored.Mesh.Points);
  std::vector<SlotReading> readings = ReadSlots(Magnitudes(spectrum), options.Slots, bits);
  result.History.push_back(readings);

  Index best = -1;
  for (Index iteration = 1; iteration <= options.MaximumIterations; ++iteration)
  {
    const TriangleMesh::PointMatrix change =
      InverseTransform(basis, SpectrumChange(spectrum, readings, options.Message, options.Slots));
    try
    {
      ReadAfterRoundTrip(
        [&]()
        {
          stored = store(stored.Points + stored.ToStored(change));
          basis = computeBasis(&basis);
          CheckSlotsAboveKernel(options.Slots, basis.KernelDimension);
        });
    }
    catch (const InvalidInput&)
    {
      if (best < 0)
      {
        throw;
      }
      // The best mesh so far is the result.
      break;
    }
    spectrum = ForwardTransform(basis, stored.Mesh.Points);
    readings = ReadSlots(Magnitudes(spectrum), options.Slots, bits);
    result.History.push_back(readings);

    const std::string extracted = MessageOf(readings);
    const Index right = CountAgreements(extracted, options.Message);
    if (right > best)
    {
      best = right;
      result.Points = stored.Points;
      result.ExtractedMessage = extracted;
      result.Iterations = iteration;
    }
    if (right >= required)
    {
      result.Converged = true;
      break;
    }
  }
  progress.Report(1.0);
  return result;
}

} // namespace spectralwatermark

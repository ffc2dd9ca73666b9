// SPDX-License-Identifier: BSD-3-Clause
// Measures whether the p-values of the scheme Robust are calibrated. Reads unmarked meshes, and the
// same meshes marked under another key, with many keys, and counts the bits that agree with the
// message of each key. A key is a trial: messages drawn at random would agree binomially with
// anything.
//
//     CalibrateRobust KEYS MESH.ply ...
//
// KEYS is the number of keys for each mesh: half are tried on the unmarked mesh, half on the marked
// one. Messages have 4 bits, 24 with their check. Prints the counts of agreeing bits and the false
// positives, each with those of the exact distribution.
#include "Benchmark/BenchmarkMesh.h"
#include "Core/Payload/Bits.h"
#include "Core/Payload/SecretKey.h"
#include "Core/RobustScheme/CarrierSet.h"
#include "Core/RobustScheme/RobustEmbedding.h"
#include "Core/RobustScheme/RobustReader.h"
#include "Core/Support/Progress.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <iomanip>
#include <iostream>
#include <string>
#include <vector>

namespace sw = spectralwatermark;

namespace
{

constexpr sw::Index MessageBits = 4;
constexpr int DataBits = 24;
constexpr int Threads = 2;

using Counts = std::vector<double>; // of keys with 0, 1, ... agreeing bits

sw::TriangleMesh MarkedByAnother(sw::TriangleMesh mesh)
{
  sw::RobustEmbeddingOptions options;
  options.Message = "1011001110001011";
  options.Threads = Threads;
  mesh.Points =
    sw::EmbedRobust(mesh, sw::SecretKey("another owner"), options, sw::Progress()).Points;
  return mesh;
}

void Count(const sw::TriangleMesh& mesh, const sw::SecretKey& key, Counts& counts)
{
  const sw::RobustReading reading = sw::ReadRobust(mesh, key, MessageBits, Threads, sw::Progress());
  const std::string expected =
    sw::DataOf(key.Message(MessageBits), key, sw::CheckBitsOf(MessageBits));
  counts[static_cast<std::size_t>(sw::CountAgreements(reading.Data, expected))] += 1.0;
}

Counts ExactDistribution()
{
  Counts chances(DataBits + 1);
  double chance = std::pow(0.5, DataBits);
  for (int k = 0; k <= DataBits; ++k)
  {
    chances[static_cast<std::size_t>(k)] = chance;
    chance *= static_cast<double>(DataBits - k) / (k + 1);
  }
  return chances;
}

void Report(const Counts& counts)
{
  const Counts chances = ExactDistribution();
  double trials = 0.0;
  for (const double count : counts)
  {
    trials += count;
  }
  std::cout << std::fixed << std::setprecision(0) << trials
            << " keys\nagreeing bits, counted, expected\n";
  double chiSquare = 0.0;
  int cells = 0;
  for (std::size_t k = 0; k <= DataBits; ++k)
  {
    const double mean = trials * chances[k];
    std::cout << std::fixed << std::setw(3) << k << std::setw(10) << std::setprecision(0)
              << counts[k] << std::setw(12) << std::setprecision(2) << mean << std::defaultfloat
              << std::setprecision(3) << "\n";
    if (mean >= 5.0)
    {
      chiSquare += (counts[k] - mean) * (counts[k] - mean) / mean;
      ++cells;
    }
  }
  std::cout << "chi square " << chiSquare << " over " << cells << " counts of 5 or more (expected "
            << cells << ", deviation " << std::sqrt(2.0 * cells) << ")\n"
            << "false positives: rate asked for, exact rate, measured, its 95 % interval under the "
               "exact rate\n";
  for (const double alpha : { 5e-2, 1e-2, 1e-3 })
  {
    double exact = 0.0;
    double measured = 0.0;
    for (std::size_t k = DataBits + 1; k-- > 0 && exact + chances[k] <= alpha;)
    {
      exact += chances[k];
      measured += counts[k] / trials;
    }
    const double width = 1.96 * std::sqrt(exact * (1.0 - exact) / trials);
    std::cout << alpha << "  " << exact << "  " << measured << "  [" << std::max(0.0, exact - width)
              << ", " << exact + width << "]\n";
  }
}

} // namespace

int main(int argc, char** argv)
try
{
  if (argc < 3)
  {
    std::cerr << "usage: CalibrateRobust KEYS MESH.ply ...\n";
    return EXIT_FAILURE;
  }
  const int keys = std::stoi(argv[1]);
  Counts counts(DataBits + 1, 0.0);
  for (int a = 2; a < argc; ++a)
  {
    const std::string name = argv[a];
    const sw::TriangleMesh mesh = sw::benchmark::ReadMesh(name, 0);
    const sw::TriangleMesh marked = MarkedByAnother(mesh);
    for (int k = 0; k < keys; ++k)
    {
      Count(k % 2 == 0 ? mesh : marked, sw::SecretKey(name + " " + std::to_string(k)), counts);
    }
    std::cerr << name << " done\n";
  }
  Report(counts);
  return EXIT_SUCCESS;
}
catch (const std::exception& error)
{
  std::cerr << "CalibrateRobust: " << error.what() << "\n";
  return EXIT_FAILURE;
}

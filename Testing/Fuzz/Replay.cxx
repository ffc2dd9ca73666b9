// SPDX-License-Identifier: BSD-3-Clause
// Runs a fuzz target on files and on all files of folders, where there is no libFuzzer to do it.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace
{

int Run(const std::filesystem::path& path)
{
  std::ifstream file(path, std::ios::binary);
  const std::vector<char> content{ std::istreambuf_iterator<char>(file), {} };
  const std::vector<std::uint8_t> bytes(content.begin(), content.end());
  std::printf("%s\n", path.filename().c_str());
  std::fflush(stdout); // what is running, should it crash
  LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
  return 1;
}

} // namespace

int main(int argc, char* argv[])
{
  int count = 0;
  for (int k = 1; k < argc; ++k)
  {
    if (std::filesystem::is_directory(argv[k]))
    {
      for (const auto& entry : std::filesystem::directory_iterator(argv[k]))
      {
        count += Run(entry.path());
      }
    }
    else
    {
      count += Run(argv[k]);
    }
  }
  std::printf("%d inputs\n", count);
  return count > 0 ? 0 : 1;
}

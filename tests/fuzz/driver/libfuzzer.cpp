// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause

// libFuzzer over the target that SIGLOC_FUZZ_TARGET names. At its end it prints how many inputs
// were accepted.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "fuzz/targets.h"

namespace
{
sigloc::fuzz::Target target = nullptr;
std::uint64_t executed = 0;
std::uint64_t accepted = 0;
std::vector<std::string> samples;

void report()
{
  std::printf("executed %llu accepted %llu\n", static_cast<unsigned long long>(executed),
              static_cast<unsigned long long>(accepted));
}

void readSamples(const std::filesystem::path& folder)
{
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
  {
    if (entry.path().filename().string().rfind("good", 0) == 0) paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  for (const auto& path : paths)
  {
    std::ifstream in(path, std::ios::binary);
    samples.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
  }
}
}  // namespace

extern "C" size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

extern "C" int LLVMFuzzerInitialize(int*, char***)
{
  const char* const name = std::getenv("SIGLOC_FUZZ_TARGET");
  for (const auto& known : sigloc::fuzz::kTargets)
  {
    if (name != nullptr && known.name == name) target = known.run;
  }
  if (target == nullptr)
  {
    std::fputs("SIGLOC_FUZZ_TARGET names no target\n", stderr);
    std::exit(2);
  }
  if (const char* const folder = std::getenv("SIGLOC_FUZZ_SAMPLES")) readSamples(folder);
  std::atexit(report);
  return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed)
{
  constexpr std::size_t kMostChanged = 8;  // bytes at a place
  std::minstd_rand random(seed);
  const bool anew = !samples.empty() && random() % 2 == 0;
  if (!anew) return LLVMFuzzerMutate(data, size, most);
  const std::string& sample = samples[random() % samples.size()];
  if (sample.empty() || sample.size() > most) return LLVMFuzzerMutate(data, size, most);
  std::memcpy(data, sample.data(), sample.size());
  for (std::size_t changes = 1 + random() % 3; changes > 0; --changes)
  {
    const std::size_t at = random() % sample.size();
    const std::size_t here = std::min(1 + random() % kMostChanged, sample.size() - at);
    // Of the same size, so that what follows stays in its place.
    LLVMFuzzerMutate(data + at, here, here);
  }
  return sample.size();
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  ++executed;
  if (target({reinterpret_cast<const char*>(data), size})) ++accepted;
  return 0;
}

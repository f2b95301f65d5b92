// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause

// libFuzzer over the target that SIGLOC_FUZZ_TARGET names. At its end it prints how many inputs
// were accepted.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "fuzz/targets.h"

namespace
{
sigloc::fuzz::Target target = nullptr;
std::uint64_t executed = 0;
std::uint64_t accepted = 0;

void report()
{
  std::printf("executed %llu accepted %llu\n", static_cast<unsigned long long>(executed),
              static_cast<unsigned long long>(accepted));
}
}  // namespace

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
  std::atexit(report);
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  ++executed;
  if (target({reinterpret_cast<const char*>(data), size})) ++accepted;
  return 0;
}

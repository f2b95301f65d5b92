// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/process/cpu_time.h"

#include <malloc.h>
#include <ctime>

#include <fstream>
#include <string>

namespace sigloc
{
double threadCpuSeconds()
{
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

void resetPeakMemory()
{
  std::ofstream("/proc/self/clear_refs") << "5";
}

double peakMemoryMb()
{
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
  {
    if (word != "VmHWM:") continue;
    double kilobytes = 0;
    status >> kilobytes;
    return kilobytes / 1024.0;
  }
  return 0;
}

double heapBytes()
{
  const struct mallinfo2 heap = mallinfo2();
  return static_cast<double>(heap.uordblks + heap.hblkhd);
}
}  // namespace sigloc

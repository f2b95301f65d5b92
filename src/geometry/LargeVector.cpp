// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/LargeVector.h"

#include <cstdlib>
#include <new>
#ifdef __linux__
#include <sys/mman.h>
#endif

namespace sigloc
{
void* allocateTable(std::size_t bytes)
{
  constexpr std::size_t kLargePage = 2U << 20U;
  if (bytes < 2 * kLargePage)
  {
    void* table = std::malloc(bytes);
    if (!table) throw std::bad_alloc();
    return table;
  }
  const std::size_t rounded = (bytes + kLargePage - 1) / kLargePage * kLargePage;
  void* table = std::aligned_alloc(kLargePage, rounded);
  if (!table) throw std::bad_alloc();
#ifdef __linux__
  // Advice only: small pages work too, but slower. The unused part of the last large page is left
  // out.
  madvise(table, bytes / kLargePage * kLargePage, MADV_HUGEPAGE);
#endif
  return table;
}

void freeTable(void* table) noexcept
{
  std::free(table);
}
}  // namespace sigloc

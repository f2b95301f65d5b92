// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace sigloc
{
/// Returns memory for a table with random access, on large pages where the system has them.
/// On small pages, finding the pages would take most of the time. Throws std::bad_alloc.
void* allocateTable(std::size_t bytes);
void freeTable(void* table) noexcept;

template <class T>
struct TableAllocator
{
  using value_type = T;  // NOLINT(readability-identifier-naming): what allocators call it
  TableAllocator() = default;
  template <class U>
  // NOLINTNEXTLINE(google-explicit-constructor): allocators convert
  TableAllocator(const TableAllocator<U>& /*other*/)
  {
  }
  T* allocate(std::size_t n) { return static_cast<T*>(allocateTable(n * sizeof(T))); }
  void deallocate(T* table, std::size_t /*n*/) noexcept { freeTable(table); }
  friend bool operator==(const TableAllocator& /*a*/, const TableAllocator& /*b*/) { return true; }
  friend bool operator!=(const TableAllocator& /*a*/, const TableAllocator& /*b*/) { return false; }
};

/// A vector for large tables with random access.
template <class T>
using LargeVector = std::vector<T, TableAllocator<T>>;
}  // namespace sigloc

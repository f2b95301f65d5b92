// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>

namespace sigloc
{
/// Calls `work(i)` once for every i < count, on up to `threads` threads. The first exception thrown
/// is thrown again here, after all threads have stopped.
void runParallel(std::size_t count, std::size_t threads,
                 const std::function<void(std::size_t)>& work);
}  // namespace sigloc

// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace sigloc
{
/// Is told what is done, and how much of it: a share in [0, 1].
using ShowProgress = std::function<void(const std::string& what, double share)>;

/// Calls `work(i)` once for every i < count, on up to `threads` threads. `progress` is told after
/// each, one call at a time. The first exception thrown is thrown again here, after all threads
/// have stopped.
void runParallel(std::size_t count, std::size_t threads,
                 const std::function<void(std::size_t)>& work, const std::string& what = {},
                 const ShowProgress& progress = {});
}  // namespace sigloc

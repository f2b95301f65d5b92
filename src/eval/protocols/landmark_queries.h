// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "eval/data/landmark_data.h"
#include "eval/protocols/landmarks.h"
#include "features/LocalMap.h"

namespace sigloc::detail
{
/// Returns the local map of the last `count` steps up to `step`.
LocalMap localMapAt(const LandmarkData& data, std::size_t step, std::size_t count);

/// DLR: returns steps of the second half of the path at positions that the first half has visited.
std::vector<std::size_t> laterVisits(const LandmarkData& data, const LandmarksOptions& options);
}  // namespace sigloc::detail

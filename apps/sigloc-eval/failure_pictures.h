// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "eval/scoring/failed_queries.h"

namespace sigloc
{
/// What failed, and the folder below `failures` for it, empty for that folder itself.
using FailuresByFolder = std::vector<std::pair<std::string, std::vector<FailedQuery>>>;

/// Draws each failed query of a run as OUT/failures[/<folder>]/<method>-<query>.png. The overview
/// is the map with the proposed poses, the candidates that were kept and the truth. Two close-ups
/// show the scan drawn at the truth and at the first candidate. An earlier run's pictures are
/// removed. Folders are made when there is anything to draw. Throws std::runtime_error ("path:
/// reason", or that there is no off-screen rendering).
void drawFailures(const FailuresByFolder& failures, const std::filesystem::path& out);
}  // namespace sigloc

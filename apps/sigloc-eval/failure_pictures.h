// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "sigloc/eval/failed_queries.h"

namespace sigloc
{
/// Removes the pictures that an earlier run left in a folder and its subfolders.
void removeFailurePictures(const std::filesystem::path& folder);

/// Draws each failed query as FOLDER/<method>-<query>.png: the map with what was proposed, the
/// candidates that were kept and the truth, and closer the scan laid at the truth and at the first
/// candidate. Makes the folder when there is anything to draw.
/// Throws std::runtime_error ("path: reason", or that there is no off-screen rendering).
void drawFailures(const std::vector<FailedQuery>& failures, const std::filesystem::path& folder);
}  // namespace sigloc

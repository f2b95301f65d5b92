// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace sigloc::detail
{
constexpr const char* kRunSummaryFile = "summary.json";
constexpr const char* kInnerWork = ".partial";  ///< work folder where none can be made beside it

/// Throws std::runtime_error ("folder: reason") unless `folder` is missing, empty or the output of
/// a finished run of sigloc-localize. Such an output has only the files of a run, and its summary
/// among them.
void requireFinishedRun(const std::filesystem::path& folder);

/// The same for the folder that a run works in, which holds no summary until it ends.
void requireUnfinishedRun(const std::filesystem::path& folder);
}  // namespace sigloc::detail

// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "eval/reports/report_files.h"

namespace sigloc
{
/// What `mergeRuns` makes of several runs.
struct MergedRuns
{
  RunReport report;  ///< of the same shape as the runs', to be written by `writeRunReport`
  bool complete = true;  ///< false when a run was on incomplete input
};

/// The files of such runs' folders that are pooled.
std::vector<std::filesystem::path> filesOfRuns(const std::vector<std::filesystem::path>& runs);

/// Pools what runs of one sub-command of sigloc-eval wrote into their folders, as if all their
/// queries had been asked in one run. Counts add up, shares and their Wilson intervals come from
/// the summed counts, so that every query weighs the same.
///
/// * `relocate` and `sweep` (over one quantity): from the rows of results.csv, quantiles included.
/// * `track`: from the counts in summary.json; quantiles cannot be pooled from those.
///
/// Throws std::invalid_argument for fewer than two runs. Throws std::runtime_error ("path: reason")
/// for a folder without such results, for runs of unlike kinds or methods, and for runs that hold
/// the same queries.
MergedRuns mergeRuns(const std::vector<std::filesystem::path>& runs, const std::string& command);
}  // namespace sigloc

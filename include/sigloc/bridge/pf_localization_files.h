// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sigloc/bridge/LocalizationRun.h"

namespace sigloc
{
/// Writes the text files of pf-localization's log folder, for scripts that read those. Each has one
/// row a step, pf-localization's some fewer; what is not known at a step is `nan`.
///
/// * `cov_est.txt`: square root of the determinant of the belief's covariance
/// * `odo_est.txt`: dead reckoning, `x y phi`
/// * `GT_error.txt`: mean distance of the belief from the truth [m]
/// * `ODO_error.txt`: distance of dead reckoning from the truth [m]
/// * `exec_times.txt`: [s]
/// * `PF_stats.txt`: hypotheses, their effective number, the variance of their weights,
///   reliability, and what `cov_est.txt` holds
/// * `particles/particles_00001.txt`: 500 samples of the belief, where a scene is written as well
///
/// Throws std::runtime_error for a file that cannot be written.
void writePfLocalizationFiles(const LocalizationRun& run, const std::filesystem::path& folder);

/// The names that these functions use in a folder.
const std::vector<std::string>& pfLocalizationFiles();

/// What one run adds to `<prefix>_SUMMARY.txt`.
struct ExperimentOutcome
{
  std::optional<bool> converged;
  std::size_t particles = 0;  ///< 0: no particles
  double seconds = 0;  ///< spent on its steps
  std::vector<double> errors;  ///< [m], of the steps with truth
};
ExperimentOutcome outcomeOf(const LocalizationRun& run);

/// Returns pf-localization's summary of one experiment's repetitions: a comment with the columns
/// and one row. The ratio of convergence is `nan` when no run was tested, the errors are `nan`
/// without truth; the interval reaches from quantile `confidence_share` to one minus it.
std::string experimentSummary(const std::vector<ExperimentOutcome>& repetitions,
                              double confidence_share);

/// Returns `<folder>_SUMMARY.txt`. Throws std::runtime_error when a file of that name is something
/// else than the summary of an earlier run.
std::filesystem::path experimentSummaryFile(const std::filesystem::path& folder);

/// Writes that file, replacing an earlier one; where nothing can be written beside the folder,
/// `_SUMMARY.txt` in it. Throws std::runtime_error where that can't be written either.
void writeExperimentSummary(const std::filesystem::path& folder, const std::string& text);
}  // namespace sigloc

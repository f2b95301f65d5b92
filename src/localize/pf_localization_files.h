// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sigloc/localize/LocalizationRun.h"

namespace sigloc
{
/// Writes the text files of pf-localization's log folder, for scripts that read those. Each has one
/// row for each step, pf-localization's some fewer. A value that is not known at a step is `nan`.
/// Where no step has a truth, the files of errors are empty, as pf-localization's are.
///
/// * `cov_est.txt`: square root of the determinant of the belief's covariance; unless localized,
///   with "somewhere else" in it, see withElsewhere()
/// * `odo_est.txt`: dead reckoning, `x y phi`
/// * `GT_error.txt`: mean distance of the belief from the truth [m]
/// * `ODO_error.txt`: distance of dead reckoning from the truth [m]
/// * `exec_times.txt`: time by the clock [s]: in all, of extraction, of tracking
/// * `PF_stats.txt`: hypotheses, their effective number, the variance of their weights,
///   reliability, and what `cov_est.txt` holds
/// * `particles/particles_00001.txt`: 500 samples of that belief, where a scene is written as well
///
/// They are on the disk once syncFolder() is called. Throws std::runtime_error for a file that
/// cannot be written.
void writePfLocalizationFiles(const LocalizationRun& run, const std::filesystem::path& folder);

/// The names that these functions use in a folder.
const std::vector<std::string>& pfLocalizationFiles();

}  // namespace sigloc

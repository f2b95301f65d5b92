// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "sigloc/eval/provenance.h"
#include "sigloc/eval/relocation_scoring.h"
#include "sigloc/eval/TrackingMethod.h"

namespace sigloc
{
/// Wake-ups: the robot is lost at N places of a log, equally spaced in travelled distance, and
/// drives on. With `kidnap` it is carried to another start half-way.
struct TrackOptions
{
  std::string landmarks;  ///< "dlr" or "victoria-park": a landmark log in place of what follows
  std::filesystem::path landmark_folder;
  std::filesystem::path map;
  std::filesystem::path rawlog;
  std::filesystem::path ground_truth;
  std::filesystem::path start_from;  ///< simplemap: starts only at its key frames' times, or empty
  mrpt::math::TPose2D map_from_truth;
  std::uint32_t starts = 10;
  double travel = 20;  ///< [m] driven after a start, and again after a kidnapping
  bool kidnap = false;
  std::vector<std::string> methods = {"signature", "mcl"};
  AccuracyGates gates;
  RelocationMethodOptions method;
  std::uint32_t threads = 1;  ///< runs at a time
  std::string command;
  std::function<void(const std::string& method, double share)> progress;
};

/// One step of a run, judged.
struct TrackStepRecord
{
  std::size_t step = 0;  ///< of the log
  double travelled = 0;  ///< [m] since the start
  TrackClaim claim;
  PoseError error;  ///< NaN without truth
  double nees = std::numeric_limits<double>::quiet_NaN();  ///< see squaredNormalisedError
  bool mapped = true;  ///< the truth lies within 1 m of a mapped pose, or the map has no poses
  Claim judged = Claim::none;
  double time_ms = 0;
};

/// One wake-up, judged.
struct TrackRun
{
  std::size_t start = 0;  ///< step of the log; of a simulation, the number of the drive
  std::string group;  ///< kind of the simulated world, or empty
  std::vector<TrackStepRecord> steps;
  std::size_t kidnapped_at = 0;  ///< index into steps; 0: not kidnapped
  bool right_at_end = false;  ///< at the last mapped step with truth
  std::optional<double> settled_after;  ///< [m], confident from there on where mapped; none: never
  double cpu_to_settled = 0;  ///< [s]; of the whole run when it never settles
  std::size_t wrong_steps = 0;  ///< off the mapped area too
  std::size_t wrong_episodes = 0;
  std::optional<double> noticed_after;  ///< [m] after the kidnapping; none: never
};

/// Fills the judgements from the steps.
void judgeRun(TrackRun& run);

struct TrackMethodReport
{
  std::string name;
  std::vector<TrackRun> runs;
  double peak_rss_mb = 0;
};

struct TrackReport
{
  std::vector<TrackMethodReport> methods;
  std::size_t map_features = 0;
  double map_build_seconds = 0;
  bool complete = true;
  Provenance provenance;
};

/// Throws std::invalid_argument for options that make no sense and std::runtime_error
/// ("path: reason") for a file that cannot be used.
TrackReport runTrack(const TrackOptions& options);

/// Writes summary.json, results.csv (a row a step), runs.csv (a row a run) and report.md into a
/// folder.
void writeTrackReport(const TrackReport& report, const std::filesystem::path& folder);

std::string trackTable(const TrackReport& report);
}  // namespace sigloc

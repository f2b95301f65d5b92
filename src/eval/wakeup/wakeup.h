// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "config/columns.h"
#include "eval/methods/TrackingMethod.h"
#include "eval/process/run_parallel.h"
#include "eval/scoring/failed_queries.h"
#include "eval/scoring/map_statistics.h"
#include "eval/scoring/provenance.h"
#include "eval/scoring/relocation_scoring.h"
#include "sigloc/io/RawlogReader.h"

namespace sigloc
{
/// Wake-ups: the robot is lost at N places of a log, equally spaced in travelled distance, and
/// drives on. With `kidnap` it is carried to another start half-way. With `foreign` the log is of
/// another place than the map: there is no truth, distances are those of the odometry, and every
/// claim is wrong.
struct WakeupOptions
{
  std::string landmarks;  ///< "dlr" or "victoria-park": a landmark log in place of what follows
  std::filesystem::path landmark_folder;
  std::filesystem::path map;
  /// A simplemap of a whole drive in place of `map`: its first 60 % are the map, robots wake up in
  /// the rest, on mapped area. Without `rawlog` the odometry is made: the increments of the key
  /// frames' poses with noise. With it the drive is what the log holds outside of the map's time.
  std::filesystem::path frames;
  bool reversed = false;  ///< the last 60 % of `frames` are the map
  std::filesystem::path rawlog;
  std::filesystem::path ground_truth;
  std::filesystem::path start_from;  ///< simplemap: starts only at its key frames' times, or empty
  mrpt::math::TPose2D map_from_truth;
  ReadingOptions reading;
  std::uint32_t starts = 10;  ///< places to wake up at, none twice
  bool apart = false;  ///< as many starts as there are whose drives share no step, in place of that
  double travel = 20;  ///< [m] driven after a start, and again after a kidnapping
  bool kidnap = false;
  bool odometry = true;  ///< false: the log's is left out, and scans alone tell
  bool foreign = false;
  std::vector<std::string> methods = {"signature", "mcl"};
  AccuracyGates gates;
  RelocationMethodOptions method;
  std::uint32_t threads = 1;  ///< runs at a time
  std::size_t keep_failures = 0;  ///< how many failed runs of each method the report keeps
  std::string command;
  ShowProgress progress;
};

/// One step of a run, judged.
struct WakeupStep
{
  std::size_t step = 0;  ///< of the log
  double travelled = 0;  ///< [m] since the start
  double seconds = std::numeric_limits<double>::quiet_NaN();  ///< since the start, as the log tells
  bool kidnapped = false;  ///< the robot has been carried
  bool saw_nothing = false;  ///< fewer than 10 valid beams, and no landmark
  TrackingClaim claim;
  PoseError error;  ///< NaN without truth
  double nees = std::numeric_limits<double>::quiet_NaN();  ///< see squaredNormalisedError
  bool tracked = false;  ///< one of the heaviest hypotheses is right
  bool mapped = true;  ///< the truth lies within 1 m of a mapped pose, or the map has no poses
  Claim judged = Claim::none;
  double time_ms = 0;
};

/// How far into a drive something came about.
struct WakeupEvent
{
  double metres = 0;
  double seconds = std::numeric_limits<double>::quiet_NaN();  ///< NaN where the log has no times
};

/// One wake-up, judged. What is counted from the start is, after a kidnapping, counted from there.
struct Wakeup
{
  std::size_t start = 0;  ///< step of the log; of a simulation, the number of the drive
  std::string group;  ///< kind of the simulated world, or empty
  std::vector<WakeupStep> steps;
  std::size_t kidnapped_at = 0;  ///< index into steps; 0: not kidnapped
  bool right_at_end = false;  ///< at the last mapped step with truth
  /// Confident from there on where mapped, and not before a kidnapping was noticed; none: never.
  std::optional<WakeupEvent> settled_after;
  double cpu_to_settled = 0;  ///< [s]; all that was spent when it never settles
  std::size_t wrong_steps = 0;  ///< off the mapped area too
  std::size_t wrong_mapped_steps = 0;  ///< of them, those on it
  std::size_t wrong_episodes = 0;
  /// After a kidnapping the first step that is not sure of a wrong place; none: never.
  std::optional<WakeupEvent> noticed_after;
};

/// What results.csv holds of a step, after the method's name and the run's start.
const Columns<WakeupStep>& stepColumns();

/// What runs.csv holds of a run, after the method's name.
const Columns<Wakeup>& runColumns();

/// Fills the judgements from the steps.
void judgeRun(Wakeup& run);

struct WakeupMethodReport
{
  std::string name;
  std::vector<Wakeup> runs;
  double peak_rss_mb = 0;
  std::vector<FailedQuery> failures;  ///< the first ones, see isFailedRun
};

struct WakeupReport
{
  std::vector<WakeupMethodReport> methods;
  MapStatistics map;
  std::shared_ptr<const FeatureMap> features;  ///< the map itself, where there is one
  bool complete = true;
  bool foreign = false;
  AccuracyGates gates;  ///< that the claims were judged by
  Provenance provenance;
};

/// True when a run made a wrong claim, or, where there is truth, was not right at its end.
bool isFailedRun(const Wakeup& run);

/// Index of the last mapped step with truth, at which a run is judged; none in a foreign map.
std::optional<std::size_t> judgedStep(const Wakeup& run);

/// Throws std::invalid_argument for options that make no sense and std::runtime_error
/// ("path: reason") for a file that cannot be used.
WakeupReport runWakeups(const WakeupOptions& options);

/// Writes summary.json, results.csv (a row a step), runs.csv (a row a run) and report.md into a
/// folder.
void writeWakeupReport(const WakeupReport& report, const std::filesystem::path& folder);

std::string wakeupTable(const WakeupReport& report);
}  // namespace sigloc

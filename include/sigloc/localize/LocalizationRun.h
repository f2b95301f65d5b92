// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sigloc/features/ObservedScene.h"
#include "sigloc/io/RawlogReader.h"
#include "sigloc/localize/LocalizationSetup.h"
#include "sigloc/tracking/Belief.h"

namespace sigloc
{
/// One step of a run: what is believed after it, how it compares with the truth, what it cost.
struct StepRecord
{
  std::size_t number = 0;  ///< counted from 1
  std::size_t entry = 0;  ///< RawlogStep::entry
  double time = 0;  ///< [s]
  double travelled = 0;  ///< [m] by odometry, up to and with this step
  bool travel_known = true;  ///< false where odometry has told of no motion yet
  mrpt::math::TPose2D odometry;  ///< dead reckoning from LocalizationSetup::initial_odometry
  Belief belief;
  std::vector<Feature> features;  ///< seen in this step, in the robot frame
  std::vector<mrpt::math::TPoint2Df> returns;  ///< some of the scan's, evenly chosen, robot frame
  bool relocated = false;
  std::optional<mrpt::math::TPose2D> truth;
  std::optional<PoseError> error;  ///< of the first hypothesis
  bool any_right = false;  ///< some hypothesis lies within 0.5 m and 10 degrees of the truth
  bool confidently_wrong = false;  ///< localized, and more than 1 m or 20 degrees off
  double extraction_ms = 0;  ///< by the clock: features from scans
  double tracking_ms = 0;  ///< by the clock: the tracker's step with its relocation, if any
};

/// Times of some steps [ms], extraction included; 0 for none.
struct StepTimes
{
  std::size_t steps = 0;
  double median = 0;
  double p95 = 0;
};

/// How the poses of localized steps moved, against what odometry says.
struct OdometryMatch
{
  double turn = 0;  ///< [rad] to the left of odometry's direction; a mount's yaw too large by it
  double stretch = 1;  ///< metres a metre of odometry
};

/// What a run comes to; the figures of `summary.json`.
struct RunSummary
{
  std::size_t steps = 0;
  double distance = 0;  ///< [m], NaN for a log without odometry
  std::optional<std::size_t> steps_to_first_right;  ///< none where the path's truth is unknown
  std::optional<double> metres_to_first_right;  ///< none without odometry, too
  std::optional<std::size_t> steps_to_localized;
  std::optional<double> metres_to_localized;
  std::optional<PoseError> final_error;  ///< at the last step that has a truth
  Verdict final_verdict = Verdict::too_little_seen;
  std::optional<mrpt::math::TPose2D> final_pose;
  double final_probability = 0;  ///< of the first pose at the end
  std::string final_reason;  ///< of the last step's verdict
  std::size_t localized_steps = 0;
  std::optional<double> localized_metres;  ///< driven to these steps; none without odometry
  std::size_t times_lost = 0;  ///< how often a localized step was followed by one that is not
  std::optional<OdometryMatch> odometry;  ///< none with less than 2 m of both
  std::optional<bool> converged;  ///< at the step where that was to be tested; none: not tested
  std::optional<std::size_t> confidently_wrong_steps;  ///< none where the path's truth is unknown
  StepTimes relocation;  ///< of the steps that relocated
  StepTimes tracking;  ///< of the others
  bool map_reused = false;  ///< loaded from the cache
  double map_seconds = 0;  ///< to build the map, or to load it
  LeftOutOfLog left_out;
  std::string nothing_seen;  ///< why no step shows anything that the map could explain, or empty
  bool truncated = false;  ///< the log broke off: everything covers what was read
};

/// Localizes the robot of one rawlog in one map, step by step.
///
///     LocalizationRun run(setup);
///     while (const StepRecord* step = run.next()) show(*step, run.scene());
///     report(run.summary());
class LocalizationRun
{
 public:
  /// Opens the log, builds or reuses the map. `map_cache` is the `.sigmap` to reuse and rewrite;
  /// empty: none. `progress` is called while the map is built. Throws std::runtime_error naming the
  /// file and the reason for anything unusable, before anything is written.
  explicit LocalizationRun(const LocalizationSetup& setup,
                           const std::filesystem::path& map_cache = {},
                           const MapProgress& progress = {});
  ~LocalizationRun();

  /// Advances one step; null at the end of the log. The pointer holds until the next call.
  const StepRecord* next();

  const LocalizationSetup& setup() const { return setup_; }
  const FeatureMap& map() const { return *map_; }
  /// A pose anywhere in the map: what "somewhere else" means where poses are written.
  const GaussianPose& anywhere() const { return anywhere_; }
  /// What the robot saw in the last step.
  const ObservedScene& scene() const { return scene_; }
  const std::vector<StepRecord>& steps() const { return steps_; }
  /// Share of the log read so far, in [0, 1].
  double progress() const;
  /// True when the log has no further step.
  bool atEnd() const;
  RunSummary summary() const;

 private:
  struct State;
  StepRecord deadReckoned(const RawlogStep& input) const;
  void extract(const RawlogStep& input, StepRecord& step);
  void track(const RawlogStep& input, StepRecord& step);
  void score(StepRecord& step) const;
  std::string whyNothingSeen() const;
  LocalizationSetup setup_;
  std::shared_ptr<const FeatureMap> map_;
  GaussianPose anywhere_;
  std::unique_ptr<State> state_;
  ObservedScene scene_;
  std::vector<StepRecord> steps_;
};
}  // namespace sigloc

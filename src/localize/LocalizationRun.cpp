// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/localize/LocalizationRun.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "features/SeenReturns.h"
#include "geometry/plane_products.h"
#include "io/GroundTruth.h"
#include "localize/particle_library.h"
#include "localize/quantile.h"
#include "sigloc/io/map_files.h"
#include "sigloc/plugin/pose_pdf.h"
#include "sigloc/plugin/SignatureMap.h"
#include "sigloc/tracking/HypothesisTracker.h"

namespace sigloc
{
namespace
{
namespace fs = std::filesystem;
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

class Stopwatch
{
 public:
  double milliseconds() const
  {
    const auto elapsed = std::chrono::steady_clock::now() - start_;
    return std::chrono::duration<double, std::milli>(elapsed).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

StepTimes timesOf(std::vector<double> values)
{
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  return {values.size(), detail::quantileOf(values, 0.5), detail::quantileOf(values, 0.95)};
}

/// Reads up to the first step that counts, so that a log without any fails before the map is built.
RawlogStep firstStep(RawlogReader& reader, const LocalizationSetup& setup)
{
  for (std::uint32_t skipped = 0;; ++skipped)
  {
    auto step = reader.next();
    if (!step)
    {
      const std::string held = reader.contents();
      throw std::runtime_error(
          setup.rawlog_file.string() +
          (skipped > 0 ? ": fewer steps than rawlog_offset skips"
                       : std::string(": no usable laser scan in it") +
                             (reader.truncated() ? ", up to where it is cut off or damaged" : "") +
                             (held.empty() ? "" : "; it holds " + held)));
    }
    if (skipped == setup.rawlog_offset) return std::move(*step);
  }
}

CachedMap makeMap(const LocalizationSetup& setup, const fs::path& cache,
                  const MapProgress& progress)
{
  CachedMap made;
  const bool ready = setup.map_file.extension() == ".sigmap";
  if (cache.empty() || ready)
  {
    const Stopwatch watch;
    made.map = buildMapFromFile(setup.map_file, setup.map, setup.features, progress, setup.reading);
    made.build_seconds = watch.milliseconds() / 1000;
  }
  else
  {
    made = mapWithCache(setup.map_file, cache, setup.map, setup.features, progress, setup.reading);
  }
  return made;
}

/// What a page shows of a scan. A run keeps it of every step.
std::vector<mrpt::math::TPoint2Df> someReturns(const std::vector<BeamEnd>& beams)
{
  constexpr std::size_t kMost = 100;
  const std::size_t every = 1 + beams.size() / (kMost + 1);
  std::vector<mrpt::math::TPoint2Df> returns;
  for (std::size_t i = 0; i < beams.size(); i += every) returns.emplace_back(beams[i].point);
  return returns;
}

std::optional<double> travelOf(const StepRecord& step)
{
  return step.travel_known ? std::optional(step.travelled) : std::nullopt;
}

bool isLocalized(const StepRecord& step)
{
  return step.belief.verdict == Verdict::localized;
}

/// When the robot was localized first, for how much of the drive, and how often that was lost.
void countLocalized(const std::vector<StepRecord>& steps, RunSummary& summary)
{
  double metres = 0;
  for (std::size_t i = 0; i < steps.size(); ++i)
  {
    const bool was_localized = i > 0 && isLocalized(steps[i - 1]);
    if (isLocalized(steps[i]))
    {
      if (++summary.localized_steps == 1)
      {
        summary.steps_to_localized = steps[i].number;
        summary.metres_to_localized = travelOf(steps[i]);
      }
      if (i > 0) metres += steps[i].travelled - steps[i - 1].travelled;
    }
    else if (was_localized)
    {
      ++summary.times_lost;
    }
  }
  if (!steps.empty() && steps.back().travel_known) summary.localized_metres = metres;
}

/// When a hypothesis was right first, and how often a claim was wrong, where the path is known.
void compareWithTruth(const std::vector<StepRecord>& steps, RunSummary& summary)
{
  summary.confidently_wrong_steps = static_cast<std::size_t>(
      std::count_if(steps.begin(), steps.end(), std::mem_fn(&StepRecord::confidently_wrong)));
  const auto first = std::find_if(steps.begin(), steps.end(), std::mem_fn(&StepRecord::any_right));
  if (first == steps.end()) return;
  summary.steps_to_first_right = first->number;
  summary.metres_to_first_right = travelOf(*first);
}

void addTimes(const std::vector<StepRecord>& steps, RunSummary& summary)
{
  std::vector<double> relocation;
  std::vector<double> tracking;
  for (const StepRecord& step : steps)
    (step.relocated ? relocation : tracking).push_back(step.extraction_ms + step.tracking_ms);
  summary.relocation = timesOf(relocation);
  summary.tracking = timesOf(tracking);
}

void addEnd(const std::vector<StepRecord>& steps, RunSummary& summary)
{
  if (steps.empty()) return;
  const auto judged = std::find_if(steps.rbegin(), steps.rend(),
                                   [](const StepRecord& step) { return step.truth.has_value(); });
  if (judged != steps.rend()) summary.final_error = judged->error;
  const StepRecord& last = steps.back();
  summary.distance = travelOf(last).value_or(std::numeric_limits<double>::quiet_NaN());
  summary.final_verdict = last.belief.verdict;
  summary.final_probability = last.belief.probabilityOfFirst();
  summary.final_reason = last.belief.reason;
  if (!last.belief.hypotheses.empty())
    summary.final_pose = last.belief.hypotheses.front().pose.mean;
}

TPoint2D drivenBetween(const TPose2D& from, const TPose2D& to)
{
  const TPose2D motion = to - from;
  return {motion.x, motion.y};
}

/// Compares how the poses of localized steps moved with what odometry says, in the robot's frame.
/// None where both are known for less than 2 m.
std::optional<OdometryMatch> matchOfOdometry(const std::vector<StepRecord>& steps)
{
  constexpr double kLeastWay = 2.0;  // [m], below which noise decides
  double way = 0;
  double squares = 0;
  double along = 0;
  double across = 0;
  for (std::size_t i = 1; i < steps.size(); ++i)
  {
    if (!isLocalized(steps[i - 1]) || !isLocalized(steps[i])) continue;
    if (!steps[i - 1].travel_known || !steps[i].travel_known) continue;
    const TrackedHypothesis& before = steps[i - 1].belief.hypotheses.front();
    const TrackedHypothesis& after = steps[i].belief.hypotheses.front();
    if (before.id != after.id) continue;
    const TPoint2D told = drivenBetween(steps[i - 1].odometry, steps[i].odometry);
    const TPoint2D found = drivenBetween(before.pose.mean, after.pose.mean);
    way += told.norm();
    squares += dot(told, told);
    along += dot(told, found);
    across += cross(told, found);
  }
  if (way < kLeastWay) return std::nullopt;
  return OdometryMatch{std::atan2(across, along), std::hypot(along, across) / squares};
}

using SeenTypes = std::array<bool, kFeatureTypes>;

/// Returns why a log in which all that was seen is too little shows nothing that its map could
/// explain. Empty where it does.
std::string whyUnusable(const SeenReturns& returns, const SeenTypes& seen, const FeatureMap& map)
{
  if (map.field())
    return returns.anyScan() ? "" : "no laser scan in it; a map of walls takes nothing else";
  const bool shared = std::any_of(map.features().begin(), map.features().end(),
                                  [&](const Feature& f) { return seen[typeIndex(f.type)]; });
  return shared ? "" : "it shows no feature of a type that the map has";
}

/// pf-localization's test: one pose, not far from the truth.
bool hasConverged(const StepRecord& step)
{
  constexpr double kConvergedVolume = 2;  // sqrt of the covariance's determinant
  constexpr double kConvergedDistance = 2;  // [m]
  if (!step.truth || step.belief.hypotheses.empty()) return false;
  const GaussianPose pose = momentsOf(step.belief);
  return std::sqrt(std::max(0.0, pose.covariance.det())) < kConvergedVolume &&
         errorBetween(pose.mean, *step.truth).distance < kConvergedDistance;
}
}  // namespace

struct LocalizationRun::State
{
  explicit State(const LocalizationSetup& setup)
      : reader(setup.rawlog_file, setup.reading), pending(firstStep(reader, setup))
  {
    if (!setup.ground_truth_file.empty())
    {
      truth = GroundTruth::read(setup.ground_truth_file, setup.mapFromTruth());
    }
  }

  RawlogReader reader;
  std::optional<RawlogStep> pending;  // read, not yet taken; none at the end
  std::optional<GroundTruth> truth;
  std::unique_ptr<HypothesisTracker> tracker;  // the one or
  std::unique_ptr<LogTracker> particles;  // the other
  SeenReturns returns;
  SeenTypes seen_types{};
  bool map_reused = false;
  double map_seconds = 0;
};

LocalizationRun::LocalizationRun(const LocalizationSetup& setup, const fs::path& map_cache,
                                 const MapProgress& progress)
    : setup_(setup), state_(std::make_unique<State>(setup_))
{
  CachedMap made = makeMap(setup_, map_cache, progress);
  map_ = std::make_shared<const FeatureMap>(std::move(made.map));
  anywhere_ = anywhereIn(boundsOf(*map_));
  state_->map_reused = made.reused;
  state_->map_seconds = made.build_seconds;
  const auto matcher = std::make_shared<const SignatureMatcher>(map_, setup_.matcher);
  if (setup_.use_particles)
  {
    const auto map = std::make_shared<const SignatureMap>(FeatureMap(*map_));
    state_->particles = loadParticleTracker(
        {map, matcher, setup_.tracker, setup_.particles, setup_.matcher.seed, setup_.features});
    state_->particles->reset(setup_.prior);
    return;
  }
  state_->tracker = std::make_unique<HypothesisTracker>(matcher, setup_.tracker);
  state_->tracker->reset(setup_.prior);
}

LocalizationRun::~LocalizationRun() = default;

const StepRecord* LocalizationRun::next()
{
  if (!state_->pending) return nullptr;
  RawlogStep input = std::move(*state_->pending);
  const std::size_t index = setup_.rawlog_offset + steps_.size();
  // One ahead: the last step may have a truth of its own.
  state_->pending = setup_.convergence_test_step == index ? std::nullopt : state_->reader.next();
  // How the robot came to the first step is motion in another run.
  if (steps_.empty()) input.motion.reset();

  StepRecord step = deadReckoned(input);
  extract(input, step);
  track(input, step);
  const bool last = !state_->pending && !state_->reader.truncated();
  if (state_->truth) step.truth = state_->truth->at(index, step.time);
  if (last && setup_.finalTruth()) step.truth = setup_.finalTruth();
  score(step);
  steps_.push_back(std::move(step));
  return &steps_.back();
}

/// Begins the record of a step: its place in the log, and what odometry tells.
StepRecord LocalizationRun::deadReckoned(const RawlogStep& input) const
{
  StepRecord step;
  step.number = steps_.size() + 1;
  step.entry = input.entry;
  step.time = input.time;
  step.odometry = setup_.initial_odometry;
  if (steps_.empty()) return step;
  const StepRecord& before = steps_.back();
  step.travel_known = input.motion || (steps_.size() > 1 && before.travel_known);
  step.travelled = before.travelled;
  step.odometry = before.odometry;
  if (input.motion)
  {
    step.travelled += input.motion->mean.norm();
    step.odometry = step.odometry + input.motion->mean;
  }
  return step;
}

void LocalizationRun::extract(const RawlogStep& input, StepRecord& step)
{
  for (const LaserScan& scan : input.scans) state_->returns.add(scan);
  const Stopwatch watch;
  scene_ = observe(input, setup_.features);
  step.extraction_ms = watch.milliseconds();
  step.features = scene_.features;
  for (const Feature& feature : step.features) state_->seen_types[typeIndex(feature.type)] = true;
  step.returns = someReturns(scene_.beams);
}

void LocalizationRun::track(const RawlogStep& input, StepRecord& step)
{
  const Stopwatch watch;
  if (state_->particles)
  {
    step.belief = state_->particles->step(input);
    step.relocated = state_->particles->relocated();
  }
  else
  {
    step.belief = state_->tracker->step(input.motion, scene_);
    step.relocated = state_->tracker->relocated();
  }
  step.tracking_ms = watch.milliseconds();
}

void LocalizationRun::score(StepRecord& step) const
{
  if (!step.truth || step.belief.hypotheses.empty()) return;
  step.error = errorBetween(step.belief.hypotheses.front().pose.mean, *step.truth);
  step.confidently_wrong = isLocalized(step) && isWrong(*step.error);
  step.any_right = std::any_of(step.belief.hypotheses.begin(), step.belief.hypotheses.end(),
                               [&](const TrackedHypothesis& hypothesis) {
                                 return isRight(errorBetween(hypothesis.pose.mean, *step.truth));
                               });
}

double LocalizationRun::progress() const
{
  return state_->reader.progress();
}

std::string LocalizationRun::whyNothingSeen() const
{
  if (steps_.size() < 2) return {};  // A single scan may see nothing by chance.
  if (state_->returns.none()) return state_->returns.whyNone();
  const bool little = std::all_of(steps_.begin(), steps_.end(),
                                  [](const StepRecord& step)
                                  { return step.belief.verdict == Verdict::too_little_seen; });
  return little ? whyUnusable(state_->returns, state_->seen_types, *map_) : std::string();
}

bool LocalizationRun::atEnd() const
{
  return !state_->pending;
}

RunSummary LocalizationRun::summary() const
{
  RunSummary summary;
  summary.map_reused = state_->map_reused;
  summary.map_seconds = state_->map_seconds;
  summary.left_out = state_->reader.leftOut();
  summary.nothing_seen = whyNothingSeen();
  summary.truncated = state_->reader.truncated();
  summary.steps = steps_.size();
  countLocalized(steps_, summary);
  summary.odometry = matchOfOdometry(steps_);
  if (state_->truth) compareWithTruth(steps_, summary);
  addTimes(steps_, summary);
  addEnd(steps_, summary);
  const std::size_t next = setup_.rawlog_offset + steps_.size();
  if (!steps_.empty() && setup_.convergence_test_step == next - 1)
    summary.converged = hasConverged(steps_.back());
  return summary;
}
}  // namespace sigloc

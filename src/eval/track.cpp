// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/eval/track.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <stdexcept>

#include "sigloc/bridge/GroundTruth.h"
#include "sigloc/bridge/map_sources.h"
#include "sigloc/eval/cpu_time.h"
#include "sigloc/eval/run_parallel.h"
#include "track_drive.h"

namespace sigloc
{
namespace
{
using detail::TrackDrive;
using detail::TrackDriveStep;
using detail::TrackLeg;
using mrpt::math::TPose2D;

TrackDrive readDrive(const TrackOptions& options, const std::vector<TPose2D>& mapped_poses)
{
  const auto truth = GroundTruth::read(options.ground_truth, options.map_from_truth);
  std::optional<GroundTruth> start_frames;
  if (!options.start_from.empty()) start_frames = GroundTruth::read(options.start_from);
  constexpr double kSameScan = 0.5;  // [s] between the log's scan and the key frame
  RawlogReader reader(options.rawlog);
  TrackDrive drive;
  std::optional<TPose2D> last;
  double travelled = 0;
  for (std::size_t i = 0; auto step = reader.next(); ++i)
  {
    if (step->scans.empty()) continue;
    TrackDriveStep out;
    out.truth = truth.at(i, step->time);
    if (out.truth && last) travelled += std::hypot(out.truth->x - last->x, out.truth->y - last->y);
    if (out.truth) last = out.truth;
    out.travelled = travelled;
    out.mapped = !out.truth || detail::isMapped(*out.truth, mapped_poses);
    out.may_start = out.truth.has_value() &&
                    (!start_frames || start_frames->at(i, step->time, kSameScan).has_value());
    out.step = std::move(*step);
    drive.steps.push_back(std::move(out));
  }
  drive.complete = !reader.truncated();
  return drive;
}

detail::LoggedDrive readLog(const TrackOptions& options)
{
  if (!options.landmarks.empty())
  {
    return detail::readLandmarkDrive(options.landmarks, options.landmark_folder);
  }
  detail::LoggedDrive log;
  log.map = readEvaluationMap(options.map);
  log.drive = readDrive(options, log.map.mapped_poses);
  log.files = {options.map, options.rawlog, options.ground_truth};
  if (!options.start_from.empty()) log.files.push_back(options.start_from);
  return log;
}

// Summed in another order, the same way has another last digit.
constexpr double kRounding = 1e-6;  // [m]

constexpr double kLongestStep = 1.0;  // [m] that the way between two allowed starts counts at most

// Places equally spaced in the distance travelled, so that no luck is chosen. Where the log leaves
// the places that are allowed, the way counts no more: else the last place before would be asked
// again and again.
std::vector<std::size_t> startsOf(const TrackDrive& drive, const TrackOptions& options)
{
  std::vector<std::size_t> allowed;
  const double last = drive.steps.empty() ? 0 : drive.steps.back().travelled - options.travel;
  for (std::size_t i = 0; i < drive.steps.size(); ++i)
  {
    if (drive.steps[i].may_start && drive.steps[i].travelled <= last + kRounding)
    {
      allowed.push_back(i);
    }
  }
  if (allowed.empty())
  {
    const auto& path = options.landmarks.empty() ? options.rawlog : options.landmark_folder;
    throw std::runtime_error(path.string() + ": no step with truth has " +
                             std::to_string(options.travel) + " m of drive after it");
  }
  std::vector<double> way = {0};
  for (std::size_t k = 1; k < allowed.size(); ++k)
  {
    const double step = drive.steps[allowed[k]].travelled - drive.steps[allowed[k - 1]].travelled;
    way.push_back(way.back() + std::min(step, kLongestStep));
  }
  std::vector<std::size_t> starts;
  for (std::uint32_t k = 0; k < options.starts; ++k)
  {
    const double wanted = way.back() * k / std::max(1U, options.starts - 1);
    const auto nearest = std::min_element(way.begin(), way.end(),
                                          [&](double a, double b)
                                          { return std::abs(a - wanted) < std::abs(b - wanted); });
    starts.push_back(allowed[static_cast<std::size_t>(nearest - way.begin())]);
  }
  return starts;
}

TrackLeg legFrom(const TrackDrive& drive, std::size_t start, double travel)
{
  std::size_t last = start;
  while (last < drive.steps.size() &&
         drive.steps[last].travelled - drive.steps[start].travelled <= travel + kRounding)
  {
    ++last;
  }
  return {&drive, start, last};
}

/// One wake-up; with `kidnap` carried half-way to the start half the list away.
TrackRun runOnce(const TrackingMethodFactory& factory, const TrackDrive& drive,
                 const std::vector<std::size_t>& starts, std::size_t which,
                 const TrackOptions& options)
{
  std::vector<TrackLeg> legs = {legFrom(drive, starts[which], options.travel)};
  if (options.kidnap)
  {
    const std::size_t elsewhere = starts[(which + starts.size() / 2) % starts.size()];
    legs.push_back(legFrom(drive, elsewhere, options.travel));
  }
  const std::uint32_t seed =
      options.method.seed * 1000003U + static_cast<std::uint32_t>(starts[which]);
  return detail::runLegs(factory, legs, seed, options.gates);
}
}  // namespace

void judgeRun(TrackRun& run)
{
  const auto& steps = run.steps;
  std::size_t settled = steps.size();
  while (settled > 0 && (steps[settled - 1].claim.confident || !steps[settled - 1].mapped))
  {
    --settled;
  }
  if (settled < steps.size())
  {
    run.settled_after =
        steps[settled].travelled - (run.kidnapped_at > 0 && settled >= run.kidnapped_at
                                        ? steps[run.kidnapped_at].travelled
                                        : 0);
  }
  run.cpu_to_settled = 0;
  for (std::size_t i = 0; i < steps.size(); ++i)
  {
    if (i <= settled) run.cpu_to_settled += 1e-3 * steps[i].time_ms;
    if (steps[i].judged != Claim::wrong) continue;
    ++run.wrong_steps;
    if (i == 0 || steps[i - 1].judged != Claim::wrong) ++run.wrong_episodes;
  }
  const auto last_with_truth = std::find_if(steps.rbegin(), steps.rend(),
                                            [](const TrackStepRecord& s)
                                            { return s.mapped && !std::isnan(s.error.distance); });
  run.right_at_end = last_with_truth != steps.rend() && last_with_truth->judged == Claim::right;
  if (run.kidnapped_at == 0) return;
  for (std::size_t i = run.kidnapped_at; i < steps.size() && !run.noticed_after; ++i)
  {
    if (steps[i].claim.confident && steps[i].judged != Claim::right) continue;
    run.noticed_after = steps[i].travelled - steps[run.kidnapped_at].travelled;
  }
}

TrackReport runTrack(const TrackOptions& options)
{
  if (options.starts == 0) throw std::invalid_argument("--starts must be at least 1");
  if (!(options.travel >= 0 && std::isfinite(options.travel)))
  {
    throw std::invalid_argument("--travel must be a length of at least 0 m");
  }
  checkTrackingMethods(options.methods);
  const detail::LoggedDrive log = readLog(options);
  const auto& [map, drive, files] = log;
  const std::vector<std::size_t> starts = startsOf(drive, options);
  TrackReport report;
  report.map_features = map.features->features().size();
  report.map_build_seconds = map.build_seconds;
  report.complete = drive.complete;
  report.provenance = {options.command, options.method.seed, files};
  for (const std::string& name : options.methods)
  {
    resetPeakMemory();
    const auto factory = makeTrackingMethod(name, log.map, options.method);
    TrackMethodReport method{name, std::vector<TrackRun>(starts.size()), 0};
    std::atomic<std::size_t> done{0};
    std::mutex mutex;
    runParallel(starts.size(), options.threads,
                [&](std::size_t i)
                {
                  method.runs[i] = runOnce(*factory, log.drive, starts, i, options);
                  const double share =
                      static_cast<double>(++done) / static_cast<double>(starts.size());
                  const std::lock_guard<std::mutex> lock(mutex);
                  if (options.progress) options.progress(name, share);
                });
    method.peak_rss_mb = peakMemoryMb();
    report.methods.push_back(std::move(method));
  }
  return report;
}
}  // namespace sigloc

// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/wakeup/wakeup.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "eval/process/cpu_time.h"
#include "eval/wakeup/wakeup_drive.h"
#include "sigloc/config/plural.h"

namespace sigloc
{
namespace
{
using detail::WakeupDrive;
using detail::WakeupDriveStep;
using detail::WakeupLeg;
// Summed in another order, the same distance may differ in its last digit.
constexpr double kRounding = 1e-6;  // [m]

constexpr double kLongestStep = 1.0;  // [m] longest distance counted between two allowed starts

/// A step that the robot may wake up at, and its distance along the allowed steps.
struct Place
{
  std::size_t step;
  double way;  // [m]
};

// Where the log leaves the allowed area, the distance does not count. Else the last pose before
// would be chosen again and again. A robot that stands still has one pose only.
std::vector<Place> placesOf(const WakeupDrive& drive, double travel)
{
  std::vector<Place> places;
  const double last = drive.steps.empty() ? 0 : drive.steps.back().travelled - travel;
  double way = 0;
  double before = 0;
  for (std::size_t i = 0; i < drive.steps.size(); ++i)
  {
    const WakeupDriveStep& step = drive.steps[i];
    if (!step.may_start || step.travelled > last + kRounding) continue;
    if (!places.empty()) way += std::min(step.travelled - before, kLongestStep);
    before = step.travelled;
    if (places.empty() || way > places.back().way) places.push_back({i, way});
  }
  return places;
}

// Equally spaced in the distance travelled, so that the choice favours no method. No step is chosen
// twice, because a repeated query gives no new result.
std::vector<std::size_t> spacedStarts(const std::vector<Place>& places, std::size_t count)
{
  std::vector<std::size_t> starts;
  std::size_t next = 0;
  for (std::size_t k = 0; k < count; ++k)
  {
    const double wanted = places.back().way * static_cast<double>(k) /
                          static_cast<double>(std::max<std::size_t>(1, count - 1));
    const auto nearer = [&](const Place& a, const Place& b)
    { return std::abs(a.way - wanted) < std::abs(b.way - wanted); };
    // Enough steps remain for the next starts.
    const auto first = places.begin() + static_cast<std::ptrdiff_t>(next);
    const auto end = places.end() - static_cast<std::ptrdiff_t>(count - 1 - k);
    const auto chosen = std::min_element(first, end, nearer);
    starts.push_back(chosen->step);
    next = static_cast<std::size_t>(chosen - places.begin()) + 1;
  }
  return starts;
}

WakeupLeg legFrom(const WakeupDrive& drive, std::size_t start, double travel)
{
  std::size_t last = start;
  while (last < drive.steps.size() &&
         drive.steps[last].travelled - drive.steps[start].travelled <= travel + kRounding)
  {
    ++last;
  }
  return {&drive, start, last};
}

// The earliest allowed start, then the earliest behind its drive, and so on: no method is favoured.
std::vector<std::size_t> startsApart(const WakeupDrive& drive, const std::vector<Place>& places,
                                     double travel)
{
  std::vector<std::size_t> starts;
  std::size_t free_from = 0;
  for (const Place& place : places)
  {
    if (place.step < free_from) continue;
    starts.push_back(place.step);
    free_from = legFrom(drive, place.step, travel).last;
  }
  return starts;
}

std::vector<std::size_t> startsOf(const WakeupDrive& drive, const WakeupOptions& options)
{
  const std::vector<Place> places = placesOf(drive, options.travel);
  const auto& path = !options.landmarks.empty() ? options.landmark_folder
                     : options.rawlog.empty()   ? options.frames
                                                : options.rawlog;
  const std::string after = fmt::format("{:.1f} m of drive after it", options.travel);
  if (places.empty())
  {
    throw std::runtime_error(fmt::format("{}: no step{} has {}", path.string(),
                                         options.foreign ? "" : " with truth", after));
  }
  if (options.apart) return startsApart(drive, places, options.travel);
  if (options.starts > places.size())
  {
    throw std::runtime_error(fmt::format("--starts {}: {} has only {} with {}", options.starts,
                                         path.string(), counted(places.size(), "place"), after));
  }
  return spacedStarts(places, options.starts);
}

/// The legs of one wake-up. With `kidnap`, half-way the robot is carried to the start half the list
/// away.
std::vector<WakeupLeg> legsOf(const WakeupDrive& drive, const std::vector<std::size_t>& starts,
                              std::size_t which, const WakeupOptions& options)
{
  std::vector<WakeupLeg> legs = {legFrom(drive, starts[which], options.travel)};
  if (options.kidnap)
  {
    const std::size_t elsewhere = starts[(which + starts.size() / 2) % starts.size()];
    legs.push_back(legFrom(drive, elsewhere, options.travel));
  }
  return legs;
}

void check(const WakeupOptions& options)
{
  if (options.starts == 0) throw std::invalid_argument("--starts must be at least 1");
  if (!(options.travel >= 0 && std::isfinite(options.travel)))
  {
    throw std::invalid_argument("--travel must be a length of at least 0 m");
  }
  if (options.kidnap && options.starts < 2)
  {
    throw std::invalid_argument("--kidnap carries a robot to another start: --starts 2 or more");
  }
  if (options.kidnap && options.foreign)
  {
    throw std::invalid_argument("--kidnap: in a foreign map there is nothing to notice");
  }
  if (options.apart && options.kidnap)
  {
    throw std::invalid_argument("--apart: a kidnapped robot drives where another one wakes up");
  }
  checkTrackingMethods(options.methods);
  const bool filters = std::any_of(options.methods.begin(), options.methods.end(),
                                   [](const std::string& name) { return name != "signature"; });
  if (filters && !options.frames.empty() && options.rawlog.empty())
  {
    throw std::invalid_argument("--frames: MRPT's filter needs --rawlog, the log's observations");
  }
}

/// All wake-ups of one method, in the order of the starts.
WakeupMethodReport runMethod(const std::string& name, const detail::LoggedDrive& log,
                             const std::vector<std::size_t>& starts, const WakeupOptions& options)
{
  resetPeakMemory();
  const auto factory = makeTrackingMethod(name, log.map, options.method);
  WakeupMethodReport method;
  method.name = name;
  method.runs.resize(starts.size());
  const auto wake_up = [&](std::size_t i)
  {
    const std::uint32_t seed =
        options.method.seed * 1000003U + static_cast<std::uint32_t>(starts[i]);
    method.runs[i] =
        detail::runLegs(*factory, legsOf(log.drive, starts, i, options), seed, options.gates);
  };
  runParallel(starts.size(), options.threads, wake_up, name, options.progress);
  method.peak_rss_mb = peakMemoryMb();
  for (std::size_t i = 0; i < starts.size() && method.failures.size() < options.keep_failures; ++i)
  {
    if (!isFailedRun(method.runs[i])) continue;
    method.failures.push_back(detail::failureOf(
        method.runs[i], legsOf(log.drive, starts, i, options), name, log.map.features));
  }
  return method;
}
}  // namespace

WakeupReport runWakeups(const WakeupOptions& options)
{
  check(options);
  const detail::LoggedDrive log = detail::readLoggedDrive(options);
  const std::vector<std::size_t> starts = startsOf(log.drive, options);
  WakeupReport report;
  report.map.add(*log.map.features, log.map.build_seconds);
  report.features = log.map.features;
  report.complete = log.drive.complete;
  report.foreign = options.foreign;
  report.gates = options.gates;
  report.provenance = {options.command, options.method.seed, log.files};
  for (const std::string& name : options.methods)
  {
    report.methods.push_back(runMethod(name, log, starts, options));
  }
  return report;
}
}  // namespace sigloc

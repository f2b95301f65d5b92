// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/maps/CSimpleMap.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "eval/wakeup/wakeup_drive.h"
#include "eval/worlds/robot_simulation.h"
#include "io/archive/checked_archive.h"
#include "io/GroundTruth.h"
#include "io/key_frames.h"
#include "io/maps/map_source_readers.h"

namespace sigloc::detail
{
namespace
{
using mrpt::math::TPose2D;

/// A drive in another building than the map: any step may start, and distance is that of the
/// odometry.
WakeupDrive readForeignDrive(const std::filesystem::path& rawlog, const ReadingOptions& reading)
{
  RawlogReader reader(rawlog, reading);
  WakeupDrive drive;
  drive.foreign = true;
  double travelled = 0;
  while (auto step = reader.next())
  {
    if (step->motion) travelled += std::hypot(step->motion->mean.x, step->motion->mean.y);
    if (step->scans.empty()) continue;
    WakeupDriveStep out;
    out.travelled = travelled;
    out.may_start = true;
    out.step = std::move(*step);
    drive.steps.push_back(std::move(out));
  }
  drive.complete = !reader.truncated();
  return drive;
}

// Whether a step's time is earlier than that of a step before it. Then steps were delayed, and the
// truth of its time is that of another step. A time that is far earlier means that the clock was
// set anew.
bool isStampedLate(double time, double& latest)
{
  constexpr double kClockSet = 10.0;  // [s]
  const bool is_late = time < latest && latest - time < kClockSet;
  if (!is_late) latest = time;
  return is_late;
}

/// What of a log is of the drive: all that is not in [begin, end] of its clock [s].
struct MappedTime
{
  double begin = std::numeric_limits<double>::infinity();
  double end = -std::numeric_limits<double>::infinity();

  bool contains(double time) const { return time >= begin && time <= end; }
};

WakeupDrive readDrive(const WakeupOptions& options, const std::vector<TPose2D>& mapped_poses,
                      const MappedTime& mapped_time)
{
  const auto truth = GroundTruth::read(options.ground_truth, options.map_from_truth);
  std::optional<GroundTruth> start_frames;
  if (!options.start_from.empty()) start_frames = GroundTruth::read(options.start_from);
  constexpr double kSameScan = 0.5;  // [s] between the log's scan and the key frame
  RawlogReader reader(options.rawlog, options.reading);
  WakeupDrive drive;
  std::optional<TPose2D> last;
  double travelled = 0;
  double latest = 0;  // [s]
  for (std::size_t i = 0; auto step = reader.next(); ++i)
  {
    if (step->scans.empty() || mapped_time.contains(step->time)) continue;
    WakeupDriveStep out;
    if (!isStampedLate(step->time, latest)) out.truth = truth.at(i, step->time);
    if (out.truth && last) travelled += std::hypot(out.truth->x - last->x, out.truth->y - last->y);
    if (out.truth) last = out.truth;
    out.travelled = travelled;
    if (out.truth) out.mapped = isMapped(*out.truth, mapped_poses);
    out.may_start = out.truth.has_value() &&
                    (!start_frames || start_frames->at(i, step->time, kSameScan).has_value());
    out.step = std::move(*step);
    drive.steps.push_back(std::move(out));
  }
  markStepsWithoutTruth(drive.steps);
  drive.complete = !reader.truncated();
  return drive;
}

/// The key frames of a drive, cut into those of the map and the others, in the order driven.
struct CutFrames
{
  std::vector<PosedScans> mapped;
  std::vector<PosedScans> others;
  std::vector<double> other_times;  // [s], NaN where a key frame has none
  MappedTime mapped_time;
};

/// When each key frame was taken [s]; NaN where it does not tell. Throws where one has no usable
/// scan: then times and scans do not belong together.
std::vector<double> timesOfFrames(const std::filesystem::path& path, std::size_t usable)
{
  mrpt::maps::CSimpleMap simplemap;
  readObjectFile(path, simplemap);
  if (simplemap.size() != usable)
  {
    throw std::runtime_error(path.string() + ": a key frame has no usable scan");
  }
  std::vector<double> times;
  for (std::size_t i = 0; i < simplemap.size(); ++i)
  {
    const auto stamp = (*keyFrameOf(simplemap, i).frame->begin())->timestamp;
    times.push_back(stamp == INVALID_TIMESTAMP ? std::numeric_limits<double>::quiet_NaN()
                                               : mrpt::Clock::toDouble(stamp));
  }
  return times;
}

CutFrames readCutFrames(const WakeupOptions& options)
{
  constexpr double kMappedShare = 0.6;
  std::vector<PosedScans> frames = readSimplemap(options.frames, options.reading);
  const std::vector<double> times = timesOfFrames(options.frames, frames.size());
  const auto count =
      static_cast<std::size_t>(std::ceil(kMappedShare * static_cast<double>(frames.size())));
  const std::size_t first = options.reversed ? frames.size() - count : 0;
  CutFrames cut;
  for (std::size_t i = 0; i < frames.size(); ++i)
  {
    if (i < first || i >= first + count)
    {
      cut.others.push_back(std::move(frames[i]));
      cut.other_times.push_back(times[i]);
      continue;
    }
    cut.mapped.push_back(std::move(frames[i]));
    cut.mapped_time.begin = std::min(cut.mapped_time.begin, times[i]);
    cut.mapped_time.end = std::max(cut.mapped_time.end, times[i]);
  }
  if (cut.others.empty())
    throw std::runtime_error(options.frames.string() + ": one key frame only");
  return cut;
}

/// Key frames as a drive. Its odometry is made: the increments of their poses with noise.
WakeupDrive driveOf(const CutFrames& cut, const std::vector<TPose2D>& mapped_poses,
                    std::uint32_t seed)
{
  const std::vector<PosedScans>& frames = cut.others;
  // Worse than most robots': 5 % of the way, and 0.025 rad a metre and a radian.
  OdometryOptions noise;
  noise.a1 = 0.05;
  noise.a3 = noise.a4 = 0.025;
  std::vector<TPose2D> poses;
  poses.reserve(frames.size());
  for (const PosedScans& frame : frames) poses.push_back(frame.map_from_robot);
  const std::vector<MotionIncrement> odometry = simulateOdometry(poses, noise, seed);
  WakeupDrive drive;
  for (std::size_t i = 0; i < frames.size(); ++i)
  {
    WakeupDriveStep step;
    step.step.time = cut.other_times[i];
    step.step.motion = odometry[i];
    step.step.scans = frames[i].scans;
    step.truth = poses[i];
    step.mapped = isMapped(poses[i], mapped_poses);
    step.may_start = step.mapped;
    if (i > 0)
    {
      step.travelled = drive.steps.back().travelled +
                       std::hypot(poses[i].x - poses[i - 1].x, poses[i].y - poses[i - 1].y);
    }
    drive.steps.push_back(std::move(step));
  }
  return drive;
}

LoggedDrive readOwnFrames(const WakeupOptions& options)
{
  const CutFrames cut = readCutFrames(options);
  LoggedDrive log;
  log.map = evaluationMapFromScans(cut.mapped);
  if (log.map.features->empty())
  {
    throw std::runtime_error(options.frames.string() + ": no feature found in it");
  }
  log.files = {options.frames};
  if (options.rawlog.empty())
  {
    log.drive = driveOf(cut, log.map.mapped_poses, options.method.seed);
    return log;
  }
  if (cut.mapped_time.begin > cut.mapped_time.end)
  {
    throw std::runtime_error(options.frames.string() + ": its key frames have no times");
  }
  log.drive = readDrive(options, log.map.mapped_poses, cut.mapped_time);
  for (WakeupDriveStep& step : log.drive.steps) step.may_start = step.may_start && step.mapped;
  log.files.insert(log.files.end(), {options.rawlog, options.ground_truth});
  return log;
}

LoggedDrive readLog(const WakeupOptions& options)
{
  if (!options.landmarks.empty())
  {
    return readLandmarkDrive(options.landmarks, options.landmark_folder);
  }
  if (!options.frames.empty()) return readOwnFrames(options);
  LoggedDrive log;
  log.map = readEvaluationMap(options.map, options.reading);
  log.files = {options.map, options.rawlog};
  if (options.foreign)
  {
    log.drive = readForeignDrive(options.rawlog, options.reading);
    return log;
  }
  log.drive = readDrive(options, log.map.mapped_poses, {});
  log.files.push_back(options.ground_truth);
  if (!options.start_from.empty()) log.files.push_back(options.start_from);
  return log;
}
}  // namespace

LoggedDrive readLoggedDrive(const WakeupOptions& options)
{
  LoggedDrive log = readLog(options);
  if (options.odometry) return log;
  for (WakeupDriveStep& step : log.drive.steps)
  {
    step.step.motion.reset();
    step.step.actions.reset();
  }
  return log;
}
}  // namespace sigloc::detail

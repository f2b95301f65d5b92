// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/carmen_log.h"

#include <fmt/core.h>
#include <mrpt/system/string_utils.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "io/archive/gzip_input.h"
#include "io/scan_conversion.h"
#include "io/text_rows.h"

namespace sigloc::detail
{
namespace
{
constexpr double kDegree = M_PI / 180.0;
constexpr double kFlaserMaxRange = 80.0;  // [m], a SICK LMS; it writes 81.83 for "no return"
constexpr double kLatest = 1e10;  // [s] of a clock

/// The words of one message, taken front to back; a missing or bad one is an error of the line.
class Message
{
 public:
  Message(std::string_view line, const std::filesystem::path& path, std::size_t index)
      : words_(words(line)), path_(path), index_(index)
  {
  }

  std::string_view name() const { return words_.empty() ? std::string_view{} : words_.front(); }

  double number()
  {
    const std::string_view word = next();
    const auto value = toNumber(word);
    if (!value) failAtLine(path_, index_, "bad number " + quoted(word));
    return *value;
  }

  /// A range reading; 0 for "no return", which some logs write as nan or inf.
  double range()
  {
    const std::string_view word = next();
    const auto value = toNumber(word);
    if (!value && isNoReturn(word)) return 0;
    if (!value) failAtLine(path_, index_, "bad number " + quoted(word));
    if (*value < 0) failAtLine(path_, index_, "negative range " + quoted(word));
    return *value;
  }

  std::size_t count()
  {
    const double value = number();
    if (value < 0 || value > static_cast<double>(kMostBeams) || value != std::floor(value))
    {
      failAtLine(path_, index_, "bad count of readings");
    }
    return static_cast<std::size_t>(value);
  }

  void skip(std::size_t n) { next_ += n; }
  [[noreturn]] void fail(const std::string& reason) const { failAtLine(path_, index_, reason); }
  /// How many words have not been taken.
  std::size_t left() const { return words_.size() - std::min(next_, words_.size()); }

 private:
  static bool isNoReturn(std::string_view word)
  {
    const std::string text = mrpt::system::lowerCase(std::string(word));
    return text == "nan" || text == "-nan" || text == "inf";
  }

  std::string_view next()
  {
    if (next_ >= words_.size()) failAtLine(path_, index_, "cut off");
    return words_[next_++];
  }

  std::vector<std::string_view> words_;
  const std::filesystem::path& path_;
  std::size_t index_;
  std::size_t next_ = 1;
};

void readRanges(Message& message, std::size_t n, LaserScan& scan)
{
  scan.ranges.resize(n);
  scan.valid.resize(n);
  for (std::size_t i = 0; i < n; ++i)
  {
    const double range = message.range();
    const bool usable = range > 0 && range < scan.max_range;
    scan.ranges[i] = usable ? static_cast<float>(range) : 0.0F;
    scan.valid[i] = usable ? 1 : 0;
  }
}

mrpt::math::TPose2D readPose(Message& message)
{
  const double x = message.number();
  const double y = message.number();
  const double phi = message.number();
  constexpr double kMostTurn = 1e6;  // [rad]
  if (std::abs(phi) > kMostTurn) message.fail("heading that no robot has");
  return {x, y, std::remainder(phi, 2 * M_PI)};
}

/// Throws where more words are left than a message has behind its readings: their number is not the
/// one announced, or their decimals have commas.
void requireNoMore(const Message& message, std::size_t announced, std::size_t most)
{
  if (message.left() <= most) return;
  message.fail(fmt::format("{} readings are announced, and {} words too many follow", announced,
                           message.left() - most));
}

/// Odometry and time, where a message goes on: `skipped` words are between the two.
void readOdometry(Message& message, std::size_t skipped, CarmenScan& seen)
{
  constexpr std::size_t kPose = 3;
  if (message.left() < kPose + skipped + 1) return;
  seen.odometry = readPose(message);
  message.skip(skipped);
  const double time = message.number();
  if (time >= 0 && time < kLatest) seen.time = time;
}

/// Where the laser is on the robot; where it would be far off, the two poses are of two frames.
mrpt::math::TPose2D mountFrom(const mrpt::math::TPose2D& robot_from_laser)
{
  constexpr double kFarthest = 2.0;  // [m]
  const bool near = std::hypot(robot_from_laser.x, robot_from_laser.y) < kFarthest;
  return near ? robot_from_laser : mrpt::math::TPose2D();
}

CarmenScan readFlaser(Message& message)
{
  CarmenScan seen;
  LaserScan& scan = seen.scan;
  const std::size_t n = message.count();
  scan.max_range = kFlaserMaxRange;
  // The LMS's settings: 100 degrees in 0.25 or 0.5 degrees, else 180 degrees, of which an even
  // count leaves out the last beam.
  const double span = n == 401 || n == 201 ? 100.0 : 180.0;
  const auto steps = static_cast<double>(n % 2 == 0 ? n : n - 1);
  scan.first_angle = -0.5 * span * kDegree;
  scan.angle_step = span * kDegree / std::max(1.0, steps);
  readRanges(message, n, scan);
  requireNoMore(message, n, 9);  // two poses, time, host, time of logging
  seen.laser = readPose(message);
  readOdometry(message, 0, seen);
  return seen;
}

CarmenScan readRobotLaser(Message& message)
{
  CarmenScan seen;
  LaserScan& scan = seen.scan;
  message.skip(1);  // laser type
  scan.first_angle = message.number();
  message.skip(1);  // field of view: follows from the resolution
  scan.angle_step = message.number();
  scan.max_range = message.number();
  scan.range_sigma = std::max(0.01, message.number());
  message.skip(1);  // remission mode
  const std::size_t n = message.count();
  readRanges(message, n, scan);
  message.skip(message.count());  // remissions
  requireNoMore(message, n, 14);  // two poses, five numbers, time, host, time of logging
  seen.laser = readPose(message);
  readOdometry(message, 5, seen);  // speeds and safety distances
  if (seen.odometry) seen.mount = mountFrom(seen.laser - *seen.odometry);
  return seen;
}

/// Returns the scan of a line, none where it is another message or has less than two beams.
std::optional<CarmenScan> readScan(const TextLines& lines, const std::filesystem::path& path)
{
  Message message(lines.line(), path, lines.index());
  const bool flaser = message.name() == "FLASER";
  if (!flaser && message.name() != "ROBOTLASER1") return std::nullopt;
  CarmenScan seen = flaser ? readFlaser(message) : readRobotLaser(message);
  const LaserScan& scan = seen.scan;
  if (!(scan.angle_step > 0)) message.fail("angle step is not positive");
  if (scan.ranges.size() < 2) return std::nullopt;
  const double view = scan.angle_step * static_cast<double>(scan.ranges.size() - 1);
  if (std::abs(scan.first_angle) > 2 * M_PI || view > kMostView)
    message.fail("angles that no laser has");
  return seen;
}

/// Mounts the lasers as the log tells. A mount does not change: where the difference of the two
/// poses does, only the laser's was corrected, and no mount is told.
void mountLasers(std::vector<CarmenScan>& log)
{
  constexpr double kSameDistance = 0.05;  // [m]
  constexpr double kSameTurn = 0.05;  // [rad]
  const auto tells = [](const CarmenScan& seen) { return seen.mount.has_value(); };
  const auto first = std::find_if(log.begin(), log.end(), tells);
  const auto differs = [&](const CarmenScan& seen)
  {
    if (!seen.mount) return false;
    const mrpt::math::TPose2D change = *seen.mount - *first->mount;
    return std::hypot(change.x, change.y) > kSameDistance || std::abs(change.phi) > kSameTurn;
  };
  if (std::any_of(first, log.end(), differs)) return;
  for (CarmenScan& seen : log)
  {
    if (seen.mount) seen.scan.robot_from_sensor = *seen.mount;
  }
}

/// Some logs clip far readings to one value. So many readings at exactly the maximum are no
/// returns.
void dropClippedReadings(std::vector<CarmenScan>& log)
{
  constexpr float kSame = 0.005F;  // [m]
  constexpr double kShare = 0.001;
  float farthest = 0;
  for (const CarmenScan& seen : log)
  {
    for (const float range : seen.scan.ranges) farthest = std::max(farthest, range);
  }
  if (!(farthest > 0)) return;  // nothing tells of a limit
  std::size_t all = 0;
  std::size_t at_farthest = 0;
  const float limit = farthest - kSame;
  for (const CarmenScan& seen : log)
  {
    const auto& ranges = seen.scan.ranges;
    all += ranges.size();
    at_farthest += static_cast<std::size_t>(
        std::count_if(ranges.begin(), ranges.end(), [&](float r) { return r >= limit; }));
  }
  if (static_cast<double>(at_farthest) < std::max(10.0, kShare * static_cast<double>(all))) return;
  for (CarmenScan& seen : log)
  {
    LaserScan& scan = seen.scan;
    scan.max_range = std::min(scan.max_range, static_cast<double>(farthest));
    for (std::size_t i = 0; i < scan.ranges.size(); ++i)
    {
      if (scan.ranges[i] >= limit) scan.valid[i] = 0;
    }
  }
}
}  // namespace

CarmenLog readCarmenLog(const std::filesystem::path& path)
{
  constexpr std::uint64_t kMostLog = std::uint64_t{1} << 30U;  // bytes
  CarmenLog log;
  for (TextLines lines(path, kMostLog); lines.next();)
  {
    try
    {
      auto seen = readScan(lines, path);
      if (seen) log.scans.push_back(std::move(*seen));
    }
    catch (const std::runtime_error&)
    {
      // A recording that was stopped ends within a message.
      log.truncated = !lines.ended() && !log.scans.empty();
      if (!log.truncated) throw;
    }
  }
  if (log.scans.empty())
    throw std::runtime_error(path.string() + ": no FLASER or ROBOTLASER1 message of two readings");
  mountLasers(log.scans);
  dropClippedReadings(log.scans);
  return log;
}

bool isCarmenLog(const std::filesystem::path& path)
{
  const std::string ending = extensionOf(path);
  return ending == ".log" || ending == ".clf" || ending == ".carmen";
}
}  // namespace sigloc::detail

// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/LogObjects.h"

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>

#include <string>

#include "io/archive/checked_archive.h"
#include "io/archive/file_fault.h"
#include "io/carmen_log.h"
#include "io/scan_conversion.h"

namespace sigloc::detail
{
using mrpt::math::TPose2D;

namespace
{
constexpr double kPeriod = 0.1;  // [s] between two scans without times

mrpt::obs::CObservationOdometry::Ptr odometryOf(const TPose2D& pose, double time)
{
  auto odometry = mrpt::obs::CObservationOdometry::Create();
  odometry->sensorLabel = "ODOMETRY";
  odometry->timestamp = mrpt::Clock::fromDouble(time);
  odometry->odometry = mrpt::poses::CPose2D(pose);
  return odometry;
}

/// Returns what to do with a file that is no rawlog, if it is another kind of log.
std::string whatElse(GzipInput& input)
{
  constexpr std::size_t kLooked = 4096;  // bytes
  const std::string ending = extensionOf(input.path());
  if (ending == ".bag" || ending == ".db3") return "; sigloc-bag2rawlog makes one of a ROS bag";
  if (ending == ".mcap")
    return "; `ros2 bag convert` makes a .db3 of it, sigloc-bag2rawlog a rawlog";
  const std::string_view begin = input.peek(kLooked).substr(0, kLooked);
  const bool is_carmen = begin.find("FLASER ") != std::string_view::npos ||
                         begin.find("ROBOTLASER1 ") != std::string_view::npos;
  return is_carmen ? "; a CARMEN log is named .log, .clf or .carmen" : "";
}
}  // namespace

LogObjects::LogObjects(const std::filesystem::path& path)
{
  if (!isCarmenLog(path))
  {
    openRawlog(path);
    return;
  }
  double time = 0;
  CarmenLog log = readCarmenLog(path);
  truncated_ = log.truncated;
  for (CarmenScan& seen : log.scans)
  {
    time = seen.time.value_or(time + kPeriod);
    if (seen.odometry) made_.push_back(odometryOf(*seen.odometry, time));
    made_.push_back(toRangeScan(seen.scan, time));
  }
  count_ = made_.size();
}

void LogObjects::openRawlog(const std::filesystem::path& path)
{
  input_ = std::make_unique<GzipInput>(path);
  requireIntact(path);
  const std::string name = input_->nextClassName();
  if (name.empty())
    fail(path, input_->damaged() ? "truncated or damaged" : "not a rawlog" + whatElse(*input_));
  if (!isLogClass(name)) fail(path, "not a rawlog: it starts with a '" + name + "'");
}

mrpt::serialization::CSerializable::Ptr LogObjects::next()
{
  if (ended_) return nullptr;
  if (!input_)
  {
    ended_ = made_.empty();
    if (ended_) return nullptr;
    auto object = std::move(made_.front());
    made_.pop_front();
    return object;
  }
  try
  {
    const bool more = !input_->atEnd();
    auto object = more ? readLogEntry(*input_) : nullptr;
    if (object) return object;
    truncated_ = more || input_->damaged();
  }
  catch (const std::exception&)
  {
    // Cut off within an object, damaged, or an object of a class nobody registered: in MRPT's
    // format nothing after it can be read.
    truncated_ = true;
  }
  ended_ = true;
  return nullptr;
}

double LogObjects::progress() const
{
  if (ended_) return 1.0;
  if (input_) return input_->progress();
  return 1.0 - static_cast<double>(made_.size()) / static_cast<double>(count_);
}
}  // namespace sigloc::detail

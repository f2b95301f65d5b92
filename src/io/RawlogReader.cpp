// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/io/RawlogReader.h"

#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

#include "io/archive/UnreadObservation.h"
#include "io/frame_contents.h"
#include "io/LogObjects.h"
#include "io/motion_conversion.h"
#include "io/reading_check.h"
#include "io/scan_conversion.h"
#include "io/solid/SolidView.h"

namespace sigloc
{
using mrpt::obs::CActionCollection;
using mrpt::obs::CObservation;
using mrpt::obs::CObservationOdometry;
using mrpt::obs::CSensoryFrame;
using mrpt::poses::CPose2D;

namespace
{
constexpr double kGroupWindow = 0.05;  // [s], observations this close together make one step
constexpr double kMaxInterpolationGap = 1.0;  // [s] between two odometry readings
// A larger change between two steps is a reset of the odometry, not a motion.
constexpr double kMaxJump = 5.0;  // [m]
constexpr double kMaxSpeed = 10.0;  // [m/s]

struct OdometryReading
{
  double time;
  CPose2D pose;
};

/// Observations of an observations-only log that make one step.
struct Group
{
  CSensoryFrame::Ptr frame = CSensoryFrame::Create();
  std::optional<double> time;  // of the first scan or landmark observation
  std::set<std::string> labels;  // of the scans and landmark observations
  std::optional<CPose2D> odometry;  // interpolated at `time`
  std::size_t entry = 0;  // index of the last scan or landmark observation
};

CPose2D interpolated(const OdometryReading& a, const OdometryReading& b, double time)
{
  const double span = b.time - a.time;
  if (!(span > 0) || span > kMaxInterpolationGap || time < a.time) return a.pose;
  const double share = std::clamp((time - a.time) / span, 0.0, 1.0);
  const CPose2D whole = b.pose - a.pose;
  return a.pose + CPose2D(share * whole.x(), share * whole.y(), share * whole.phi());
}
}  // namespace

struct RawlogReader::State
{
  State(const std::filesystem::path& path, const ReadingOptions& given)
      : objects(path), options(given)
  {
  }

  mrpt::serialization::CSerializable::Ptr readObject();
  void skipFrameBeforeActions(const mrpt::serialization::CSerializable::Ptr& first_object);
  std::optional<RawlogStep> take(const mrpt::serialization::CSerializable::Ptr& object);
  std::optional<RawlogStep> takeObservation(const CObservation::Ptr& observation);
  void takeAction(const CActionCollection::Ptr& actions);
  void takeOdometry(const CObservationOdometry& reading);
  std::optional<RawlogStep> closeGroup();
  std::optional<RawlogStep> makeStep(const CSensoryFrame::Ptr& frame, std::optional<double> time,
                                     const std::optional<CPose2D>& odometry);
  std::optional<MotionIncrement> takeMotion(const std::optional<CPose2D>& odometry, double time);
  std::optional<MotionIncrement> believed(const mrpt::poses::CPosePDFGaussian& motion,
                                          double seconds);
  double timeOf(const CObservation& observation);
  void look(CObservation& observation);
  bool isSeen(const CObservation& observation) const;

  detail::LogObjects objects;
  ReadingOptions options;
  std::map<std::string, std::size_t> seen;  // observations by class
  bool has_laser = false;  // a usable scan of a planar laser was seen
  std::deque<mrpt::serialization::CSerializable::Ptr> read_ahead;
  std::size_t objects_taken = 0;
  LeftOutOfLog left_out;
  double latest_time = 0;  // [s], used where an entry has none

  std::optional<double> time_of_step;  // of the last one

  // Motion of action logs since the last step.
  bool has_action = false;
  bool action_unknown = false;
  CActionCollection::Ptr only_actions;  // null after a second collection
  mrpt::poses::CPosePDFGaussian action_motion;

  // Motion of observation logs.
  std::optional<OdometryReading> odometry;
  std::optional<CPose2D> odometry_of_step;
  Group group;
};

mrpt::serialization::CSerializable::Ptr RawlogReader::State::readObject()
{
  if (!read_ahead.empty())
  {
    auto object = std::move(read_ahead.front());
    read_ahead.pop_front();
    return object;
  }
  return objects.next();
}

// MRPT counts the pairs of an action and the frame after it. A frame before the first action is no
// step of such a log. Ground truth by rows starts after it.
void RawlogReader::State::skipFrameBeforeActions(
    const mrpt::serialization::CSerializable::Ptr& first_object)
{
  const bool frame = std::dynamic_pointer_cast<CSensoryFrame>(first_object) != nullptr;
  const auto second = frame ? readObject() : nullptr;
  if (std::dynamic_pointer_cast<CActionCollection>(second))
  {
    objects_taken = 1;
  }
  else
  {
    read_ahead.push_back(first_object);
  }
  if (second) read_ahead.push_back(second);
}

double RawlogReader::State::timeOf(const CObservation& observation)
{
  if (observation.timestamp != INVALID_TIMESTAMP)
  {
    const double time = mrpt::Clock::toDouble(observation.timestamp);
    if (std::isfinite(time)) latest_time = time;
  }
  return latest_time;
}

/// Counts an observation by its class, and cuts one of points in space in the plane of a laser. A
/// log with a laser has no need of that.
void RawlogReader::State::look(CObservation& observation)
{
  std::string name = observation.GetRuntimeClass()->className;
  const std::size_t colon = name.rfind(':');
  if (colon != std::string::npos) name.erase(0, colon + 1);
  const auto* const scan = dynamic_cast<mrpt::obs::CObservation2DRangeScan*>(&observation);
  has_laser = has_laser || (scan != nullptr && toLaserScan(*scan));
  auto* const unread = dynamic_cast<detail::UnreadObservation*>(&observation);
  if (unread != nullptr && detail::isSolid(*unread) && !has_laser)
  {
    const std::string reason = detail::cutPlanar(*unread, {options.min_height, options.max_height});
    if (!reason.empty()) name += " (" + reason + ")";
  }
  ++seen[name];
}

/// True for what makes a step.
bool RawlogReader::State::isSeen(const CObservation& observation) const
{
  const auto* const unread = dynamic_cast<const detail::UnreadObservation*>(&observation);
  return detail::isRange(observation) || (unread != nullptr && unread->cut && !has_laser);
}

std::optional<RawlogStep> RawlogReader::State::take(
    const mrpt::serialization::CSerializable::Ptr& object)
{
  if (const auto actions = std::dynamic_pointer_cast<CActionCollection>(object))
  {
    takeAction(actions);
    return std::nullopt;
  }
  if (const auto observation = std::dynamic_pointer_cast<CObservation>(object))
  {
    look(*observation);
    return takeObservation(observation);
  }
  const auto frame = std::dynamic_pointer_cast<CSensoryFrame>(object);
  if (!frame) return std::nullopt;
  std::optional<double> time;
  for (const auto& observation : *frame)
  {
    look(*observation);
    const double observed = timeOf(*observation);
    if (!time && isSeen(*observation)) time = observed;
    if (const auto reading = std::dynamic_pointer_cast<CObservationOdometry>(observation))
    {
      takeOdometry(*reading);
    }
  }
  auto step = makeStep(frame, time, odometry ? std::optional(odometry->pose) : std::nullopt);
  if (step) step->entry = objects_taken;
  return step;
}

void RawlogReader::State::takeAction(const CActionCollection::Ptr& actions)
{
  const detail::ActionMotion action = detail::motionOf(*actions);
  if (!action.present) return;
  only_actions = has_action ? nullptr : actions;
  if (!action.motion) action_unknown = true;
  if (!has_action) action_motion = mrpt::poses::CPosePDFGaussian();
  if (action.motion) action_motion += *action.motion;
  has_action = true;
}

void RawlogReader::State::takeOdometry(const CObservationOdometry& reading)
{
  const CPose2D& pose = reading.odometry;
  if (!std::isfinite(pose.x()) || !std::isfinite(pose.y()) || !std::isfinite(pose.phi()))
  {
    ++left_out.motions;
    return;
  }
  const OdometryReading now{timeOf(reading), pose};
  if (group.time && !group.odometry && odometry && now.time >= *group.time)
  {
    group.odometry = interpolated(*odometry, now, *group.time);
  }
  odometry = now;
}

std::optional<RawlogStep> RawlogReader::State::takeObservation(const CObservation::Ptr& observation)
{
  const auto unread = std::dynamic_pointer_cast<detail::UnreadObservation>(observation);
  if (unread && !detail::isSolid(*unread)) return std::nullopt;
  if (unread && !unread->cut)
  {
    if (!has_laser) ++left_out.observations;
    return std::nullopt;
  }
  const double time = timeOf(*observation);
  const bool range = isSeen(*observation);
  std::optional<RawlogStep> step;
  const bool group_over =
      group.time && (std::abs(time - *group.time) > kGroupWindow ||
                     (range && group.labels.count(observation->sensorLabel) != 0));
  if (const auto reading = std::dynamic_pointer_cast<CObservationOdometry>(observation))
  {
    takeOdometry(*reading);
  }
  if (group_over) step = closeGroup();
  group.frame->insert(observation);
  if (range)
  {
    if (!group.time) group.time = time;
    group.entry = objects_taken;
    group.labels.insert(observation->sensorLabel);
  }
  return step;
}

std::optional<RawlogStep> RawlogReader::State::closeGroup()
{
  Group closed;
  std::swap(closed, group);
  if (!closed.time) return std::nullopt;
  if (!closed.odometry && odometry) closed.odometry = odometry->pose;
  auto step = makeStep(closed.frame, closed.time, closed.odometry);
  if (step) step->entry = closed.entry;
  return step;
}

std::optional<RawlogStep> RawlogReader::State::makeStep(const CSensoryFrame::Ptr& frame,
                                                        std::optional<double> time,
                                                        const std::optional<CPose2D>& odometry_now)
{
  RawlogStep step;
  step.scans = laserScansOf(*frame);
  step.landmarks = landmarksOf(*frame);
  left_out.observations +=
      detail::countRanges(*frame) - step.scans.size() - detail::countUsableLandmarkScans(*frame);
  if (!has_laser)
  {
    step.scans = planarCutsOf(*frame);
    left_out.observations += detail::countSolids(*frame) - step.scans.size();
  }
  if (step.scans.empty() && step.landmarks.empty()) return std::nullopt;
  step.time = time.value_or(latest_time);
  step.motion = takeMotion(odometry_now, step.time);
  step.actions = std::exchange(only_actions, nullptr);
  step.frame = frame;
  return step;
}

std::optional<MotionIncrement> RawlogReader::State::takeMotion(
    const std::optional<CPose2D>& odometry_now, double time)
{
  const double seconds = time - std::exchange(time_of_step, time).value_or(time);
  if (std::exchange(has_action, false))
  {
    if (!std::exchange(action_unknown, false)) return believed(action_motion, seconds);
    ++left_out.motions;
    return std::nullopt;
  }
  if (!odometry_now) return std::nullopt;
  const CPose2D before = std::exchange(odometry_of_step, odometry_now).value_or(*odometry_now);
  return believed(detail::motionFromOdometry(*odometry_now - before), seconds);
}

/// Returns the motion; none for a reset of the odometry or a broken reading.
std::optional<MotionIncrement> RawlogReader::State::believed(
    const mrpt::poses::CPosePDFGaussian& motion, double seconds)
{
  const double limit = kMaxJump + kMaxSpeed * std::abs(seconds);
  if (motion.mean.norm() <= limit) return detail::toMotionIncrement(motion);
  ++left_out.motions;
  return std::nullopt;
}

RawlogReader::RawlogReader(const std::filesystem::path& path, const ReadingOptions& reading)
    : state_(std::make_unique<State>(path, reading))
{
  detail::checkReading(reading);
  const auto first = state_->readObject();
  if (!first)
    throw std::runtime_error(path.string() + ": truncated or damaged: not one entry could be read");
  state_->skipFrameBeforeActions(first);
}

RawlogReader::~RawlogReader() = default;
RawlogReader::RawlogReader(RawlogReader&&) noexcept = default;
RawlogReader& RawlogReader::operator=(RawlogReader&&) noexcept = default;

std::optional<RawlogStep> RawlogReader::next()
{
  while (const auto object = state_->readObject())
  {
    auto step = state_->take(object);
    ++state_->objects_taken;
    if (step) return step;
  }
  return state_->closeGroup();
}

bool RawlogReader::truncated() const
{
  return state_->objects.truncated();
}

const LeftOutOfLog& RawlogReader::leftOut() const
{
  return state_->left_out;
}

std::string RawlogReader::contents() const
{
  std::string text;
  for (const auto& [name, count] : state_->seen)
  {
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + name;
  }
  return text;
}

double RawlogReader::progress() const
{
  return state_->objects.progress();
}

ObservedScene observe(const RawlogStep& step, const FeatureExtractorOptions& extraction)
{
  return observeScene(step.scans, step.landmarks, extraction);
}
}  // namespace sigloc

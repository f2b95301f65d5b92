// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "hwdrivers/RawlogReplay.h"

#include <unistd.h>

#include <mrpt/core/Clock.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <array>
#include <chrono>
#include <stdexcept>
#include <utility>

#include "io/archive/checked_archive.h"

IMPLEMENTS_GENERIC_SENSOR(RawlogReplay, sigloc)

namespace sigloc
{
using mrpt::obs::CActionCollection;
using mrpt::obs::CObservation;
using mrpt::obs::CObservationOdometry;
using mrpt::obs::CSensoryFrame;

namespace
{
/// Lets the process read a key from its standard input, as if somebody had typed it.
void pressKey()
{
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) return;
  // The end that is written to stays open: a reader would find the end of the file otherwise.
  if (write(ends[1], "\n", 1) == 1) dup2(ends[0], STDIN_FILENO);
  close(ends[0]);
}

/// When an entry was recorded [s], if it tells.
std::optional<double> timeOf(const mrpt::serialization::CSerializable::Ptr& entry)
{
  auto seen = std::dynamic_pointer_cast<CObservation>(entry);
  const auto frame = std::dynamic_pointer_cast<CSensoryFrame>(entry);
  if (frame && !frame->empty()) seen = *frame->begin();
  if (!seen || seen->timestamp == INVALID_TIMESTAMP) return std::nullopt;
  return mrpt::Clock::toDouble(seen->timestamp);
}

double secondsNow()
{
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(now).count();
}
}  // namespace

bool ReplayPace::isDue(std::optional<double> log_time, double now)
{
  if (pace_ <= 0 || !log_time) return true;
  const double after = *log_time / pace_;
  if (!start_) start_ = now - after;
  return now >= *start_ + after;
}

void RawlogReplay::loadConfig_sensorSpecific(const mrpt::config::CConfigFileBase& source,
                                             const std::string& section)
{
  path_ = source.read_string(section, "rawlog", "", true);
  const double pace = source.read_double(section, "pace", 0);
  if (!(pace >= 0 && pace <= 1e6))
    throw std::invalid_argument("section " + section + ": pace must be in [0, 1000000]");
  pace_ = ReplayPace(pace);
  stop_after_end_ = source.read_double(section, "stop_after_end_s", stop_after_end_);
}

void RawlogReplay::initialize()
{
  input_ = std::make_unique<detail::GzipInput>(path_);
  m_state = ssWorking;
}

void RawlogReplay::doProcess()
{
  if (idle_ == 0 && readNext())
  {
    if (pace_.isDue(timeOf(next_), secondsNow())) playNext();
    return;
  }
  idle_ += 1 / m_process_rate;
  if (stop_after_end_ <= 0 || idle_ <= stop_after_end_ || key_pressed_) return;
  key_pressed_ = true;
  pressKey();
}

/// Returns false at the end of the log, or where it is damaged.
bool RawlogReplay::readNext()
{
  if (next_) return true;
  try
  {
    if (!input_->atEnd()) next_ = detail::readLogEntry(*input_);
  }
  catch (const std::exception&)
  {
    // Of a class that nobody registered: nothing after it can be read.
  }
  return next_ != nullptr;
}

void RawlogReplay::playNext()
{
  const auto entry = std::exchange(next_, nullptr);
  if (const auto actions = std::dynamic_pointer_cast<CActionCollection>(entry)) actions_ = actions;
  if (const auto seen = std::dynamic_pointer_cast<CObservation>(entry)) appendLabelled(seen);
  if (const auto frame = std::dynamic_pointer_cast<CSensoryFrame>(entry)) play(*frame);
}

void RawlogReplay::play(const CSensoryFrame& frame)
{
  const CActionCollection::Ptr actions = std::exchange(actions_, nullptr);
  if (frame.empty()) return;
  const auto movement = actions ? actions->getBestMovementEstimation() : nullptr;
  if (movement)
  {
    odometry_ = odometry_ + movement->poseChange->getMeanVal();
    auto odometry = CObservationOdometry::Create();
    odometry->timestamp = (*frame.begin())->timestamp;
    odometry->sensorLabel = "ODOMETRY";
    odometry->odometry = odometry_;
    appendObservation(odometry);
  }
  for (const CObservation::Ptr& seen : frame) appendLabelled(seen);
}

/// Stock programs can't export or remove observations without a label.
void RawlogReplay::appendLabelled(const CObservation::Ptr& seen)
{
  if (seen->sensorLabel.empty()) seen->sensorLabel = m_sensorLabel;
  appendObservation(seen);
}
}  // namespace sigloc

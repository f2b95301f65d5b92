// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/hwdrivers/CGenericSensor.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose2D.h>

#include <memory>
#include <optional>
#include <string>

#include "io/archive/gzip_input.h"

namespace sigloc
{
/// Tells when the entries of a log are due that is played at a pace of its own.
class ReplayPace
{
 public:
  /// `pace`: seconds of the log in a second; 0: everything is due at once.
  explicit ReplayPace(double pace = 0) : pace_(pace) {}

  /// Returns whether an entry is due that was recorded at `log_time` [s], `now` [s]. The two clocks
  /// may start anywhere. The first entry is due at once, and so is one without a time.
  bool isDue(std::optional<double> log_time, double now);

 private:
  double pace_;
  std::optional<double> start_;  // [s] of the second clock, where the first clock has its 0
};

/// A sensor that plays a rawlog of either kind, at most one entry each time it is asked; the motion
/// of action/frame pairs comes out as odometry. Times are those of the log. Observations without a
/// label get the sensor's.
///
/// Keys of its ini section:
///
/// * `rawlog`: the file
/// * `pace`: seconds of the log that are played in a second, 1 as it was recorded (0: an entry each
///   time, however long that took)
/// * `stop_after_end_s`: how long [s] after the log's end rawlog-grabber is stopped (10; 0: never).
///   The delay lets it write all observations, because it writes half of the waiting ones at a
///   time. rawlog-grabber ends at a key press, and at an exception, which it calls an error. So a
///   key is pressed: the process's standard input becomes a pipe that holds one
class RawlogReplay : public mrpt::hwdrivers::CGenericSensor
{
  DEFINE_GENERIC_SENSOR(RawlogReplay)

 public:
  /// Throws std::runtime_error with path and reason for a file that can't be opened.
  void initialize() override;
  /// Presses a key some time after the log has ended, once, which ends rawlog-grabber.
  void doProcess() override;

 private:
  void loadConfig_sensorSpecific(const mrpt::config::CConfigFileBase& source,
                                 const std::string& section) override;
  bool readNext();
  void playNext();
  void play(const mrpt::obs::CSensoryFrame& frame);
  void appendLabelled(const mrpt::obs::CObservation::Ptr& seen);

  std::string path_;
  double stop_after_end_ = 10;  // [s]
  ReplayPace pace_;
  std::unique_ptr<detail::GzipInput> input_;
  mrpt::serialization::CSerializable::Ptr next_;  // read, and not yet due
  mrpt::obs::CActionCollection::Ptr actions_;  // before the next frame
  double idle_ = 0;  // [s] since the end
  bool key_pressed_ = false;
  mrpt::poses::CPose2D odometry_;
};
}  // namespace sigloc

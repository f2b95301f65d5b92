// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/serialization/CSerializable.h>

#include <deque>
#include <filesystem>
#include <memory>

#include "io/archive/gzip_input.h"

namespace sigloc::detail
{
/// The objects of a log, front to back. Those of a CARMEN log are what a rawlog of the drive would
/// hold: for each scan the odometry, a CObservationOdometry, and a CObservation2DRangeScan.
///
/// A scan's mount is the identity; of ROBOTLASER1 messages it is the laser's pose on the robot. In
/// a log without odometry there are scans only, and without times they are 0.1 s apart.
class LogObjects
{
 public:
  /// Throws std::runtime_error naming the path and the reason for a missing, empty or foreign file.
  explicit LogObjects(const std::filesystem::path& path);

  /// Returns the next object; null at the end, or where nothing more can be read.
  mrpt::serialization::CSerializable::Ptr next();
  /// True when reading ended before the end of the file.
  bool truncated() const { return ended_ && truncated_; }
  /// Share of the log consumed so far, in [0, 1].
  double progress() const;

 private:
  void openRawlog(const std::filesystem::path& path);

  std::unique_ptr<GzipInput> input_;  // of a rawlog, or
  std::deque<mrpt::serialization::CSerializable::Ptr> made_;  // of a CARMEN log
  std::size_t count_ = 0;  // of what was made
  bool truncated_ = false;
  bool ended_ = false;
};
}  // namespace sigloc::detail

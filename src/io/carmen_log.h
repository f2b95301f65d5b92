// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPose2D.h>

#include <filesystem>
#include <optional>
#include <vector>

#include "sigloc/features/LaserScan.h"

namespace sigloc::detail
{
/// One FLASER or ROBOTLASER1 message.
struct CarmenScan
{
  LaserScan scan;  ///< mounted as `mount` tells, where all messages of the log that tell one agree
  std::optional<mrpt::math::TPose2D> mount;  ///< robot from laser, by the poses of ROBOTLASER1
  mrpt::math::TPose2D laser;  ///< the laser's pose, corrected in a corrected log
  std::optional<mrpt::math::TPose2D>
      odometry;  ///< the robot's pose; none where the line ends early
  std::optional<double> time;  ///< [s]; none where the line ends early
};

struct CarmenLog
{
  std::vector<CarmenScan> scans;  ///< not empty
  bool truncated = false;  ///< its last line is a part of a message, which is left out
};

/// Reads the laser messages of a CARMEN log, in its order. A FLASER message of n beams covers 180
/// degrees from -90 in steps of 180/n (n even) or 180/(n-1) degrees (n odd). Throws
/// std::runtime_error "path: reason".
CarmenLog readCarmenLog(const std::filesystem::path& path);

/// True for the name of a CARMEN log: `.log`, `.clf` or `.carmen`, whatever packs it.
bool isCarmenLog(const std::filesystem::path& path);
}  // namespace sigloc::detail

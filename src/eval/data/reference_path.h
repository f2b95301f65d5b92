// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPose2D.h>

#include <filesystem>
#include <vector>

namespace sigloc
{
/// A pose that a log's robot had.
struct ReferencePose
{
  double time = 0;  ///< [s] since 1970
  mrpt::math::TPose2D map_from_robot;
};

struct ReferencePath
{
  std::vector<ReferencePose> poses;  ///< one a step of the log, in its order
  double worst_goodness = 1;  ///< smallest share of a scan's points that ICP paired, in [0, 1]
};

/// Makes truth for a log of which only the last pose is known: back from there along the odometry,
/// each scan aligned with the points of the map by MRPT's ICP (`mrpt::slam::CICP`). None of our own
/// matching is in it. Good to the map's and the scans' errors, some centimetres, as long as
/// `worst_goodness` stays well above a half.
///
/// Throws std::runtime_error ("path: reason") for files that cannot be used, a map without scans, a
/// log without odometry, and where less than 0.3 of a scan finds its place on the map.
ReferencePath referencePath(const std::filesystem::path& map, const std::filesystem::path& rawlog,
                            const mrpt::math::TPose2D& last);

/// Throws std::runtime_error ("path: reason") where writeReferencePath() would replace anything but
/// an earlier one's file, which its first line tells.
void checkReferenceFile(const std::filesystem::path& path);

/// Writes rows `time x y phi` below a line that tells what they are. Throws std::runtime_error
/// ("path: reason").
void writeReferencePath(const ReferencePath& reference, const std::filesystem::path& path);
}  // namespace sigloc

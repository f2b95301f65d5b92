// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPose2D.h>

#include <filesystem>
#include <vector>

#include "sigloc/io/RawlogReader.h"

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

/// Makes truth for a log of which only the last pose is known. It goes back from there along the
/// odometry and aligns each scan with the points of the map by MRPT's ICP (`mrpt::slam::CICP`). It
/// uses none of our own matching. Its error is that of the map and the scans, some centimetres, as
/// long as `worst_goodness` stays well above a half.
///
/// Throws std::runtime_error ("path: reason") for files that cannot be used, a map without scans
/// and a log without odometry. Throws the same where ICP pairs less than 0.3 of a scan's points
/// with the map.
ReferencePath referencePath(const std::filesystem::path& map, const std::filesystem::path& rawlog,
                            const mrpt::math::TPose2D& last, const ReadingOptions& reading = {});

/// Throws std::runtime_error ("path: reason") where writeReferencePath() would replace any file but
/// one that it wrote earlier. The first line of a file shows that.
void checkReferenceFile(const std::filesystem::path& path);

/// Writes rows `time x y phi` below a line that describes them. Throws std::runtime_error ("path:
/// reason").
void writeReferencePath(const ReferencePath& reference, const std::filesystem::path& path);
}  // namespace sigloc

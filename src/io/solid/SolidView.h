// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint3D.h>
#include <mrpt/poses/CPose3D.h>
#include <mrpt/system/datetime.h>

#include <string>
#include <string_view>
#include <vector>

#include "io/archive/UnreadObservation.h"

namespace sigloc::detail
{
/// What an observation of points in space tells.
struct SolidView
{
  mrpt::system::TTimeStamp time = INVALID_TIMESTAMP;
  std::string label;
  mrpt::poses::CPose3D robot_from_sensor;
  std::vector<mrpt::math::TPoint3Df> points;  ///< [m] in the sensor's frame
  bool planar = false;  ///< of one plane: no heights are asked
  double max_range = 0;  ///< [m]; 0: not told
  double range_sigma = 0;  ///< [m]; 0: not told
};

// One reader a class, of what lies between its version and its end. All throw Unusable with the
// reason. MRPT's own readers would believe counts, decode images and open the files that are named.

/// Points, or else a depth image, which is projected by MRPT with the camera's own distortion.
SolidView readRangeCamera(std::string_view content, int version);
/// The packets of a Velodyne, converted by MRPT with the calibration that is stored with them.
SolidView readVelodyne(std::string_view content, int version);
/// A range image of one row, or of a VLP-16 or HDL-32E, whose rows' angles are known.
SolidView readRotatingScan(std::string_view content, int version);
SolidView readPointCloud(std::string_view content, int version);

/// True where an observation is of a class that one of these reads.
bool isSolid(const UnreadObservation& observation);

/// The heights [m] above the robot's base at which points count as walls.
struct HeightBand
{
  double min = 0;
  double max = 0;
};

/// Gives an observation of such a class its time, its label and its planar cut: what a planar laser
/// would see at the place of its sensor. The cut has the nearest point within
/// `band` in each direction, in steps of a quarter of a degree. Returns why it has none, or an
/// empty text.
std::string cutPlanar(UnreadObservation& observation, const HeightBand& band);
}  // namespace sigloc::detail

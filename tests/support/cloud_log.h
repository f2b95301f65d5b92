// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationPointCloud.h>

#include "bridge/rawlog_files.h"
#include "sigloc/io/RawlogReader.h"

namespace sigloc::test
{
/// Adds the returns of a planar scan to a cloud in the robot's frame: all at one height [m], and at
/// a share of their distance from the laser.
inline void addReturns(const mrpt::obs::CObservation2DRangeScan& scan, float height, float share,
                       mrpt::maps::CSimplePointsMap& cloud)
{
  mrpt::maps::CSimplePointsMap points;
  points.insertionOptions.minDistBetweenLaserPoints = 0;
  points.insertObservation(scan);
  const auto laser_x = static_cast<float>(scan.sensorPose.x());
  const auto laser_y = static_cast<float>(scan.sensorPose.y());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    float x = 0;
    float y = 0;
    float z = 0;
    points.getPointFast(i, x, y, z);
    cloud.insertPoint(laser_x + share * (x - laser_x), laser_y + share * (y - laser_y), height);
  }
}

/// The first steps of a log, in which `solidOf(scan)` takes the place of every planar scan.
template <class SolidOf>
std::vector<mrpt::serialization::CSerializable::Ptr> solidEntries(const std::filesystem::path& log,
                                                                  std::size_t steps,
                                                                  SolidOf&& solidOf)
{
  std::vector<mrpt::serialization::CSerializable::Ptr> entries;
  RawlogReader reader(log);
  for (std::size_t k = 0; k < steps; ++k)
  {
    const auto step = reader.next();
    if (!step) break;
    if (step->actions) entries.push_back(step->actions);
    auto frame = mrpt::obs::CSensoryFrame::Create();
    for (const auto& observation : *step->frame)
    {
      const auto scan = std::dynamic_pointer_cast<mrpt::obs::CObservation2DRangeScan>(observation);
      if (scan)
      {
        frame->insert(solidOf(*scan));
      }
      else
      {
        frame->insert(observation);
      }
    }
    entries.push_back(frame);
  }
  return entries;
}

/// A cloud seen when a scan was.
inline mrpt::obs::CObservationPointCloud::Ptr cloudObservation(
    const mrpt::obs::CObservation2DRangeScan& scan, const mrpt::maps::CSimplePointsMap::Ptr& cloud)
{
  auto view = mrpt::obs::CObservationPointCloud::Create();
  view->timestamp = scan.timestamp;
  view->pointcloud = cloud;
  return view;
}
}  // namespace sigloc::test

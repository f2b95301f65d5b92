// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationRange.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include <mrpt/rtti/CObject.h>

#include <cstdint>
#include <random>
#include <vector>

namespace sigloc::test
{
/// Returns one observation of every class that MRPT has, empty, and filled ones of the usual
/// sensors, with every byte in them that ends an object in a log.
inline std::vector<mrpt::obs::CObservation::Ptr> everyObservation()
{
  using namespace mrpt::obs;
  std::vector<CObservation::Ptr> all;
  for (const auto* id : mrpt::rtti::getAllRegisteredClassesChildrenOf(CLASS_ID(CObservation)))
  {
    auto made = std::dynamic_pointer_cast<CObservation>(id->createObject());
    if (made) all.push_back(made);
  }
  std::mt19937 random(20261125);
  auto image = CObservationImage::Create();
  image->image.resize(32, 24, mrpt::img::CH_RGB);
  for (unsigned row = 0; row < 24; ++row)
  {
    for (unsigned byte = 0; byte < 96; ++byte)
    {
      image->image.ptrLine<std::uint8_t>(row)[byte] = static_cast<std::uint8_t>(random());
    }
  }
  all.push_back(image);
  auto depth = CObservation3DRangeScan::Create();
  depth->hasRangeImage = true;
  depth->rangeImage_setSize(12, 16);
  depth->rangeImage.fill(0x8888);
  all.push_back(depth);
  auto velodyne = CObservationVelodyneScan::Create();
  velodyne->scan_packets.resize(2);
  all.push_back(velodyne);
  auto gps = CObservationGPS::Create();
  gnss::Message_NMEA_GGA fix;
  fix.fields.latitude_degrees = 36.7;
  gps->setMsg(fix);
  all.push_back(gps);
  auto imu = CObservationIMU::Create();
  imu->rawMeasurements.fill(9.81);
  all.push_back(imu);
  auto sonar = CObservationRange::Create();
  sonar->sensedData.resize(8);
  all.push_back(sonar);
  return all;
}
}  // namespace sigloc::test

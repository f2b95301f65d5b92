// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Whole logs of observations of points in space.
#include <gtest/gtest.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationRotatingScan.h>

#include <cmath>
#include <limits>

#include "bridge/rawlog_files.h"
#include "sigloc/io/map_files.h"
#include "sigloc/localize/LocalizationRun.h"
#include "sigloc/matching/SignatureMatcher.h"
#include "sigloc/tracking/HypothesisTracker.h"
#include "support/cloud_log.h"

using namespace sigloc;
using namespace sigloc::test;
using mrpt::math::TPose2D;
using mrpt::obs::CObservation;
using mrpt::obs::CObservation2DRangeScan;

namespace
{
const std::filesystem::path kSource = std::filesystem::path(SIGLOC_GOLDEN_FOLDER) / "../..";
}  // namespace

TEST(SolidDrives, ALogWithoutAnyIsRefusedByWhatItHolds)
{
  const TemporaryFolder folder;
  auto imu = mrpt::obs::CObservationIMU::Create();
  auto cloud = mrpt::obs::CObservationPointCloud::Create();
  cloud->setAsExternalStorage(
      "far.bin", mrpt::obs::CObservationPointCloud::ExternalStorageFormat::KittiBinFile);
  writeObjects(folder / "l.rawlog", {imu, imu, cloud});
  LocalizationSetup setup;
  setup.map_file = kSource / "maps/office.simplemap";
  setup.rawlog_file = folder / "l.rawlog";
  EXPECT_EQ(messageOf<std::runtime_error>([&] { LocalizationRun(setup, {}); }),
            (folder / "l.rawlog").string() +
                ": no usable laser scan in it; it holds 2 CObservationIMU, 1 "
                "CObservationPointCloud (its points are in another file)");
}

// The scans of the office's drive as clouds and as rotating scans, with the floor before the robot.
TEST(SolidDrives, ADriveOfThemEndsAtThePoseOfItsScans)
{
  const auto map = std::make_shared<const FeatureMap>(
      buildMapFromFile(kSource / "maps/office.simplemap", {}, {}));
  const auto matcher = std::make_shared<const SignatureMatcher>(map);
  const auto endOf = [&](const std::filesystem::path& path)
  {
    HypothesisTracker tracker(matcher);
    RawlogReader log(path);
    while (const auto step = log.next()) tracker.step(step->motion, observe(*step));
    EXPECT_EQ(tracker.belief().verdict, Verdict::localized) << path;
    return tracker.belief().hypotheses.at(0).pose.mean;
  };
  const TPose2D expected = endOf(kSource / "rawlogs/office.rawlog");
  const TemporaryFolder folder;
  for (const bool cloud : {true, false})
  {
    const auto entries =
        solidEntries(kSource / "rawlogs/office.rawlog", std::numeric_limits<std::size_t>::max(),
                     [&](const CObservation2DRangeScan& scan) -> CObservation::Ptr
                     {
                       if (!cloud)
                       {
                         auto view = mrpt::obs::CObservationRotatingScan::Create();
                         view->fromScan2D(scan);
                         return view;
                       }
                       auto points = mrpt::maps::CSimplePointsMap::Create();
                       addReturns(scan, 0.5F, 1, *points);
                       for (float x = 0.3F; x < 1; x += 0.1F) points->insertPoint(x, 0, 0);
                       return cloudObservation(scan, points);
                     });
    writeObjects(folder / "drive.rawlog", entries);
    const TPose2D found = endOf(folder / "drive.rawlog");
    EXPECT_LT(std::hypot(found.x - expected.x, found.y - expected.y), 0.05) << cloud;
    EXPECT_LT(std::abs(std::remainder(found.phi - expected.phi, 2 * M_PI)), 0.01) << cloud;
  }
}

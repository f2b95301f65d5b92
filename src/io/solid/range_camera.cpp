// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservation3DRangeScan.h>

#include <cmath>
#include <string>

#include "io/solid/content_reader.h"
#include "io/solid/SolidView.h"

namespace sigloc::detail
{
namespace
{
constexpr int kNewest = 10;
constexpr std::size_t kMostPixels = 4000000;

/// Walks over an image; nobody looks at it.
void skipImage(ContentReader& in)
{
  constexpr int kNewestImage = 9;
  constexpr int kOldestImage = 5;
  const int version = in.object("CImage");
  if (version < kOldestImage || version > kNewestImage)
    throw Unusable("holds an image of version " + std::to_string(version));
  const bool elsewhere = version >= 6 && in.flag();
  if (elsewhere)
  {
    in.text();
  }
  else if (!in.flag())  // gray
  {
    in.items(3, sizeof(std::int32_t));
    const auto size = in.value<std::uint32_t>();
    if (version >= kNewestImage) in.value<std::int32_t>();
    const bool packed = in.flag();
    in.items(packed ? in.value<std::uint32_t>() : size);
  }
  else
  {
    const auto width = version >= 7 ? std::int64_t{in.value<std::int32_t>()} : 1;
    const auto height = version >= 7 ? std::int64_t{in.value<std::int32_t>()} : 1;
    if (width >= 1 && height >= 1) in.items(in.value<std::uint32_t>());
    if (width < 0 && height < 0) in.items(static_cast<std::size_t>(width * height), 3);
  }
  in.end();
}

mrpt::img::TCamera camera(ContentReader& in)
{
  constexpr int kOldestCamera = 4;
  constexpr int kNewestCamera = 6;
  const int version = in.object("TCamera");
  if (version < kOldestCamera || version > kNewestCamera)
    throw Unusable("holds a camera of version " + std::to_string(version));
  mrpt::img::TCamera camera;
  camera.focalLengthMeters = in.value<double>();
  for (double& term : camera.dist) term = in.value<double>();
  const auto fx = in.value<double>();
  const auto fy = in.value<double>();
  const auto cx = in.value<double>();
  const auto cy = in.value<double>();
  // MRPT keeps a table for each camera that it has met, and never meets one with a NaN again.
  double sum = fx + fy + cx + cy + camera.focalLengthMeters;
  for (const double term : camera.dist) sum += term;
  if (!std::isfinite(sum)) throw Unusable("its camera is no camera");
  camera.setIntrinsicParamsFromValues(fx, fy, cx, cy);
  camera.nrows = in.value<std::uint32_t>();
  camera.ncols = in.value<std::uint32_t>();
  if (version >= 5) in.text();
  if (version >= kNewestCamera)
  {
    const auto model = in.value<std::uint8_t>();
    if (model > static_cast<std::uint8_t>(mrpt::img::DistortionModel::kannala_brandt))
      throw Unusable("damaged");
    camera.distortion = static_cast<mrpt::img::DistortionModel>(model);
  }
  in.end();
  return camera;
}

/// Reads the image of ranges into `scan`, in its units.
void takeRanges(ContentReader& in, int version, mrpt::obs::CObservation3DRangeScan& scan)
{
  constexpr int kInUnits = 9;
  if (version < kInUnits)
  {
    std::string name;
    in.anyObject(name);
    if (name != "CMatrixF" && name != "CMatrix") throw Unusable("damaged");
  }
  const std::size_t rows = in.value<std::uint32_t>();
  const std::size_t columns = in.value<std::uint32_t>();
  if (rows == 0 || columns == 0 || rows > kMostPixels || columns > kMostPixels ||
      rows * columns > kMostPixels)
    throw Unusable("its image of ranges has a size that cannot be used");
  const std::size_t count = rows * columns;
  const bool in_metres = version < kInUnits;
  const std::string_view data = in.items(count, in_metres ? sizeof(float) : sizeof(std::uint16_t));
  scan.rangeImage.resize(rows, columns);
  for (std::size_t i = 0; i < count; ++i)
  {
    constexpr double kMost = 65535;
    const double units = in_metres ? static_cast<double>(itemOf<float>(data, i)) /
                                         static_cast<double>(scan.rangeUnits)
                                   : itemOf<std::uint16_t>(data, i);
    const bool valid = units > 0 && units <= kMost;
    scan.rangeImage(i / columns, i % columns) =
        valid ? static_cast<std::uint16_t>(std::lround(units)) : std::uint16_t{0};
  }
  if (in_metres) in.end();
}

/// Reads the points that are stored as such.
void takePoints(ContentReader& in, int version, SolidView& view)
{
  constexpr int kWithPixels = 8;
  const std::size_t count = in.value<std::uint32_t>();
  const std::string_view x = in.items(count, sizeof(float));
  const std::string_view y = in.items(count, sizeof(float));
  const std::string_view z = in.items(count, sizeof(float));
  if (version == 0) in.items(count);
  if (version >= kWithPixels) in.items(count, 2 * sizeof(std::uint16_t));
  for (std::size_t i = 0; i < count; ++i)
    view.points.emplace_back(itemOf<float>(x, i), itemOf<float>(y, i), itemOf<float>(z, i));
}

/// Points of an image of ranges in the sensor's frame, by MRPT.
void project(mrpt::obs::CObservation3DRangeScan& scan, SolidView& view)
{
  scan.cameraParams.nrows = static_cast<std::uint32_t>(scan.rangeImage.rows());
  scan.cameraParams.ncols = static_cast<std::uint32_t>(scan.rangeImage.cols());
  if (!(scan.cameraParams.fx() > 0 && scan.cameraParams.fy() > 0))
    throw Unusable("its camera has no focal length");
  scan.hasRangeImage = true;
  mrpt::maps::CSimplePointsMap points;
  mrpt::obs::T3DPointsProjectionParams parameters;
  parameters.takeIntoAccountSensorPoseOnRobot = false;
  scan.unprojectInto(points, parameters);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    float x = 0;
    float y = 0;
    float z = 0;
    points.getPointFast(i, x, y, z);
    view.points.emplace_back(x, y, z);
  }
}
}  // namespace

SolidView readRangeCamera(std::string_view content, int version)
{
  if (version < 0 || version > kNewest) throw Unusable("of version " + std::to_string(version));
  ContentReader in(content);
  SolidView view;
  mrpt::obs::CObservation3DRangeScan scan;
  view.max_range = static_cast<double>(in.value<float>());
  view.robot_from_sensor = in.pose();
  if (version == 0 || in.flag()) takePoints(in, version, view);
  bool ranges = false;
  if (version >= 1)
  {
    ranges = in.flag();
    if (version >= 9) scan.rangeUnits = in.value<float>();
    if (ranges) takeRanges(in, version, scan);
    if (in.flag()) skipImage(in);
    if (in.flag()) skipImage(in);
    if (version >= 2) scan.cameraParams = camera(in);
    if (version >= 4)
    {
      camera(in);
      in.pose();
    }
  }
  view.range_sigma = static_cast<double>(in.value<float>());
  view.time = mrpt::Clock::time_point(mrpt::Clock::duration(in.value<std::int64_t>()));
  view.label = in.text();
  if (version >= 3)
  {
    const bool points_elsewhere = in.flag();
    in.text();
    const bool ranges_elsewhere = in.flag();
    in.text();
    if (points_elsewhere || ranges_elsewhere) throw Unusable("its ranges are in another file");
  }
  scan.range_is_depth = version < 5 || in.flag();
  if (view.points.empty() && ranges) project(scan, view);
  return view;
}
}  // namespace sigloc::detail

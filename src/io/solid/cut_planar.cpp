// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <utility>

#include "io/solid/content_reader.h"
#include "io/solid/sensor_mount.h"
#include "io/solid/SolidView.h"

namespace sigloc::detail
{
namespace
{
constexpr std::size_t kBins = 1440;  // of a whole turn
constexpr double kStep = 2 * M_PI / kBins;  // [rad]
constexpr std::size_t kWideGap = 40;  // [bins] at the back of a sensor that does not look all round
constexpr double kUsualSigma = 0.02;  // [m]
constexpr double kLargestSigma = 1;  // [m]
constexpr double kNearest = 0.05;  // [m]
constexpr double kUpright = 0.98;  // cosine of 10 degrees and some, for sensors of one plane

struct SolidClass
{
  std::string_view name;
  SolidView (*read)(std::string_view content, int version);
};

constexpr std::array<SolidClass, 4> kClasses = {{
    {"CObservation3DRangeScan", readRangeCamera},
    {"CObservationVelodyneScan", readVelodyne},
    {"CObservationRotatingScan", readRotatingScan},
    {"CObservationPointCloud", readPointCloud},
}};

const SolidClass* classOf(const UnreadObservation& observation)
{
  std::string_view name = observation.name();
  const std::size_t colon = name.rfind(':');
  if (colon != std::string_view::npos) name.remove_prefix(colon + 1);
  const auto* const found = std::find_if(kClasses.begin(), kClasses.end(),
                                         [&](const SolidClass& c) { return c.name == name; });
  return found == kClasses.end() ? nullptr : found;
}

/// Returns the nearest range in each direction from the sensor, seen from above; 0 for none.
std::vector<float> nearestRanges(const SolidView& view, const HeightBand& band)
{
  std::vector<float> ranges(kBins, 0.0F);
  const mrpt::poses::CPose3D& pose = view.robot_from_sensor;
  for (const auto& point : view.points)
  {
    const mrpt::math::TPoint3D at = pose.composePoint(mrpt::math::TPoint3D(point));
    if (!view.planar && !(at.z >= band.min && at.z <= band.max)) continue;
    const double dx = at.x - pose.x();
    const double dy = at.y - pose.y();
    const double range = std::hypot(dx, dy);
    if (!(range >= kNearest && range <= kFarthestReturn)) continue;
    const auto bin = static_cast<std::size_t>((std::atan2(dy, dx) + M_PI) / kStep) % kBins;
    if (ranges[bin] == 0 || range < static_cast<double>(ranges[bin]))
      ranges[bin] = static_cast<float>(range);
  }
  return ranges;
}

/// Returns where the sensor looks: the first direction and how many, without the widest gap.
std::pair<std::size_t, std::size_t> viewOf(const std::vector<float>& ranges)
{
  std::size_t widest = 0;
  std::size_t after = 0;
  std::size_t gap = 0;
  for (std::size_t i = 0; i < 2 * kBins; ++i)
  {
    if (ranges[i % kBins] == 0)
    {
      ++gap;
      continue;
    }
    if (gap > widest && gap < kBins)
    {
      widest = gap;
      after = i % kBins;
    }
    gap = 0;
  }
  if (widest < kWideGap) return {0, kBins};
  return {after, kBins - widest};
}

LaserScan scanOf(const SolidView& view, const HeightBand& band)
{
  if (!isSensorMount(view.robot_from_sensor)) throw Unusable("its sensor has no pose");
  if (view.planar && std::abs(view.robot_from_sensor.getRotationMatrix()(2, 2)) < kUpright)
    throw Unusable("its plane is tilted");
  const std::vector<float> ranges = nearestRanges(view, band);
  if (std::all_of(ranges.begin(), ranges.end(), [](float range) { return range == 0; }))
    throw Unusable("no point within the heights; see --heights");
  const auto [first, count] = viewOf(ranges);
  if (count < 2) throw Unusable("one direction only");
  LaserScan scan;
  scan.first_angle = -M_PI + (static_cast<double>(first) + 0.5) * kStep;
  scan.angle_step = kStep;
  const bool told = view.max_range > 0 && view.max_range < kFarthestReturn;
  scan.max_range = told ? view.max_range : kFarthestReturn;
  const bool noise = view.range_sigma > 0 && view.range_sigma <= kLargestSigma;
  scan.range_sigma = noise ? std::max(view.range_sigma, kUsualSigma) : kUsualSigma;
  scan.robot_from_sensor = {view.robot_from_sensor.x(), view.robot_from_sensor.y(), 0};
  for (std::size_t i = 0; i < count; ++i)
  {
    const float range = ranges[(first + i) % kBins];
    const bool valid = range > 0 && static_cast<double>(range) < scan.max_range;
    scan.ranges.push_back(valid ? range : 0.0F);
    scan.valid.push_back(valid ? 1 : 0);
  }
  return scan;
}
}  // namespace

bool isSolid(const UnreadObservation& observation)
{
  return classOf(observation) != nullptr;
}

std::string cutPlanar(UnreadObservation& observation, const HeightBand& band)
{
  const SolidClass* const found = classOf(observation);
  if (found == nullptr) return "of another class";
  observation.cut.reset();
  try
  {
    const SolidView view = found->read(observation.content(), observation.version());
    observation.timestamp = view.time;
    observation.sensorLabel = view.label;
    observation.cut = scanOf(view, band);
    return {};
  }
  catch (const Unusable& reason)
  {
    return reason.what();
  }
  catch (const std::exception&)
  {
    return "damaged";  // of MRPT's conversions
  }
}
}  // namespace sigloc::detail

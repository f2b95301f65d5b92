// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "laser_of_map.h"

#include <mrpt/config/CConfigFileMemory.h>

#include <algorithm>
#include <stdexcept>
#include <variant>

#include "map_errors.h"
#include "sigloc/io/file_output.h"
#include "sigloc/localize/LocalizationSetup.h"

namespace sigloc
{
namespace
{
constexpr const char* kSection = "laser";

/// The range [m] within which nearly all returns lie: a log's own limit is often far beyond it.
double usedRange(const std::vector<PosedScans>& scans, double limit)
{
  constexpr double kNearlyAll = 0.999;
  std::vector<float> ranges;
  for (const PosedScans& posed : scans)
  {
    for (const LaserScan& scan : posed.scans)
    {
      for (std::size_t i = 0; i < scan.ranges.size(); ++i)
      {
        if (scan.valid[i] != 0) ranges.push_back(scan.ranges[i]);
      }
    }
  }
  if (ranges.empty()) return limit;
  const auto last = ranges.begin() + static_cast<std::ptrdiff_t>(
                                         kNearlyAll * static_cast<double>(ranges.size() - 1));
  std::nth_element(ranges.begin(), last, ranges.end());
  return std::min(limit, static_cast<double>(*last));
}
}  // namespace

SimulatedLaserOptions laserOfMap(const MapSource& source)
{
  SimulatedLaserOptions laser;
  const auto* const scans = std::get_if<std::vector<PosedScans>>(&source);
  if (scans == nullptr) return laser;
  for (const PosedScans& posed : *scans)
  {
    if (posed.scans.empty() || posed.scans.front().ranges.size() < 2) continue;
    const LaserScan& first = posed.scans.front();
    laser.beams = static_cast<std::uint32_t>(first.ranges.size());
    laser.first_angle = first.first_angle;
    laser.angle_step = first.angle_step;
    laser.max_range = usedRange(*scans, first.max_range);
    laser.sensor_x = first.robot_from_sensor.x;
    laser.sensor_y = first.robot_from_sensor.y;
    laser.sensor_phi = first.robot_from_sensor.phi;
    break;
  }
  return withErrorsOf(*scans, laser);
}

SimulatedLaserOptions readLaser(const std::filesystem::path& ini,
                                const SimulatedLaserOptions& defaults)
{
  const std::string text = readIniText(ini);
  try
  {
    mrpt::config::CConfigFileMemory file;
    file.setContent(text);
    if (!file.sectionExists(kSection)) throw std::runtime_error("no section [laser]");
    return loadOptions<SimulatedLaserOptions>(file, kSection, defaults);
  }
  catch (const std::exception& error)
  {
    throw std::runtime_error(ini.string() + ": " + oneLine(error.what()));
  }
}
}  // namespace sigloc

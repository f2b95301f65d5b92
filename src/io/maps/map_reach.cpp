// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/maps/map_reach.h"

#include <fmt/core.h>

#include <cmath>
#include <stdexcept>

namespace sigloc::detail
{
namespace
{
constexpr double kReach = 1e5;  // [m], where single floats are 8 mm apart

class ReachCheck
{
 public:
  explicit ReachCheck(const std::filesystem::path& path) : path_(path) {}

  void operator()(const std::vector<PosedScans>& scans) const
  {
    for (const PosedScans& posed : scans) require(posed.map_from_robot.x, posed.map_from_robot.y);
  }

  void operator()(const OccupancyRaster& raster) const { require(raster.frame); }

  void operator()(const FeatureMap& map) const
  {
    for (const Feature& feature : map.features()) require(feature.position.x, feature.position.y);
    if (map.field()) require(map.field()->frame);
  }

 private:
  void require(double x, double y) const
  {
    const auto reason = beyondReach(x, y);
    if (reason) throw std::runtime_error(path_.string() + ": " + *reason);
  }

  void require(const RasterFrame& frame) const
  {
    require(frame.origin.x, frame.origin.y);
    require(frame.origin.x + frame.width * frame.resolution,
            frame.origin.y + frame.height * frame.resolution);
  }

  const std::filesystem::path& path_;
};
}  // namespace

std::optional<std::string> beyondReach(double x, double y)
{
  if (std::abs(x) <= kReach && std::abs(y) <= kReach) return std::nullopt;
  return fmt::format(
      "reaches ({:.10g}, {:.10g}) m; beyond {:.0f} m from the origin places are kept no better "
      "than a centimetre: shift the map's origin to where the robot is",
      x, y, kReach);
}

void requireWithinReach(const MapSource& source, const std::filesystem::path& path)
{
  std::visit(ReachCheck(path), source);
}

void requireWithinReach(const FeatureMap& map, const std::filesystem::path& path)
{
  ReachCheck{path}(map);
}
}  // namespace sigloc::detail

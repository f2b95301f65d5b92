// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/maps/map_reach.h"

#include <string>

#include "io/archive/file_fault.h"

namespace sigloc::detail
{
namespace
{
class ReachCheck
{
 public:
  explicit ReachCheck(const std::filesystem::path& path) : path_(path) {}

  void operator()(const std::vector<PosedScans>& scans) const
  {
    for (const PosedScans& posed : scans) require(posed.map_from_robot.x, posed.map_from_robot.y);
  }

  void operator()(const OccupancyRaster& raster) const
  {
    const auto reason = flawOf(raster.frame);
    if (reason) fail(path_, *reason);
  }

  void operator()(const FeatureMap&) const {}  // its constructor has checked it

 private:
  void require(double x, double y) const
  {
    const auto reason = beyondReach(x, y);
    if (reason) fail(path_, *reason);
  }

  const std::filesystem::path& path_;
};
}  // namespace

void requireWithinReach(const MapSource& source, const std::filesystem::path& path)
{
  std::visit(ReachCheck(path), source);
}
}  // namespace sigloc::detail

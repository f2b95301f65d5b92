// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "io/maps/gray_image.h"
#include "io/maps/map_source_readers.h"
#include "io/maps/ros_map_yaml.h"
#include "map/map_values.h"

namespace sigloc::detail
{
namespace
{
constexpr double kWhite = 255;
constexpr int kUnknownShade = 205;  // with which map savers write what was never seen
constexpr double kHundred = 100;

/// Returns the occupancy [percent] of a pixel by the map server's own rules, or nullopt where it is
/// unknown.
std::optional<double> occupancyOf(double shade, double alpha, const RosMapHeader& header)
{
  if (header.mode == RosMapMode::raw)
  {
    return shade <= kHundred ? std::optional(shade) : std::nullopt;
  }
  // In this mode, the map server takes an alpha channel for a fourth, or second, colour.
  const double occupied = header.negate ? shade / kWhite : 1 - shade / kWhite;
  if (header.mode == RosMapMode::scale && alpha < kWhite) return std::nullopt;
  if (occupied > header.occupied_threshold) return kHundred;
  if (occupied < header.free_threshold) return 0;
  if (header.mode == RosMapMode::trinary) return std::nullopt;
  const double span = header.occupied_threshold - header.free_threshold;
  return span > 0 ? std::rint((occupied - header.free_threshold) / span * kHundred) : kHundred;
}

/// True where the map server would take the shade of "never seen" for free.
bool takesUnknownForFree(const RosMapHeader& header)
{
  return header.mode != RosMapMode::raw && !header.negate &&
         1 - kUnknownShade / kWhite < header.free_threshold;
}

CellState stateOfPixel(int shade, int alpha, bool has_alpha, const RosMapHeader& header)
{
  if (shade == kUnknownShade && alpha == 255 && takesUnknownForFree(header))
  {
    return CellState::unknown;
  }
  const bool averaged = has_alpha && header.mode == RosMapMode::trinary;
  const auto percent = occupancyOf(averaged ? (3.0 * shade + alpha) / 4 : shade, alpha, header);
  return percent ? stateOfOccupancy(*percent / kHundred) : CellState::unknown;
}

/// Returns a raster whose lower left corner is at the origin and whose rows are turned by `yaw`, as
/// one along the axes. A cell has the state of the turned cell in which its middle is.
OccupancyRaster turned(const OccupancyRaster& image, double yaw)
{
  const RasterFrame& from = image.frame;
  const mrpt::math::TPose2D map_from_image(from.origin.x, from.origin.y, yaw);
  const double width = from.width * from.resolution;
  const double height = from.height * from.resolution;
  mrpt::math::TPoint2D low = from.origin;
  mrpt::math::TPoint2D high = from.origin;
  for (const mrpt::math::TPoint2D corner :
       {mrpt::math::TPoint2D(width, 0), {0, height}, {width, height}})
  {
    const mrpt::math::TPoint2D at = map_from_image.composePoint(corner);
    low = {std::min(low.x, at.x), std::min(low.y, at.y)};
    high = {std::max(high.x, at.x), std::max(high.y, at.y)};
  }
  OccupancyRaster raster;
  raster.frame.origin = low;
  raster.frame.resolution = from.resolution;
  raster.frame.width = static_cast<std::uint32_t>(std::ceil((high.x - low.x) / from.resolution));
  raster.frame.height = static_cast<std::uint32_t>(std::ceil((high.y - low.y) / from.resolution));
  raster.cells.reserve(std::size_t{raster.frame.width} * raster.frame.height);
  for (std::uint32_t y = 0; y < raster.frame.height; ++y)
  {
    for (std::uint32_t x = 0; x < raster.frame.width; ++x)
    {
      const mrpt::math::TPoint2D middle(low.x + (x + 0.5) * from.resolution,
                                        low.y + (y + 0.5) * from.resolution);
      const mrpt::math::TPoint2D at = map_from_image.inverseComposePoint(middle);
      const double column = std::floor(at.x / from.resolution);
      const double row = std::floor(at.y / from.resolution);
      const bool inside = column >= 0 && row >= 0 && column < from.width && row < from.height;
      raster.cells.push_back(inside ? image.cells[static_cast<std::size_t>(row) * from.width +
                                                  static_cast<std::size_t>(column)]
                                    : CellState::unknown);
    }
  }
  return raster;
}
}  // namespace

std::filesystem::path imageOfRosMap(const std::filesystem::path& path)
{
  return readRosMapHeader(path).image;
}

std::string warningOfRosMap(const std::filesystem::path& path)
{
  const RosMapHeader header = readRosMapHeader(path);
  if (!takesUnknownForFree(header)) return {};
  const GrayImage image = readGrayImage(header.image);
  const auto unknown = std::count(image.shades.begin(), image.shades.end(), kUnknownShade);
  if (unknown == 0) return {};
  return "its free_thresh would make free what the image shows as never seen (shade 205); it is "
         "taken as unknown";
}

OccupancyRaster readRosMap(const std::filesystem::path& path)
{
  constexpr double kSameTurn = 1e-6;  // [rad]
  const RosMapHeader header = readRosMapHeader(path);
  const GrayImage image = readGrayImage(header.image);
  OccupancyRaster raster;
  raster.frame = {{header.origin.x, header.origin.y}, header.resolution, image.width, image.height};
  raster.cells.reserve(image.shades.size());
  for (std::size_t row = image.height; row-- > 0;)  // the image's last row is the map's lowest
  {
    for (std::size_t i = row * image.width; i < (row + 1) * image.width; ++i)
    {
      const int alpha = image.alphas.empty() ? 255 : image.alphas[i];
      raster.cells.push_back(stateOfPixel(image.shades[i], alpha, !image.alphas.empty(), header));
    }
  }
  const double yaw = mrpt::math::wrapToPi(header.origin.phi);
  if (std::abs(yaw) > kSameTurn) raster = turned(raster, yaw);
  requireWallAndFree(raster, path);
  return raster;
}
}  // namespace sigloc::detail

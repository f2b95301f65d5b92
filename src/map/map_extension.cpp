// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/map/map_extension.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "sigloc/map/NearestFeature.h"

namespace sigloc
{
using mrpt::math::TPoint2D;

namespace
{
/// Whether the mapped feature already stands for `feature`.
bool covers(const Feature& mapped, const Feature& feature, const MapBuildingOptions& options)
{
  if (mapped.type != feature.type) return false;
  const bool directed = feature.type == FeatureType::segment ||
                        feature.type == FeatureType::corner ||
                        feature.type == FeatureType::wall_end;
  const double turn = std::abs(mrpt::math::wrapToPi(mapped.direction - feature.direction));
  if (feature.type != FeatureType::segment)
  {
    const double apart = (mapped.position - feature.position).norm();
    return apart <= options.merge_point_distance && (!directed || turn <= 3 * options.merge_angle);
  }
  if (turn > options.merge_angle) return false;
  const auto lies_on = [&](const TPoint2D& end)
  { return (nearestPlaceOn(mapped, end) - end).norm() <= options.merge_offset; };
  return lies_on(segmentStart(feature)) && lies_on(segmentEnd(feature));
}

std::vector<Feature> unionOf(const std::vector<Feature>& mapped, const std::vector<Feature>& seen,
                             const MapBuildingOptions& options)
{
  // One index for each type: the nearest feature of another type must not hide the right one.
  std::vector<std::vector<Feature>> by_type(5);
  for (const Feature& feature : mapped)
  {
    by_type[static_cast<std::size_t>(feature.type)].push_back(feature);
  }
  std::vector<NearestFeature> nearest;
  nearest.reserve(by_type.size());
  for (auto& features : by_type) nearest.emplace_back(std::move(features));
  const double reach = std::max(options.merge_offset, options.merge_point_distance) + 0.1;

  std::vector<Feature> all = mapped;
  std::vector<std::int32_t> new_index(seen.size(), -1);
  for (std::size_t i = 0; i < seen.size(); ++i)
  {
    const NearestFeature& same_type = nearest[static_cast<std::size_t>(seen[i].type)];
    const auto hit = same_type.find(seen[i].position, reach);
    if (hit && covers(same_type.features()[hit->feature], seen[i], options)) continue;
    new_index[i] = static_cast<std::int32_t>(all.size());
    all.push_back(seen[i]);
  }
  for (std::size_t k = mapped.size(); k < all.size(); ++k)
  {
    std::int32_t& parent = all[k].parent;
    if (parent >= 0) parent = new_index[static_cast<std::size_t>(parent)];
  }
  return all;
}

RasterFrame frameAround(const RasterFrame& map, const RasterFrame& scans)
{
  const double r = map.resolution;
  const auto before = [&](double map_origin, double scans_origin)
  { return std::max(0.0, std::ceil((map_origin - scans_origin) / r)); };
  const double left = before(map.origin.x, scans.origin.x);
  const double below = before(map.origin.y, scans.origin.y);
  const double scans_right = scans.origin.x + scans.resolution * scans.width;
  const double scans_top = scans.origin.y + scans.resolution * scans.height;
  const double right = std::max<double>(map.width, std::ceil((scans_right - map.origin.x) / r));
  const double above = std::max<double>(map.height, std::ceil((scans_top - map.origin.y) / r));
  RasterFrame frame = map;
  frame.origin = {map.origin.x - left * r, map.origin.y - below * r};
  frame.width = static_cast<std::uint32_t>(left + right);
  frame.height = static_cast<std::uint32_t>(below + above);
  return frame;
}

/// State of the cell of a raster that holds a point, unknown outside.
template <class StateOfCell>
CellState stateAt(const RasterFrame& frame, double x, double y, const StateOfCell& state)
{
  const double ix = std::floor((x - frame.origin.x) / frame.resolution);
  const double iy = std::floor((y - frame.origin.y) / frame.resolution);
  if (!(ix >= 0 && iy >= 0 && ix < frame.width && iy < frame.height)) return CellState::unknown;
  return state(static_cast<std::size_t>(iy) * frame.width + static_cast<std::size_t>(ix));
}

DenseField overlaid(const DenseField& field, const OccupancyRaster& scans)
{
  OccupancyRaster raster;
  raster.frame = frameAround(field.frame, scans.frame);
  raster.cells.reserve(std::size_t{raster.frame.width} * raster.frame.height);
  for (std::uint32_t iy = 0; iy < raster.frame.height; ++iy)
  {
    const double y = raster.frame.origin.y + (iy + 0.5) * raster.frame.resolution;
    for (std::uint32_t ix = 0; ix < raster.frame.width; ++ix)
    {
      const double x = raster.frame.origin.x + (ix + 0.5) * raster.frame.resolution;
      CellState state =
          stateAt(scans.frame, x, y, [&](std::size_t cell) { return scans.cells[cell]; });
      if (state == CellState::unknown)
      {
        state =
            stateAt(field.frame, x, y, [&](std::size_t cell) { return field.cells[cell].state; });
      }
      raster.cells.push_back(state);
    }
  }
  return buildDenseField(raster);
}
}  // namespace

FeatureMap extendMap(const FeatureMap& map, const std::vector<PosedScans>& scans,
                     const MapBuildingOptions& options, const FeatureExtractorOptions& extraction)
{
  const FeatureMap seen = buildMapFromScans(scans, options, extraction);
  std::optional<DenseField> field;
  if (map.field())
  {
    MapBuildingOptions same_raster = options;
    same_raster.raster_resolution = map.field()->frame.resolution;
    field = overlaid(*map.field(), rasterFromScans(scans, same_raster));
  }
  return FeatureMap(unionOf(map.features(), seen.features(), options), std::move(field),
                    map.error());
}
}  // namespace sigloc

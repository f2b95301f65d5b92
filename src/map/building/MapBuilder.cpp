// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "map/building/MapBuilder.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

#include "features/SeenReturns.h"
#include "map/building/counted_field.h"
#include "map/building/feature_union.h"
#include "map/building/wall_end_lengths.h"
#include "map/map_values.h"
#include "map/scene_in_map.h"

namespace sigloc
{
namespace
{
BeamCounts countsFor(const MapBuildingOptions& options, const FeatureMap* base)
{
  if (base == nullptr || !base->field()) return BeamCounts(options.raster_resolution);
  const RasterFrame& frame = base->field()->frame;
  return BeamCounts(frame.resolution, frame.origin);
}

void addTo(FeatureMerger& merger, BeamCounts& counts, const PosedScans& posed,
           const MapBuildingOptions& options, const FeatureExtractorOptions& extraction)
{
  const ObservedScene scene = observeScene(posed.scans, extraction);
  counts.add(posed, options.raster_range);
  merger.add(inMap(scene, posed.map_from_robot));
}

std::vector<Feature> featuresOf(const FeatureMerger& merger)
{
  std::vector<Feature> features = merger.features();
  setWallEndLengths(features);
  return features;
}

/// Throws std::invalid_argument where the poses spread too far for a field, and names the scan that
/// is farthest from the others. Nothing is allocated for a map before.
void refuseOutlier(const std::vector<PosedScans>& scans, const MapBuildingOptions& options)
{
  if (scans.empty()) return;
  std::vector<double> x, y;
  for (const PosedScans& posed : scans)
  {
    x.push_back(posed.map_from_robot.x);
    y.push_back(posed.map_from_robot.y);
  }
  std::sort(x.begin(), x.end());
  std::sort(y.begin(), y.end());
  const double cells = (x.back() - x.front()) * (y.back() - y.front()) /
                       (options.raster_resolution * options.raster_resolution);
  if (!(cells > kMostTiledCells)) return;  // a pose that is not finite is refused when it is added
  const mrpt::math::TPoint2D middle(x[x.size() / 2], y[y.size() / 2]);
  const auto distance = [&](const PosedScans& posed)
  { return std::hypot(posed.map_from_robot.x - middle.x, posed.map_from_robot.y - middle.y); };
  const auto outlier = std::max_element(scans.begin(), scans.end(),
                                        [&](const PosedScans& a, const PosedScans& b)
                                        { return distance(a) < distance(b); });
  throw std::invalid_argument(fmt::format(
      "the scans spread over too large an area: scan {} at ({:.1f}, {:.1f}) m is {:.0f} m from the "
      "middle of the others",
      outlier - scans.begin() + 1, outlier->map_from_robot.x, outlier->map_from_robot.y,
      distance(*outlier)));
}
}  // namespace

MapBuilder::MapBuilder(const MapBuildingOptions& options, std::shared_ptr<const FeatureMap> base)
    : options_(options),
      base_(std::move(base)),
      merger_(options),
      counts_(countsFor(options, base_.get()))
{
  checkOptions(options);
  if (base_ && base_->field()) field_ = GrowingField(*base_->field());
}

void MapBuilder::add(const PosedScans& posed, const FeatureExtractorOptions& extraction)
{
  addTo(merger_, counts_, posed, options_, extraction);
}

std::vector<Feature> MapBuilder::features() const
{
  std::vector<Feature> learnt = featuresOf(merger_);
  return base_ ? unionOf(base_->features(), learnt, options_) : learnt;
}

const DenseField* MapBuilder::field()
{
  if (!hasField()) return nullptr;
  field_.update(counts_, options_.min_hits);
  return field_.field().cells.empty() ? nullptr : &field_.field();
}

FeatureMap MapBuilder::map(const MapProvenance& provenance)
{
  std::optional<DenseField> field;
  if (this->field() != nullptr) field = inTilesWhereSparse(field_.cropped());
  return FeatureMap(features(), std::move(field), base_ ? base_->error() : MapErrorModel{},
                    provenance);
}

void MapBuilder::restore(FeatureMerger merger, BeamCounts counts)
{
  merger_ = std::move(merger);
  counts_ = std::move(counts);
}

FeatureMap buildMapFromScans(std::vector<PosedScans> scans, const MapBuildingOptions& options,
                             const FeatureExtractorOptions& extraction,
                             const MapProvenance& provenance, const MapProgress& progress)
{
  checkOptions(options);
  refuseOutlier(scans, options);
  auto merger = std::make_unique<FeatureMerger>(options);
  BeamCounts counts(options.raster_resolution, {0, 0}, kMostTiledCells);
  SeenReturns returns;
  for (std::size_t i = 0; i < scans.size(); ++i)
  {
    for (const LaserScan& scan : scans[i].scans) returns.add(scan);
    addTo(*merger, counts, scans[i], options, extraction);
    scans[i] = {};
    if (progress) progress(static_cast<double>(i + 1) / static_cast<double>(scans.size()));
  }
  if (counts.empty())
  {
    throw std::invalid_argument(
        returns.none() ? returns.whyNone()
                       : fmt::format("no scan has a return within {:g} m", options.raster_range));
  }
  std::vector<Feature> features = featuresOf(*merger);
  merger.reset();  // before the field, beside which the counts alone are needed
  return FeatureMap(std::move(features), denseFieldOf(std::move(counts), options.min_hits), {},
                    provenance);
}
}  // namespace sigloc

// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "map/building/MapBuilder.h"

#include <stdexcept>
#include <utility>

#include "map/building/counted_field.h"
#include "map/building/feature_union.h"
#include "map/building/wall_end_lengths.h"
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
  const ObservedScene scene = observeScene(posed.scans, extraction);
  counts_.add(posed, options_.raster_range);
  merger_.add(inMap(scene, posed.map_from_robot));
}

std::vector<Feature> MapBuilder::features() const
{
  std::vector<Feature> learnt = merger_.features();
  setWallEndLengths(learnt);
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
  if (this->field() != nullptr) field = field_.cropped();
  return FeatureMap(features(), std::move(field), base_ ? base_->error() : MapErrorModel{},
                    provenance);
}

void MapBuilder::restore(FeatureMerger merger, BeamCounts counts)
{
  merger_ = std::move(merger);
  counts_ = std::move(counts);
}

FeatureMap buildMapFromScans(const std::vector<PosedScans>& scans,
                             const MapBuildingOptions& options,
                             const FeatureExtractorOptions& extraction,
                             const MapProvenance& provenance, const MapProgress& progress)
{
  MapBuilder builder(options);
  for (std::size_t i = 0; i < scans.size(); ++i)
  {
    builder.add(scans[i], extraction);
    if (progress) progress(static_cast<double>(i + 1) / static_cast<double>(scans.size()));
  }
  if (builder.empty())
  {
    throw std::invalid_argument("buildMapFromScans: no scan has a valid return");
  }
  return FeatureMap(builder.features(), denseFieldOf(builder.counts(), options.min_hits), {},
                    provenance);
}
}  // namespace sigloc

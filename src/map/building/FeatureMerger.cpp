// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "map/building/FeatureMerger.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "map/building/merged_features.h"

namespace sigloc
{
using mrpt::math::TPoint2D;
using mrpt::math::wrapToPi;

namespace
{
constexpr double kLeastCell = 0.5;  // [m] of the hash: the means of sightings move

bool areAlike(const Feature& a, const Feature& b)
{
  return a.type == b.type && a.side == b.side && a.label == b.label &&
         (!hasBearing(b.type) || std::abs(wrapToPi(a.direction - b.direction)) <= kMostPlaceTurn);
}

/// Takes a sighting into the running means.
void absorbSighting(MergedPlace& merged, const Feature& place)
{
  Feature& feature = merged.feature;
  const double n = merged.count++;
  feature.position = (feature.position * n + place.position) * (1.0 / (n + 1));
  feature.size = isSeenInPart(place.type) ? std::max(feature.size, place.size)
                                          : (feature.size * n + place.size) / (n + 1);
  merged.cosine_sum += std::cos(place.direction);
  merged.sine_sum += std::sin(place.direction);
  feature.direction = std::atan2(merged.sine_sum, merged.cosine_sum);
  for (int r = 0; r < 2; ++r)
  {
    for (int c = 0; c < 2; ++c)
    {
      feature.position_covariance(r, c) =
          (feature.position_covariance(r, c) * n + place.position_covariance(r, c)) / (n + 1);
    }
  }
}
}  // namespace

FeatureMerger::FeatureMerger(const MapBuildingOptions& options, std::vector<MergedWall> walls,
                             std::vector<MergedPlace> places)
    : options_(options),
      walls_(options, std::move(walls)),
      places_(std::move(places)),
      places_by_cell_(std::max(kLeastCell, 2 * options.merge_point_distance))
{
  for (std::uint32_t k = 0; k < places_.size(); ++k)
  {
    places_[k].last_scan = 0;
    places_by_cell_.add(places_[k].feature.position, k);
  }
}

void FeatureMerger::add(const std::vector<Feature>& features_in_map)
{
  ++scan_;
  for (const Feature& feature : features_in_map)
  {
    if (isSegment(feature.type))
    {
      walls_.add(feature, scan_);
    }
    else
    {
      addPlace(feature);
    }
  }
}

std::vector<Feature> FeatureMerger::features() const
{
  return mergedFeatures(walls_.mergedAgain(options_.min_sightings), places_, options_);
}

/// Returns the place that another one is a sighting of, if any.
MergedPlace* FeatureMerger::placeFor(const Feature& place)
{
  MergedPlace* nearest = nullptr;
  double least = options_.merge_point_distance;
  places_by_cell_.forEachNear(place.position,
                              [&](std::uint32_t k)
                              {
                                const double distance =
                                    (places_[k].feature.position - place.position).norm();
                                if (distance >= least || !areAlike(places_[k].feature, place))
                                  return;
                                nearest = &places_[k];
                                least = distance;
                              });
  return nearest;
}

void FeatureMerger::addPlace(const Feature& place)
{
  MergedPlace* known = placeFor(place);
  if (known != nullptr)
  {
    absorbSighting(*known, place);
    if (known->last_scan != scan_) ++known->feature.sightings;
    known->last_scan = scan_;
    return;
  }
  MergedPlace fresh;
  fresh.feature = place;
  fresh.feature.parent = -1;
  fresh.feature.sightings = 1;
  fresh.cosine_sum = std::cos(place.direction);
  fresh.sine_sum = std::sin(place.direction);
  fresh.last_scan = scan_;
  places_.push_back(fresh);
  places_by_cell_.add(place.position, static_cast<std::uint32_t>(places_.size() - 1));
}
}  // namespace sigloc

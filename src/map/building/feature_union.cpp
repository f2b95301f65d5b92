// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "map/building/feature_union.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "map/NearestFeature.h"

namespace sigloc
{

namespace
{
/// True when the mapped feature and `feature` are within the merge distances.
bool covers(const Feature& mapped, const Feature& feature, const MapBuildingOptions& options)
{
  if (mapped.type != feature.type) return false;
  const double turn = std::abs(mrpt::math::wrapToPi(mapped.direction - feature.direction));
  if (isPointLike(feature.type))
  {
    const double apart = (mapped.position - feature.position).norm();
    return apart <= options.merge_point_distance &&
           (!hasBearing(feature.type) || turn <= 3 * options.merge_angle);
  }
  if (turn > options.merge_angle) return false;
  const auto lies_on = [&](const mrpt::math::TPoint2D& end)
  { return (nearestPlaceOn(mapped, end) - end).norm() <= options.merge_offset; };
  return lies_on(segmentStart(feature)) && lies_on(segmentEnd(feature));
}

}  // namespace

std::vector<Feature> unionOf(const std::vector<Feature>& mapped, const std::vector<Feature>& seen,
                             const MapBuildingOptions& options)
{
  // There is one index for each type, because the nearest feature of another type must not hide the
  // right one.
  std::vector<std::vector<Feature>> by_type(kFeatureTypes);
  for (const Feature& feature : mapped)
  {
    by_type[typeIndex(feature.type)].push_back(feature);
  }
  std::vector<NearestFeature> nearest;
  nearest.reserve(by_type.size());
  for (auto& features : by_type) nearest.emplace_back(std::move(features));
  const double reach = std::max(options.merge_offset, options.merge_point_distance) + 0.1;

  std::vector<Feature> all = mapped;
  std::vector<std::int32_t> new_index(seen.size(), -1);
  for (std::size_t i = 0; i < seen.size(); ++i)
  {
    const NearestFeature& same_type = nearest[typeIndex(seen[i].type)];
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
}  // namespace sigloc

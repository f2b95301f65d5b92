// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/map/FeatureMap.h"

#include <algorithm>
#include <stdexcept>

#include "map/map_values.h"

namespace sigloc
{
using mrpt::math::TPoint2D;

namespace
{
/// Throws std::invalid_argument where there is a flaw.
void refuse(const std::optional<std::string>& flaw)
{
  if (flaw) throw std::invalid_argument(*flaw);
}
}  // namespace

FeatureMap::FeatureMap(std::vector<Feature> features, std::optional<DenseField> field,
                       MapErrorModel error, MapProvenance provenance)
    : features_(std::move(features)),
      line_of_(features_.size(), -1),
      field_(std::move(field)),
      error_(error),
      provenance_(std::move(provenance))
{
  refuse(flawOf(features_));
  if (field_) refuse(flawOf(*field_));
  refuse(flawOf(error_));
  lines_ = linkWalls(features_);
  for (std::size_t l = 0; l < lines_.size(); ++l)
  {
    for (const std::uint32_t k : lines_[l].members) line_of_[k] = static_cast<std::int32_t>(l);
  }
}

FeatureMap FeatureMap::madeOf(MapProvenance provenance) &&
{
  provenance_ = std::move(provenance);
  return std::move(*this);
}

double FeatureMap::area() const
{
  if (field_ && field_->free_area > 0) return field_->free_area;
  if (features_.empty()) return 0;
  TPoint2D low = features_.front().position;
  TPoint2D high = low;
  for (const Feature& feature : features_)
  {
    low = {std::min(low.x, feature.position.x), std::min(low.y, feature.position.y)};
    high = {std::max(high.x, feature.position.x), std::max(high.y, feature.position.y)};
  }
  return (high.x - low.x) * (high.y - low.y);
}
}  // namespace sigloc

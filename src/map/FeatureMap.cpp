// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/map/FeatureMap.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace sigloc
{
using mrpt::math::TPoint2D;

namespace
{
void checkFeature(const Feature& feature, std::size_t k)
{
  if (typeIndex(feature.type) >= kFeatureTypes)
  {
    throw std::invalid_argument("FeatureMap: feature " + std::to_string(k) + " has no known type");
  }
  const auto& p = feature.position_covariance;
  const bool finite = std::isfinite(feature.position.x) && std::isfinite(feature.position.y) &&
                      std::isfinite(feature.direction) && std::isfinite(feature.size) &&
                      std::isfinite(feature.direction_variance) &&
                      std::isfinite(feature.size_variance) && std::isfinite(p(0, 0)) &&
                      std::isfinite(p(0, 1)) && std::isfinite(p(1, 0)) && std::isfinite(p(1, 1));
  if (!finite)
  {
    throw std::invalid_argument(fmt::format("FeatureMap: feature {} is not finite", k));
  }
  const double determinant = p(0, 0) * p(1, 1) - p(0, 1) * p(1, 0);
  const double tolerance = 1e-9 * (1e-12 + p(0, 0) * p(1, 1));
  if (p(0, 0) < 0 || p(1, 1) < 0 || determinant < -tolerance || feature.direction_variance < 0 ||
      feature.size_variance < 0)
  {
    throw std::invalid_argument(
        fmt::format("FeatureMap: covariance of feature {} is not positive semi-definite", k));
  }
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
  for (std::size_t k = 0; k < features_.size(); ++k) checkFeature(features_[k], k);
  lines_ = linkWalls(features_);
  for (std::size_t l = 0; l < lines_.size(); ++l)
  {
    for (const std::uint32_t k : lines_[l].members) line_of_[k] = static_cast<std::int32_t>(l);
  }
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

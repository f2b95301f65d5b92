// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "matching/features/FeatureGrid.h"
#include "sigloc/map/FeatureMap.h"

#include <array>
#include <vector>

namespace sigloc
{
/// What all modes need of a map, computed once: directed views of its features, the spatial hash,
/// and the density of each type. Keeps a reference to the map, which must outlive it.
class PreparedMap
{
 public:
  explicit PreparedMap(const FeatureMap& map);

  const FeatureMap& map() const { return *map_; }
  std::size_t size() const { return views_.size(); }
  const DirectedFeature& view(std::size_t k) const { return views_[k]; }
  /// Prefetches the memory of a view before its use.
  void prefetch(std::size_t k) const { __builtin_prefetch(&views_[k]); }
  const FeatureGrid& grid() const { return grid_; }
  double area() const { return area_; }  ///< [m^2] in which the robot can be, at least 1

  /// Density lambda of the background: features of the type per unit of their measurement space.
  /// The unit is [1/m^2], for a segment [1/(rad m)], for a corner or wall end [1/(m^2 rad)].
  /// \cite algorithm eq. (5.9)
  double clutterDensity(FeatureType type) const { return clutter_[typeIndex(type)]; }
  /// Largest variance [m^2] of any feature of the type along any direction.
  double largestPositionVariance(FeatureType type) const
  {
    return position_variance_[typeIndex(type)];
  }
  /// Means over the features of the type: of the largest variance along any direction [m^2], and of
  /// the direction's variance [rad^2].
  double typicalPositionVariance(FeatureType type) const
  {
    return typical_position_variance_[typeIndex(type)];
  }
  double typicalDirectionVariance(FeatureType type) const
  {
    return typical_direction_variance_[typeIndex(type)];
  }

  /// Returns the share, in [0, 1], of a stretch that is on the mapped pieces of k's wall. The
  /// stretch is from `low` to `high` [m] along feature k's tangent from its position. Each piece is
  /// widened by `tolerance` [m]. \cite algorithm eq. (3.12)
  double coveredShare(std::size_t k, double low, double high, double tolerance) const;

 private:
  const FeatureMap* map_;
  std::vector<DirectedFeature> views_;
  FeatureGrid grid_;
  double area_ = 1;
  std::array<double, kFeatureTypes> clutter_{};
  std::array<double, kFeatureTypes> position_variance_{};
  std::array<double, kFeatureTypes> typical_position_variance_{};
  std::array<double, kFeatureTypes> typical_direction_variance_{};
};
}  // namespace sigloc

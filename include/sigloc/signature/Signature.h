// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "sigloc/features/Feature.h"

namespace sigloc
{
/// The scalar by which pairs of features are sorted and found, invariant under rigid motion. For
/// two places it is their distance, for a place and a line the signed distance. For two lines it is
/// the angle from the first to the second. \cite algorithm eq. (3.3)
struct BinaryKey
{
  double value = 0;  ///< [m] or [rad]
  double variance = 0;  ///< [m^2] or [rad^2], of the two features alone
  bool is_angle = false;
};

/// The binary constraint between a feature and another one, independent of the pose.
struct Relation
{
  std::uint32_t other = 0;  ///< index of the feature
  BinaryKey key;  ///< eq. (3.3)
};

/// The signature of a feature: what separates it from others, independent of the pose. It is the
/// feature by itself and its relations to the others.
struct Signature
{
  std::uint32_t feature = 0;  ///< index of the feature
  std::vector<Relation> relations;  ///< to every other feature, by index
};

/// Returns the signatures of features that were seen together, in their order.
std::vector<Signature> signaturesOf(const std::vector<Feature>& features);
}  // namespace sigloc

// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "sigloc/features/Feature.h"

namespace sigloc
{
/// The one scalar by which pairs of features are sorted and looked up, invariant under rigid
/// motion: the distance of two places, the signed distance of a place to a line, the angle from
/// the first line to the second. \cite algorithm eq. (3.3)
struct BinaryKey
{
  double value = 0;  ///< [m] or [rad]
  double variance = 0;  ///< [m^2] or [rad^2], of the two features alone
  bool is_angle = false;
};

/// How one feature stands to another, whatever the pose.
struct Relation
{
  std::uint32_t other = 0;  ///< index of the feature
  BinaryKey key;  ///< eq. (3.3)
};

/// What tells a feature from others: the feature by itself and how the others stand to it; the
/// location-dependent constraints, which need a pose, apart.
struct Signature
{
  std::uint32_t feature = 0;  ///< index of the feature
  std::vector<Relation> relations;  ///< to every other one, in order
};

/// Returns the signatures of features that were seen together.
std::vector<Signature> signaturesOf(const std::vector<Feature>& features);
}  // namespace sigloc

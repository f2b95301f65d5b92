// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPose2D.h>

#include <cstddef>
#include <vector>

namespace sigloc
{
/// A scan from `truth` that could also be from `other`, with the probability that it was given.
struct Confusion
{
  mrpt::math::TPose2D truth;  ///< map_from_robot
  mrpt::math::TPose2D other;  ///< map_from_robot
  double probability = 0;
};

/// Two places that look alike: what is seen from `a` could be seen from `b`. Headings belong
/// together.
struct Twins
{
  mrpt::math::TPose2D a;
  mrpt::math::TPose2D b;
  std::size_t scans = 0;  ///< that could be from either
  double weight = 0;  ///< sum, over the scans, of the probability given to the wrong one

  /// What a scan gives to the wrong one on average, in [0, 1].
  double meanProbability() const { return weight / static_cast<double>(scans); }
};

/// Gathers confusions between the same two neighbourhoods, either way; those of one scan follow one
/// another. The heaviest come first.
std::vector<Twins> gatherTwins(const std::vector<Confusion>& confusions);
}  // namespace sigloc

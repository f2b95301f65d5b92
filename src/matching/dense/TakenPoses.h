// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/wrap2pi.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "geometry/NearPlaces.h"
#include "matching/dense/DenseEvidence.h"

namespace sigloc
{
/// Proposals that were chosen. Others near one of them are left out, because refining one is
/// enough.
class TakenPoses
{
 public:
  /// Returns whether one of them lies within 0.25 m along either axis and 4.5 degrees.
  bool holdsNear(const PoseProposal& p) const
  {
    constexpr auto kFullTurn = static_cast<float>(2 * M_PI);
    const float phi = mrpt::math::wrapToPi(p.phi);
    return places_.anyNear(p.x, p.y,
                           [&](std::uint32_t k)
                           {
                             const PoseProposal& taken = poses_[k];
                             const float turn = std::abs(taken.phi - phi);
                             return std::abs(taken.x - p.x) < kReach &&
                                    std::abs(taken.y - p.y) < kReach &&
                                    (turn < kTurn || turn > kFullTurn - kTurn);
                           });
  }

  void add(const PoseProposal& p)
  {
    places_.add(p.x, p.y);
    poses_.push_back({p.x, p.y, mrpt::math::wrapToPi(p.phi)});
  }

 private:
  static constexpr float kReach = 0.25F;  // [m]
  static constexpr auto kTurn = static_cast<float>(4.5 * M_PI / 180.0);  // [rad]

  NearPlaces<1024> places_{kReach};
  std::vector<PoseProposal> poses_;  // with wrapped headings
};
}  // namespace sigloc

// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/wrap2pi.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "matching/dense/DenseEvidence.h"

namespace sigloc
{
/// Proposals that were chosen. Others near one of them are left out, because refining one is
/// enough. A hash of cells finds the taken ones around a proposal, and distances decide: moving the
/// map must not change what is refined.
class TakenPoses
{
 public:
  TakenPoses() { newest_in_.fill(kNone); }

  /// Returns whether one of them lies within 0.25 m along either axis and 4.5 degrees.
  bool holdsNear(const PoseProposal& p) const
  {
    const float phi = mrpt::math::wrapToPi(p.phi);
    // A cell is twice the reach wide: these four hold all that may be near.
    const std::int32_t column = cellOf(p.x - kReach);
    const std::int32_t row = cellOf(p.y - kReach);
    return holdsNear(p, phi, slotOf(column, row)) || holdsNear(p, phi, slotOf(column + 1, row)) ||
           holdsNear(p, phi, slotOf(column, row + 1)) ||
           holdsNear(p, phi, slotOf(column + 1, row + 1));
  }

  void add(const PoseProposal& p)
  {
    std::uint32_t& newest = newest_in_[slotOf(cellOf(p.x), cellOf(p.y))];
    poses_.push_back({p.x, p.y, mrpt::math::wrapToPi(p.phi), newest});
    newest = static_cast<std::uint32_t>(poses_.size() - 1);
  }

 private:
  static constexpr float kReach = 0.25F;  // [m]
  static constexpr auto kTurn = static_cast<float>(4.5 * M_PI / 180.0);  // [rad]
  static constexpr std::uint32_t kNone = UINT32_MAX;
  static constexpr std::size_t kSlots = 1024;

  struct Taken
  {
    float x, y, phi;
    std::uint32_t before;  // the one taken before it in its slot
  };

  static std::int32_t cellOf(float coordinate)
  {
    return static_cast<std::int32_t>(std::floor(coordinate / (2 * kReach)));
  }
  static std::size_t slotOf(std::int32_t column, std::int32_t row)
  {
    const std::uint32_t mixed = static_cast<std::uint32_t>(column) * 73856093U ^
                                static_cast<std::uint32_t>(row) * 19349663U;
    return mixed % kSlots;
  }
  bool holdsNear(const PoseProposal& p, float phi, std::size_t slot) const
  {
    constexpr auto kFullTurn = static_cast<float>(2 * M_PI);
    for (std::uint32_t k = newest_in_[slot]; k != kNone; k = poses_[k].before)
    {
      const Taken& taken = poses_[k];
      const float turn = std::abs(taken.phi - phi);
      if (std::abs(taken.x - p.x) < kReach && std::abs(taken.y - p.y) < kReach &&
          (turn < kTurn || turn > kFullTurn - kTurn))
      {
        return true;
      }
    }
    return false;
  }

  std::array<std::uint32_t, kSlots> newest_in_;
  std::vector<Taken> poses_;
};
}  // namespace sigloc

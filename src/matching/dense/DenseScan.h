// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint2D.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sigloc/features/ObservedScene.h"

namespace sigloc
{
/// The returns of a scene, laid out for look-ups. Interleaved: any prefix of the order is spread
/// evenly over the scan, so "the first 24" is a fair sample.
struct DenseScan
{
  std::vector<float> x, y;  ///< [m], robot frame
  /// How a return pulls, robot frame: n nᵀ along the unit normal of the wall it lies on; off any
  /// wall half the unit matrix. \cite algorithm eq. (6.4)
  std::vector<float> pull_xx, pull_xy, pull_yy;
  /// Weight of a return halfway between every return and every stretch of wall weighing alike, mean
  /// 1. \cite algorithm eq. (6.11)
  std::vector<float> balance;
  std::vector<std::uint8_t> isolated;  ///< not 0: no beam beside it ends near it, may be clutter
  std::vector<std::uint32_t> origin;  ///< index into origins
  std::vector<mrpt::math::TPoint2D> origins;
  std::size_t size() const { return x.size(); }
};

/// Returns the scene's returns interleaved; with more than `max_beams`, an even choice of them.
DenseScan makeDenseScan(const ObservedScene& scene, std::size_t max_beams);
}  // namespace sigloc

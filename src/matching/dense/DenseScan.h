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
/// The returns of a scene. The first `spaced` of them lie evenly along the surfaces that are seen,
/// and any first part of these is spread evenly over the scan. So the first 24 returns are a fair
/// sample. All vectors have one element for each return.
struct DenseScan
{
  std::size_t spaced = 0;  ///< returns that score a pose; the others only refine it
  std::vector<float> x, y;  ///< [m], robot frame
  /// The directions in which a return has a residual, robot frame: n nᵀ of the unit normal n of the
  /// wall that it lies on. Off any wall it is half the unit matrix. \cite algorithm eq. (6.4)
  std::vector<float> pull_xx, pull_xy, pull_yy;
  /// Weight of a return, with mean 1. It balances equal weight for returns against equal weight for
  /// stretches of wall. \cite algorithm eq. (6.11)
  std::vector<float> balance;
  std::vector<std::uint8_t> isolated;  ///< not 0 where no beam beside it ends near it
  std::vector<std::uint32_t> origin;  ///< index into origins
  std::vector<mrpt::math::TPoint2D> origins;  ///< [m], robot frame; one for each sensor
  std::size_t size() const { return x.size(); }
};

/// How many returns of a scene relocation uses at most.
constexpr std::size_t kRelocationBeams = 400;

/// Returns the scene's returns; of more than `max_beams` an even choice. The spaced ones are one
/// for each 0.1 m of surface. \cite algorithm section 6, "The cascade"
DenseScan makeDenseScan(const ObservedScene& scene, std::size_t max_beams);
}  // namespace sigloc

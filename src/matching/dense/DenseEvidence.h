// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPose2D.h>

namespace sigloc
{
/// A pose to be judged.
struct PoseProposal
{
  float x = 0;  ///< [m]
  float y = 0;  ///< [m]
  float phi = 0;  ///< [rad], not wrapped
};

/// What the dense field says of a pose; all shares are of the returns used.
struct DenseEvidence
{
  double fine = 0;  ///< mean likelihood, sigma 0.12 m, in [0, 1]
  double coarse = 0;  ///< mean likelihood, sigma 0.25 m, in [0, 1]
  double through_wall = 0;  ///< share of beams that pass a mapped wall before their end
  double in_free = 0;  ///< share that ends in known free space, away from any wall
  double unknown = 0;  ///< share that ends where the map knows nothing
  double score = 0;  ///< the one figure to rank by, \cite algorithm eq. (6.8)
};

/// A proposal that survived the cascade.
struct RankedPose
{
  mrpt::math::TPose2D pose;
  DenseEvidence evidence;
};
}  // namespace sigloc

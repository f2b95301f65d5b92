// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/poses/CPosePDFParticles.h>

#include <cstddef>
#include <vector>

#include "sigloc/geometry/GaussianPose.h"

namespace sigloc
{
/// A pose where particles have gathered.
struct ParticleMode
{
  GaussianPose pose;  ///< mean and covariance of its particles
  double weight = 0;  ///< share of all particles' weight
};

/// True for poses within 0.75 m and 20 degrees of each other: a mode reaches as far from its mean,
/// and from one step to the next.
bool sameMode(const mrpt::math::TPose2D& a, const mrpt::math::TPose2D& b);

/// Returns the modes of the particles, heaviest first, at most `max_modes` of them. A mode has the
/// particles within 0.75 m and 20 degrees of their mean. Weights are normalised over all particles,
/// so the modes of a scattered set sum to less than one.
std::vector<ParticleMode> modesOf(const mrpt::poses::CPosePDFParticles& particles,
                                  std::size_t max_modes);
}  // namespace sigloc

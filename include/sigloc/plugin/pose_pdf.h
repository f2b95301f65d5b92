// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/poses/CPosePDFGaussian.h>
#include <mrpt/poses/CPosePDFParticles.h>
#include <mrpt/poses/CPosePDFSOG.h>

#include <cstddef>
#include <cstdint>

#include "sigloc/plugin/map_drawing.h"
#include "sigloc/tracking/Belief.h"

namespace sigloc
{
/// The candidates of one relocation as hypotheses, weighted by their probabilities.
Belief toBelief(const RelocationResult& result);

/// A pose anywhere in a map: the mean and covariance of a uniform distribution over its box and all
/// headings.
GaussianPose anywhereIn(const PlanarBox& box);

/// The belief as it is given to others. A localized one stays as it is. In any other, "somewhere
/// else" becomes the last hypothesis, `anywhere`, with its weight but at least 0.01. The verdict
/// vouches for no pose there, so that nobody may take the first for sure.
Belief withElsewhere(const Belief& belief, const GaussianPose& anywhere);

/// The first hypothesis as it is given to others. Unless the belief is localized, its covariance is
/// the mean squared deviation of withElsewhere() from it. Throws std::invalid_argument for a belief
/// without hypotheses.
GaussianPose reportedPose(const Belief& belief, const GaussianPose& anywhere);

/// The hypotheses as a sum of Gaussians: log-weights normalised over the hypotheses, so that
/// "somewhere else" is left out (see withElsewhere()), headings wrapped. Empty belief: no mode.
mrpt::poses::CPosePDFSOG toSumOfGaussians(const Belief& belief);

/// The first hypothesis. Throws std::invalid_argument for an empty belief.
mrpt::poses::CPosePDFGaussian toGaussian(const Belief& belief);

/// Mean and covariance of all hypotheses together, headings wrapped. Throws std::invalid_argument
/// for an empty belief.
GaussianPose momentsOf(const Belief& belief);

/// `count` equally weighted samples of the hypotheses, from `seed` (our own sampling: MRPT 2.5.8's
/// throws). Throws std::invalid_argument for an empty belief.
mrpt::poses::CPosePDFParticles toParticles(const Belief& belief, std::size_t count,
                                           std::uint64_t seed);

constexpr const char* kSurePoseLabel = "sigloc";
constexpr const char* kUnsurePoseLabel = "sigloc_unsure";

/// reportedPose() as an observation for a rawlog at `time` [s]. It is labelled "sigloc" where the
/// belief is localized, else "sigloc_unsure".
mrpt::obs::CObservationRobotPose::Ptr toRobotPoseObservation(const Belief& belief,
                                                             const GaussianPose& anywhere,
                                                             double time);
}  // namespace sigloc

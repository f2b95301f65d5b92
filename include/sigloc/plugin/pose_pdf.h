// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/poses/CPosePDFGaussian.h>
#include <mrpt/poses/CPosePDFParticles.h>
#include <mrpt/poses/CPosePDFSOG.h>

#include <cstddef>
#include <cstdint>

#include "sigloc/tracking/Belief.h"

namespace sigloc
{
/// The candidates of one relocation as hypotheses, weighted by their probabilities.
Belief toBelief(const RelocationResult& result);

/// The hypotheses as a sum of Gaussians: log-weights normalised over the hypotheses (MRPT cannot
/// represent "somewhere else"), headings wrapped. Empty belief: no mode.
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

/// The first hypothesis as an observation for a rawlog, labelled "sigloc", at `time` [s].
mrpt::obs::CObservationRobotPose::Ptr toRobotPoseObservation(const Belief& belief, double time);
}  // namespace sigloc

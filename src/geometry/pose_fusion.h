// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sigloc/geometry/GaussianPose.h"

namespace sigloc
{
/// Returns the product of two independent estimates of one pose (Kalman update with identity
/// measurement), heading wrapped. Throws std::invalid_argument when the covariances' sum is not
/// positive definite. \cite algorithm eq. (8.4)
GaussianPose fusePoses(const GaussianPose& prior, const GaussianPose& measured);

/// Returns the Gaussian with the mean and covariance of the two-mode mixture, the headings averaged
/// across +-pi. Weights need not be normalised; their sum is positive. \cite algorithm eq. (8.10)
GaussianPose mergeByMoments(const GaussianPose& a, double weight_a, const GaussianPose& b,
                            double weight_b);

/// Returns the standard deviation [m] of the position along its most uncertain direction.
double largestPositionSigma(const GaussianPose& pose);
}  // namespace sigloc

// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "matching/dense/DenseVerifier.h"
#include "sigloc/tracking/TrackerOptions.h"
#include "tracking/tracks/Track.h"

namespace sigloc
{
constexpr int kUpdateSteps = 6;  // of the refinement of a tracked pose
constexpr double kUpdateGate = 16.27;  // chi-square, 3 degrees of freedom, 99.9 %, eq. (8.3)
constexpr double kSharedErrors = 4;  // factor of a covariance: neighbouring scans share errors

/// Refines the predicted pose of a track by the returns and fuses both. A refinement that does not
/// agree with the prediction replaces it only when it explains the scan clearly better, because
/// odometry slips. Without odometry the whole prior is searched. Also sets the track's evidence and
/// score. \cite algorithm eq. (8.3), (8.4)
void updatePose(Track& track, const DenseScan& scan, const DenseVerifier& verifier,
                bool has_odometry, const TrackerOptions& options);
}  // namespace sigloc

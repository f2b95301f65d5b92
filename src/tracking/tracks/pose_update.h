// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "matching/dense/DenseVerifier.h"
#include "sigloc/tracking/TrackerOptions.h"
#include "tracking/tracks/Track.h"

namespace sigloc
{
/// The returns' own estimate near the predicted pose, fused with the prediction. A refinement that
/// the prediction excludes is taken only when it explains the scan clearly better: odometry slips.
/// Without odometry the whole of the prior is searched. Sets the evidence, too. \cite algorithm eq.
/// (8.3), (8.4)
void updatePose(Track& track, const DenseScan& scan, const DenseVerifier& verifier,
                bool has_odometry, const TrackerOptions& options);
}  // namespace sigloc

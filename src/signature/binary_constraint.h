// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sigloc/geometry/GaussianPose.h"
#include "sigloc/signature/Signature.h"
#include "signature/DirectedFeature.h"

namespace sigloc
{
/// Returns the key of a pair. \cite algorithm eq. (3.3)
BinaryKey binaryKey(const DirectedFeature& first, const DirectedFeature& second);

/// Gates of the binary constraints.
struct BinaryGates
{
  double scalar = 7.879;  ///< chi-square gate with one degree of freedom
  double planar = 10.597;  ///< chi-square gate with two degrees of freedom
  double min_overlap = 0.5;  ///< [-] share of an observed piece that must lie on the mapped wall
};

/// Returns the half width [m or rad] of the range of mapped keys that fit an observed one.
/// `mapped_variance` is the largest key variance of any mapped feature. \cite algorithm eq. (3.4)
double keyTolerance(const BinaryKey& observed, double mapped_variance, const MapErrorModel& error,
                    double gate);

/// Returns the result of the full binary test b_ij ~ b_kl: the key, and further constraints by the
/// types. These are bearings from corners, the position along a wall, offset and overlap of
/// parallel walls, and the extension of others. \cite algorithm eq. (3.3) to (3.7)
bool binaryCompatible(const DirectedFeature& observed_first, const DirectedFeature& observed_second,
                      const DirectedFeature& mapped_first, const DirectedFeature& mapped_second,
                      const MapErrorModel& error, const BinaryGates& gates);

/// |sin| of the angle between two lines below which they count as parallel.
constexpr double kParallelSine = 0.3;
}  // namespace sigloc

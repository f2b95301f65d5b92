// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint2D.h>

#include <cstddef>
#include <vector>

#include "sigloc/features/observe_scans.h"

namespace sigloc
{
/// Valid returns of one scan in the sensor frame, counter-clockwise.
struct ScanPoints
{
  std::vector<mrpt::math::TPoint2D> points;
  std::vector<double> ranges;
  std::vector<std::size_t> beams;  // beam index of each return
  std::size_t beam_count = 0;  // including lost beams; 0 where it is not known
  double beam_spacing = 0;  // [rad]
  double max_range = 0;  // [m]; 0 where it is not known, and no sky is seen then
  bool closed = false;  // the scan covers the full circle: the last beam is beside the first
};

struct PointRange
{
  std::size_t first;
  std::size_t last;  // inclusive
};

/// Returns the valid returns of a scan; out-of-range and broken beams are skipped.
ScanPoints validPoints(const LaserScan& scan, const FeatureExtractorOptions& options);

/// Drops the speckles: returns near none of the two before and the two after, and nearer than most
/// of them. Dust, rain and insects cause them, and they split walls. Returns whether there were
/// any. \cite algorithm eq. (2.8)
bool dropSpeckles(ScanPoints& scan, const FeatureExtractorOptions& options);

/// Rotates the order of a full-circle scan so that its seam cuts no wall. The scan then starts at a
/// break or, where the outline is closed, at the farthest return, which is a corner.
void startAtBreak(ScanPoints& scan, const FeatureExtractorOptions& options);

/// Returns the runs of neighbouring returns without a break between them. \cite algorithm eq. (2.1)
std::vector<PointRange> clustersOf(const ScanPoints& scan, const FeatureExtractorOptions& options);

/// Splits a range again and again, at the return farthest off the chord, and appends the pieces
/// from the first to the last. A zigzag may split once for every return, in a time of their square,
/// but takes no stack. \cite algorithm section 2
void splitRange(const ScanPoints& scan, PointRange range, const FeatureExtractorOptions& options,
                std::vector<PointRange>& pieces);

/// True when the neighbouring return beyond `edge` (towards `step`) was measured at most two beams
/// on and is farther by the jump. Then the wall really ends here. More lost beams, or a nearer one,
/// are no evidence. In a full-circle scan the first and the last return are neighbours.
bool jumpsFarther(const ScanPoints& scan, std::size_t edge, int step,
                  const FeatureExtractorOptions& options);

/// True when nothing is beside `edge` (towards `step`). Either the neighbouring return jumps
/// farther, or several beams are lost in a row well within the laser's range: the sky behind a
/// post.
bool standsFree(const ScanPoints& scan, std::size_t edge, int step,
                const FeatureExtractorOptions& options);

/// Appends the features and returns of a scan to a scene in the robot frame.
void appendScan(ScanPoints scan, const mrpt::math::TPose2D& robot_from_sensor, double range_sigma,
                const FeatureExtractorOptions& configured, ObservedScene& scene);
}  // namespace sigloc

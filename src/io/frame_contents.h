// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <cstddef>

namespace sigloc::detail
{
/// True for a scan of a planar laser, and for an observation of landmarks.
bool isRange(const mrpt::obs::CObservation& observation);

/// Returns how many of those there are in a frame.
std::size_t countRanges(const mrpt::obs::CSensoryFrame& frame);

/// Returns how many landmark observations of a frame are from a sensor with a valid pose on the
/// robot.
std::size_t countUsableLandmarkScans(const mrpt::obs::CSensoryFrame& frame);

/// Returns how many observations of points in space there are in a frame.
std::size_t countSolids(const mrpt::obs::CSensoryFrame& frame);
}  // namespace sigloc::detail

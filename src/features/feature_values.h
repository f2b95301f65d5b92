// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "sigloc/features/ObservedScene.h"

namespace sigloc
{
// The one check of values for every way in: files, objects in archives, and calls. A well-formed
// file may hold any number, and a caller may make any structure.

/// Returns why one of `count` features cannot be used ("has ..."), or nullopt where it can. It
/// needs a known type, finite numbers and a covariance that is positive semi-definite. Its position
/// is at most 1e6 m from the origin, its size in [0, 2e4] m, its direction in [-2 pi, 2 pi], and
/// its variances in [0, 1e4]. Its parent is -1 or an index below `count`.
std::optional<std::string> flawOf(const Feature& feature, std::size_t count);

/// Returns the length [m] of wall and round outline that indices sample; 0 for other features.
double outlineLength(const Feature& feature);

/// Throws std::invalid_argument ("feature k ...", "beam k ...") for a scene that cannot be used. A
/// sensor's origin is finite and at most 1e6 m from the robot. A beam names one of the origins and
/// ends within kFarthestReturn of it.
void checkScene(const ObservedScene& scene);
}  // namespace sigloc

// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>

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

/// Counts the features of a map that is read, by place. In so small a place, so many of them are no
/// map: every feature is paired with all that are near, which takes minutes of a million equal
/// ones.
class Crowding
{
 public:
  /// Features in a square of this side [m]. In no building that was mapped are there more than 130.
  static constexpr double kSide = 5.0;
  static constexpr std::uint32_t kMost = 1000;

  /// Takes a feature that has no flaw. Returns what is wrong ("has ..."), or nullopt.
  std::optional<std::string> add(const Feature& feature);

 private:
  std::unordered_map<std::uint64_t, std::uint32_t> counts_;
};

/// Returns the length [m] of wall and round outline that indices sample; 0 for other features.
double outlineLength(const Feature& feature);

/// Throws std::invalid_argument ("feature k ...", "beam k ...") for a scene that cannot be used. A
/// sensor's origin is finite and at most 1e6 m from the robot. A beam names one of the origins and
/// ends within kFarthestReturn of it.
void checkScene(const ObservedScene& scene);
}  // namespace sigloc

// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/img/TColor.h>
#include <mrpt/math/TPose2D.h>
#include <mrpt/opengl/CSetOfObjects.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "sigloc/features/ObservedScene.h"
#include "sigloc/map/FeatureMap.h"
#include "sigloc/tracking/Belief.h"

namespace sigloc
{
/// What a colour means, in pictures, scenes and pages alike. Features of the map have the colours
/// of their traits.
struct Palette
{
  using Color = mrpt::img::TColor;
  static constexpr Color kReturns{225, 30, 30};  ///< of the scan
  static constexpr Color kObserved{255, 140, 0};  ///< features seen
  static constexpr Color kUnlikely{120, 200, 255};  ///< a hypothesis of weight 0
  static constexpr Color kLikely{225, 0, 150};  ///< a hypothesis of weight 1
  static constexpr Color kSurePose{0, 150, 60};
  static constexpr Color kUnsurePose{115, 115, 115};
  static constexpr Color kPath{60, 190, 110};
  static constexpr Color kTruth{0, 0, 0};
  static constexpr Color kProposed{150, 90, 220};
  static constexpr Color kNotLocalized{210, 0, 0};  ///< frame and banner
  static constexpr std::uint8_t kUnknownShade = 222;
  static constexpr std::uint8_t kFreeShade = 255;
  static constexpr std::uint8_t kWallShade = 120;  ///< of the raster
};

/// What of a map is drawn. Lines are solid strips, because line widths are ignored by MRPT's core
/// profile renderer.
struct MapDrawing
{
  double line_width = 0.1;  ///< [m]
  bool raster = true;  ///< the dense field's cells below the features
  bool small_features = true;  ///< corners, wall ends and points; clutter in an overview
};

/// Returns the map, seen from above: raster (unknown grey, free white, walls dark grey), segments
/// blue, circles olive, corners teal, wall ends brown, points black.
mrpt::opengl::CSetOfObjects::Ptr drawMap(const FeatureMap& map, const MapDrawing& drawing = {});

/// One step as it is drawn over the map.
struct StepDrawing
{
  const ObservedScene* observed = nullptr;  ///< drawn at `observed_at`
  std::optional<mrpt::math::TPose2D> observed_at;  ///< none: at the first hypothesis, if any
  const Belief* belief = nullptr;
  std::optional<mrpt::math::TPose2D> truth;
  std::vector<mrpt::math::TPose2D> path;  ///< the localized poses so far
  std::vector<mrpt::math::TPose2D> proposed;  ///< poses that were considered, kept or not
  double line_width = 0.1;  ///< [m]
  double min_mark_size = 0.5;  ///< [m], marks are never smaller, so that an overview shows them
};

/// Returns the drawing of a step. The estimated path is a green line, the returns are red and the
/// observed features orange. Every hypothesis is its 3-sigma ellipse, light blue to magenta by
/// weight, with its heading. The first pose is an arrowhead, green where the belief is localized
/// and grey elsewhere. The truth is a black ring, and proposed poses are violet dots.
mrpt::opengl::CSetOfObjects::Ptr drawStep(const StepDrawing& step);

/// Returns what a robot sees, in its own frame: an arrowhead for the robot, red returns, and the
/// features, each type in the colour that it has in a map. A pale floor below makes them stand out
/// from the background of any viewer. Lines are `line_width` [m] wide.
mrpt::opengl::CSetOfObjects::Ptr drawObservation(const ObservedScene& seen,
                                                 double line_width = 0.1);

/// Axis-aligned box in the map frame [m].
struct PlanarBox
{
  double x_min = 0, x_max = 0, y_min = 0, y_max = 0;
};

/// Returns the box of everything in the map; a unit box for an empty one.
PlanarBox boundsOf(const FeatureMap& map);
}  // namespace sigloc

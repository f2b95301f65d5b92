// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPose2D.h>
#include <mrpt/opengl/CSetOfObjects.h>

#include <optional>
#include <vector>

#include "sigloc/features/ObservedScene.h"
#include "sigloc/map/FeatureMap.h"
#include "sigloc/tracking/Belief.h"

namespace sigloc
{
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

/// Axis-aligned box in the map frame [m].
struct PlanarBox
{
  double x_min = 0, x_max = 0, y_min = 0, y_max = 0;
};

/// Returns the box of everything in the map; a unit box for an empty one.
PlanarBox boundsOf(const FeatureMap& map);
}  // namespace sigloc

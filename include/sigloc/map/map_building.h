// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sigloc/config/option_fields.h"
#include "sigloc/features/observe_scans.h"
#include "sigloc/map/FeatureMap.h"

#include <functional>
#include <vector>

namespace sigloc
{
/// All laser scans of one step with the pose from which they were taken.
struct PosedScans
{
  mrpt::math::TPose2D map_from_robot;
  std::vector<LaserScan> scans;
};

/// How maps are made. Units, ranges and meanings are in `visitFields`. \cite algorithm section 2
struct MapBuildingOptions
{
  double raster_resolution = 0.05;
  double raster_range = 30.0;
  std::uint32_t min_hits = 1;
  double cast_spacing = 0.75;
  double cast_range = 15.0;
  std::uint32_t min_sightings = 2;
  std::uint32_t min_cast_sightings = 9;
  double merge_offset = 0.10;
  double merge_angle = 0.10;
  double merge_gap = 0.3;
  double merge_point_distance = 0.25;

  template <class V>
  static void visitFields(V&& visit)
  {
    using O = MapBuildingOptions;
    visit(OptionField{"raster_resolution", &O::raster_resolution, 0.01, 0.5,
                      "[m] cell of the dense field built from scans"});
    visit(OptionField{"raster_range", &O::raster_range, 1.0, 1000.0,
                      "[m] returns beyond this are not drawn into the raster"});
    visit(OptionField{"min_hits", &O::min_hits, 1U, 100U,
                      "[-] scans that must hit a cell, with its neighbours, before it is wall"});
    visit(OptionField{"cast_spacing", &O::cast_spacing, 0.2, 10.0,
                      "[m] distance of the scans simulated in a grid map"});
    visit(OptionField{"cast_range", &O::cast_range, 1.0, 100.0,
                      "[m] range of the scans simulated in a grid map"});
    visit(OptionField{"min_sightings", &O::min_sightings, 1U, 100U,
                      "[-] scans in which a map feature must have been seen"});
    visit(OptionField{"min_cast_sightings", &O::min_cast_sightings, 1U, 100U,
                      "[-] simulated scans of a grid in which a map feature must have been seen"});
    visit(OptionField{"merge_offset", &O::merge_offset, 0.01, 1.0,
                      "[m] segments merge when their lines are this close"});
    visit(OptionField{"merge_angle", &O::merge_angle, 0.01, 1.0,
                      "[rad] segments merge when their normals are this close"});
    visit(OptionField{"merge_gap", &O::merge_gap, 0.0, 5.0,
                      "[m] segments merge across a gap up to this"});
    visit(OptionField{"merge_point_distance", &O::merge_point_distance, 0.01, 2.0,
                      "[m] corners, circles, wall ends and points merge within this"});
  }
};

/// Called while a map is built, now and then, with the share of the work that is done, in [0, 1].
using MapProgress = std::function<void(double share)>;

/// Returns the map of posed scans: raster from hit counts, dense field, merged features. Each
/// scan's memory is freed once it is counted, so whoever moves the scans in needs less of it.
/// Throws std::invalid_argument for options out of their ranges, and where no scan has a valid
/// return. So it does for an inconsistent scan, and for poses not finite or too far apart.
FeatureMap buildMapFromScans(std::vector<PosedScans> scans, const MapBuildingOptions& options = {},
                             const FeatureExtractorOptions& extraction = {},
                             const MapProvenance& provenance = {},
                             const MapProgress& progress = {});

/// Returns the map of an occupancy raster. Scans are cast from its free cells, so that the features
/// are those that a laser sees. Throws std::invalid_argument for options out of their ranges, and
/// for a raster that is inconsistent or has no wall.
FeatureMap buildMapFromRaster(const OccupancyRaster& raster, const MapBuildingOptions& options = {},
                              const FeatureExtractorOptions& extraction = {},
                              const MapProvenance& provenance = {},
                              const MapProgress& progress = {});

/// Returns the raster of posed scans. A cell is wall when beams of at least min_hits scans end in
/// it and its neighbours, and free when beams pass and it is not wall. Throws as
/// buildMapFromScans() does. \cite algorithm eq. (6.1), (6.2)
OccupancyRaster rasterFromScans(const std::vector<PosedScans>& scans,
                                const MapBuildingOptions& options = {});
}  // namespace sigloc

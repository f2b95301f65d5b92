// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/maps/CMultiMetricMap.h>
#include <mrpt/math/CMatrixFixed.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/poses/CPose2D.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "eval/methods/TrackingMethod.h"

namespace sigloc
{
/// Least noise of a step's odometry.
struct OdometryNoise
{
  double sigma = 0.10;  ///< [m]
  double angle_deg = 2.0;
};

/// The settings that differ between the variants of MRPT's filter. The defaults are those of
/// localization_demo.ini, which comes with pf-localization.
struct MonteCarloSettings
{
  std::uint32_t particles = 40000;  ///< at the start
  bool adaptive = true;
  std::uint32_t kld_minimum = 150;
  std::uint32_t kld_maximum = 40000;
  double kld_bin = 0.10;  ///< [m]
  std::uint32_t beam_decimation = 20;  ///< one beam of so many is used
  double tempering = 1;  ///< exponent of a scan's likelihood, in (0, 1]
  /// The least of MRPT's reliability (see scanReliability) for a claim; none: not asked for.
  std::optional<double> least_reliability;
  OdometryNoise dummy_odometry;  ///< of logs of observations only
  /// Replaces the log's motion model. None: the log's own is used, as the stock program does.
  std::optional<OdometryNoise> own_odometry;
  std::optional<PoseRegion> region;
};

/// Returns the settings of `mcl` and `mcl-stock` (shipped), `mcl-fixed`, `mcl-tuned` or `mcl-best`,
/// the last two for a map with that much free area [m^2]. Throws std::invalid_argument for another
/// name.
MonteCarloSettings monteCarloSettings(const std::string& name, double free_area,
                                      const RelocationMethodOptions& options);

/// Returns the free area of a map's raster [m^2].
double freeAreaOf(const EvaluationMap& map);

/// Returns the settings as text in the form of pf-localization's configuration: its sections for
/// KLD, filter, odometry and map, but not the one that names files.
std::string toIni(const MonteCarloSettings& settings);

/// Returns the bounds in which particles start, all of the plane without a region.
PoseRegion startRegionOf(const MonteCarloSettings& settings);

/// Returns the map that pf-localization makes of the same file with the configuration `ini`. For
/// kinds of files that it does not read, and for maps without a file, returns the raster's cells. A
/// grid file's own likelihood options, which the stock program would use, are ignored.
mrpt::maps::CMultiMetricMap::Ptr localizationMapOf(const EvaluationMap& map,
                                                   const std::string& ini);

/// True when pf-localization itself can be given the map's file: a simplemap.
bool isSimplemap(const std::filesystem::path& file);

/// Returns the action of a step as pf-localization has it: the log's own, or made of the odometry
/// increment with the settings' noise.
mrpt::obs::CActionCollection actionsOf(const RawlogStep& step, const MonteCarloSettings& settings);

/// The rule for when MRPT's filter claims a pose, the same for every setting.
class TightCloud
{
 public:
  /// Returns the claim of one more step.
  TrackingClaim claim(const mrpt::poses::CPose2D& mean,
                      const mrpt::math::CMatrixDouble33& covariance);

 private:
  int tight_steps_ = 0;
};
}  // namespace sigloc

// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/methods/particles/MonteCarloSettings.h"

#include <fmt/core.h>
#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "eval/data/method_names.h"
#include "eval/data/occupancy_grid.h"
#include "io/archive/gzip_input.h"

namespace sigloc
{
using mrpt::maps::COccupancyGridMap2D;
using mrpt::obs::CActionRobotMovement2D;

namespace
{
// About 200 particles a square metre give 80-90 % success. The maximum is the most that a robot's
// processor can handle: a step of 200 000 takes a quarter of a second.
constexpr double kTunedDensity = 200;  // [1/m^2]
constexpr double kTunedLeast = 40000;
constexpr double kTunedMost = 200000;

// Chosen on drives of aces, by scripts/choose_filter_claim.
constexpr double kBestTempering = 0.1;
constexpr double kBestReliability = 0.65;

// As the shipped configuration has them.
constexpr const char* kMapSections = R"(
[MetricMap]
occupancyGrid_count=1
gasGrid_count=0
pointsMap_count=0
beaconMap_count=0
likelihoodMapSelection=-1

[MetricMap_occupancyGrid_00_creationOpts]
resolution=0.06

[MetricMap_occupancyGrid_00_insertOpts]
mapAltitude=0
useMapAltitude=0
maxDistanceInsertion=15
maxOccupancyUpdateCertainty=0.55
considerInvalidRangesAsFreeSpace=1
minLaserScanNoiseStd=0.001

[MetricMap_occupancyGrid_00_likelihoodOpts]
likelihoodMethod=4
LF_stdHit=0.20
LF_maxCorrsDistance=0.30
LF_zHit=0.95
LF_zRandom=0.05
LF_maxRange=80
LF_alternateAverageMethod=0
LF_decimation=)";

CActionRobotMovement2D::TMotionModelOptions gaussianModel(const OdometryNoise& noise)
{
  CActionRobotMovement2D::TMotionModelOptions model;
  model.modelSelection = CActionRobotMovement2D::mmGaussian;
  model.gaussianModel.minStdXY = static_cast<float>(noise.sigma);
  model.gaussianModel.minStdPHI = static_cast<float>(noise.angle_deg * M_PI / 180);
  return model;
}
/// As many particles as the free area [m^2] needs, and more noise of the motion.
void tune(MonteCarloSettings& settings, double free_area)
{
  settings.particles =
      static_cast<std::uint32_t>(std::clamp(kTunedDensity * free_area, kTunedLeast, kTunedMost));
  settings.kld_maximum = settings.particles;
  settings.kld_minimum = 1000;
  settings.kld_bin = 0.5;
  settings.own_odometry = OdometryNoise{0.05, 2.0};
}
}  // namespace

MonteCarloSettings monteCarloSettings(const std::string& name, double free_area,
                                      const RelocationMethodOptions& options)
{
  MonteCarloSettings settings;
  settings.region = options.region;
  if (name == "mcl-fixed")
  {
    settings.adaptive = false;
  }
  else if (name == "mcl-tuned")
  {
    tune(settings, free_area);
  }
  else if (name == "mcl-best")
  {
    tune(settings, free_area);
    settings.beam_decimation = 1;
    settings.tempering = options.tempering.value_or(kBestTempering);
    settings.least_reliability = kBestReliability;
  }
  else if (name != "mcl" && name != "mcl-stock")
  {
    refuseMethod(name, trackingMethodNames());
  }
  if (options.particles)
  {
    settings.particles = *options.particles;
    settings.kld_maximum = std::max(settings.kld_maximum, *options.particles);
  }
  return settings;
}

double freeAreaOf(const EvaluationMap& map)
{
  if (!map.features->field()) return 0;
  const OccupancyRaster raster = rasterOf(*map.features->field());
  const auto free =
      static_cast<double>(std::count(raster.cells.begin(), raster.cells.end(), CellState::free));
  return free * raster.frame.resolution * raster.frame.resolution;
}

std::string toIni(const MonteCarloSettings& settings)
{
  return fmt::format(
             "[KLD_options]\nKLD_binSize_PHI_deg=10\nKLD_binSize_XY={:g}\nKLD_delta=0.01\n"
             "KLD_epsilon=0.01\nKLD_maxSampleSize={}\nKLD_minSampleSize={}\n"
             "KLD_minSamplesPerBin=0\n\n[PF_options]\nPF_algorithm=0\nresamplingMethod=0\n"
             "adaptiveSampleSize={:d}\npfAuxFilterOptimal_MaximumSearchSamples=10\nBETA=0.5\n"
             "sampleSize=1\n{}\n[DummyOdometryParams]\nminStdXY={:g}\nminStdPHI={:g}\n",
             settings.kld_bin, settings.kld_maximum, settings.kld_minimum, settings.adaptive,
             settings.tempering == 1 ? "" : fmt::format("powFactor={:g}\n", settings.tempering),
             settings.dummy_odometry.sigma, settings.dummy_odometry.angle_deg) +
         kMapSections + fmt::format("{}\n", settings.beam_decimation);
}

PoseRegion startRegionOf(const MonteCarloSettings& settings)
{
  constexpr double kFar = 1e9;  // [m]
  PoseRegion region = settings.region.value_or(PoseRegion{-kFar, kFar, -kFar, kFar, 0, M_PI});
  region.heading_tolerance = std::min(region.heading_tolerance, M_PI);
  return region;
}

bool isSimplemap(const std::filesystem::path& file)
{
  return detail::extensionOf(file) == ".simplemap";
}

mrpt::maps::CMultiMetricMap::Ptr localizationMapOf(const EvaluationMap& map, const std::string& ini)
{
  mrpt::config::CConfigFileMemory config(ini);
  mrpt::maps::TSetOfMetricMapInitializers initializers;
  initializers.loadFromConfigFile(config, "MetricMap");
  auto maps = mrpt::maps::CMultiMetricMap::Create();
  maps->setListOfMaps(initializers);
  if (isSimplemap(map.file))
  {
    mrpt::maps::CSimpleMap frames;
    if (!frames.loadFromFile(map.file.string()))
    {
      throw std::runtime_error(map.file.string() + ": cannot be read");
    }
    maps->loadFromSimpleMap(frames);
    return maps;
  }
  const auto grid = maps->mapByClass<COccupancyGridMap2D>();
  const auto likelihood_options = grid->likelihoodOptions;
  if (detail::extensionOf(map.file) == ".gridmap")
  {
    mrpt::io::CFileGZInputStream file(map.file.string());
    mrpt::serialization::archiveFrom(file) >> *grid;
  }
  else
  {
    *grid = *detail::occupancyGridOf(rasterOf(*map.features->field()));
  }
  grid->likelihoodOptions = likelihood_options;
  return maps;
}

mrpt::obs::CActionCollection actionsOf(const RawlogStep& step, const MonteCarloSettings& settings)
{
  mrpt::poses::CPose2D increment(step.motion ? step.motion->mean : mrpt::math::TPose2D());
  auto model = gaussianModel(settings.own_odometry.value_or(settings.dummy_odometry));
  const auto logged = step.actions ? step.actions->getBestMovementEstimation() : nullptr;
  if (logged && !settings.own_odometry)
  {
    if (logged->estimationMethod != CActionRobotMovement2D::emOdometry) return *step.actions;
    // Drawn anew: samples of a log's motion model depend on the random generator at the time of
    // reading.
    increment = logged->rawOdometryIncrementReading;
    model = logged->motionModelConfiguration;
  }
  CActionRobotMovement2D movement;
  movement.timestamp = mrpt::Clock::fromDouble(step.time);
  movement.computeFromOdometry(increment, model);
  mrpt::obs::CActionCollection actions;
  actions.insert(movement);
  return actions;
}

TrackingClaim TightCloud::claim(const mrpt::poses::CPose2D& mean,
                                const mrpt::math::CMatrixDouble33& covariance)
{
  constexpr double kDistance = 0.5;  // [m]
  constexpr double kAngle = 10 * M_PI / 180;  // [rad]
  constexpr int kSteps = 5;
  const bool tight = std::sqrt(covariance(0, 0) + covariance(1, 1)) < kDistance &&
                     std::sqrt(covariance(2, 2)) < kAngle;
  tight_steps_ = tight ? tight_steps_ + 1 : 0;
  TrackingClaim claim;
  claim.confident = tight_steps_ >= kSteps;
  claim.has_pose = true;
  claim.pose = mean.asTPose();
  return claim;
}
}  // namespace sigloc

// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/wakeup/wakeup_simulated.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <mutex>
#include <stdexcept>

#include "eval/process/cpu_time.h"
#include "eval/wakeup/wakeup_drive.h"
#include "eval/worlds/robot_simulation.h"
#include "eval/worlds/simulation_files.h"

namespace sigloc
{
namespace
{
using detail::WakeupDrive;

/// Failed drives of a method by their numbers, because worlds end in any order.
using NumberedFailures = std::map<std::size_t, FailedQuery>;

constexpr std::uint64_t kSizeStream = 400;  // of the random numbers, see Random
constexpr std::uint64_t kMapStream = 401;

std::uint64_t seedOf(std::uint64_t run_seed, std::uint64_t number)
{
  return run_seed * 1000003U + number;
}

/// Draws sizes and contents, which differ from building to building.
WorldOptions drawWorldOptions(WorldKind kind, Random& random)
{
  WorldOptions options;
  options.furniture_per_room = random.uniform(0.0, 4.0);
  if (kind == WorldKind::office)
  {
    options.width = random.uniform(16.0, 40.0);
    options.height = random.uniform(11.0, 15.0);
  }
  else if (kind == WorldKind::corridor)
  {
    options.width = random.uniform(4.0, 6.5);  // of a room
    options.height = random.uniform(3.5, 5.5);
    options.copies = 2 + static_cast<std::uint32_t>(random.index(5));
    options.jitter = random.uniform(0.05, 0.4);
  }
  else if (kind == WorldKind::hall)
  {
    options.width = random.uniform(24.0, 50.0);
    options.height = random.uniform(16.0, 30.0);
  }
  else if (kind == WorldKind::points)
  {
    options.density = random.uniform(0.05, 0.2);
    options.points = 300 + static_cast<std::uint32_t>(random.index(900));
    options.patches = 1 + static_cast<std::uint32_t>(random.index(4));
  }
  return options;
}

LandmarkSensorOptions drawLandmarkSensor(Random& random)
{
  LandmarkSensorOptions options;
  options.range = random.uniform(5, 10);
  options.sigma = random.uniform(0.03, 0.08);
  options.seen_share = random.uniform(0.7, 1.0);
  options.spurious_share = random.uniform(0.0, 0.4);
  return options;
}

LaserOptions drawLaser(Random& random)
{
  struct Model
  {
    std::uint32_t beams;
    double fov_deg;
    double max_range;
  };
  constexpr std::array<Model, 5> kModels = {
      {{181, 180, 30}, {361, 270, 30}, {360, 360, 12}, {271, 270, 10}, {181, 180, 8}}};
  const Model& model = kModels[random.index(kModels.size())];
  LaserOptions options;
  options.beams = model.beams;
  options.fov_deg = model.fov_deg;
  options.max_range = model.max_range;
  options.range_sigma = random.uniform(0.01, 0.03);
  return options;
}

struct SimulatedPlace
{
  WorldKind kind;
  std::uint64_t seed;
  World world;
  LaserOptions laser;
  LandmarkSensorOptions landmarks;  // in a world of points
};

SimulatedPlace makePlace(const SimulatedTrackOptions& options, std::size_t number)
{
  const std::uint64_t seed = seedOf(options.method.seed, number);
  constexpr std::array<WorldKind, 3> kUsual = {WorldKind::office, WorldKind::corridor,
                                               WorldKind::hall};
  const WorldKind kind = options.kinds.empty() ? kUsual[number % kUsual.size()]
                                               : options.kinds[number % options.kinds.size()];
  Random random(seed, kSizeStream);
  const WorldOptions sizes = drawWorldOptions(kind, random);
  const LaserOptions laser = drawLaser(random);
  return {kind, seed, makeWorld(kind, sizes, seed), laser, drawLandmarkSensor(random)};
}

/// The landmarks of a world as surveyed, with the whole map shifted.
EvaluationMap mapLandmarks(const SimulatedPlace& place, const SimulatedTrackOptions& options)
{
  Random random(place.seed, kMapStream);
  const double dx = options.map_sigma * random.normal();
  const double dy = options.map_sigma * random.normal();
  const Bounds& bounds = place.world.bounds;
  const double border = bounds.x_min + options.mapped_share * (bounds.x_max - bounds.x_min);
  std::vector<Feature> mapped;
  for (Feature landmark : LandmarkSimulator(place.world, place.landmarks).mappedLandmarks(random))
  {
    if (landmark.position.x > border) continue;
    landmark.position = {landmark.position.x + dx, landmark.position.y + dy};
    mapped.push_back(landmark);
  }
  // The survey states the error of each landmark, without the common one.
  const MapErrorModel error{0, 0, options.map_sigma, 0};
  EvaluationMap map;
  map.features = std::make_shared<const FeatureMap>(std::move(mapped), std::nullopt, error);
  return map;
}

/// The map of a mapping run through a world, deformed by the errors of its error model.
EvaluationMap mapPlace(const SimulatedPlace& place, const SimulatedTrackOptions& options)
{
  if (place.kind == WorldKind::points) return mapLandmarks(place, options);
  auto scans =
      simulateMapping(place.world, options.map_spacing, kRobotClearance, place.laser, place.seed);
  const Bounds& bounds = place.world.bounds;
  const double border = bounds.x_min + options.mapped_share * (bounds.x_max - bounds.x_min);
  scans.erase(
      std::remove_if(scans.begin(), scans.end(),
                     [&](const PosedScans& posed) { return posed.map_from_robot.x > border; }),
      scans.end());
  Random random(place.seed, kMapStream);
  const double dx = options.map_sigma * random.normal();
  const double dy = options.map_sigma * random.normal();
  for (PosedScans& posed : scans)
  {
    posed.map_from_robot.x += dx;
    posed.map_from_robot.y += dy;
  }
  EvaluationMap map = evaluationMapFromScans(scans);
  MapErrorModel error = map.features->error();
  error.common_sigma = options.map_sigma;
  error.common_turn_sigma = 0;
  map.features =
      std::make_shared<const FeatureMap>(map.features->features(), map.features->field(), error);
  return map;
}

/// The common part of the drives in one world.
class DrivenPlace
{
 public:
  DrivenPlace(const SimulatedPlace& place, const EvaluationMap& map,
              const SimulatedTrackOptions& options)
      : options_(options),
        map_(map),
        world_(changedWorld(place.world, {options.moved_share, 1.0, options.extra_items, 0.0},
                            place.seed)),
        space_(world_, kRobotClearance)
  {
    if (place.kind == WorldKind::points)
    {
      landmarks_.emplace(world_, drivingSensor(place.landmarks, options));
    }
    else
    {
      laser_.emplace(world_, drivingLaser(place.laser, options));
    }
  }

  std::shared_ptr<const FeatureMap> map() const { return map_.features; }

  WakeupDrive drive(std::uint64_t seed) const
  {
    DriveOptions how;
    how.metres = options_.travel;
    const std::vector<mrpt::math::TPose2D> truth = simulateTruth(space_, how, seed);
    const std::vector<MotionIncrement> motions = simulateOdometry(truth, {}, seed);
    Random random(seed, 12);
    WakeupDrive drive;
    drive.foreign = options_.foreign;
    for (std::size_t i = 0; i < truth.size(); ++i)
    {
      detail::WakeupDriveStep step;
      step.step.time = how.step_time * static_cast<double>(i);
      if (options_.odometry) step.step.motion = motions[i];
      step.step.frame = mrpt::obs::CSensoryFrame::Create();
      if (laser_)
      {
        step.step.scans = {laser_->scan(truth[i], random)};
        step.step.frame->insert(toRangeScan(step.step.scans.front(), step.step.time));
      }
      if (landmarks_) step.step.landmarks = landmarks_->observe(truth[i], random).features;
      step.truth = truth[i];
      step.mapped = options_.foreign || detail::isMapped(truth[i], map_.mapped_poses);
      if (i > 0)
      {
        step.travelled = drive.steps.back().travelled +
                         std::hypot(truth[i].x - truth[i - 1].x, truth[i].y - truth[i - 1].y);
      }
      drive.steps.push_back(std::move(step));
    }
    return drive;
  }

 private:
  static LaserOptions drivingLaser(LaserOptions laser, const SimulatedTrackOptions& options)
  {
    laser.clutter_share = options.clutter_share;
    return laser;
  }

  static LandmarkSensorOptions drivingSensor(LandmarkSensorOptions sensor,
                                             const SimulatedTrackOptions& options)
  {
    if (options.clutter_share > 0) sensor.spurious_share = options.clutter_share;
    return sensor;
  }

  const SimulatedTrackOptions& options_;
  const EvaluationMap& map_;
  World world_;
  FreeSpace space_;
  std::optional<LaserSimulator> laser_;  // the one or
  std::optional<LandmarkSimulator> landmarks_;  // in a world of points, the other
};

/// One drive of one method. A failed drive is added to `failures` while there is room.
Wakeup runDrive(const TrackingMethodFactory& factory, const std::string& method,
                const DrivenPlace& place, std::size_t number, const SimulatedTrackOptions& options,
                NumberedFailures& failures)
{
  // Drives and worlds draw from seeds of their own.
  constexpr std::uint64_t kDrives = 1U << 20U;
  constexpr std::uint64_t kSecondLegs = 1U << 21U;
  std::vector<WakeupDrive> drives = {place.drive(seedOf(options.method.seed, kDrives + number))};
  if (options.kidnap)
  {
    drives.push_back(place.drive(seedOf(options.method.seed, kSecondLegs + number)));
  }
  std::vector<detail::WakeupLeg> legs;
  legs.reserve(drives.size());
  for (const WakeupDrive& drive : drives) legs.push_back({&drive, 0, drive.steps.size()});
  const auto seed = static_cast<std::uint32_t>(seedOf(options.method.seed, number));
  Wakeup run = detail::runLegs(factory, legs, seed, simulationGates());
  run.start = number;
  if (failures.size() < options.keep_failures && isFailedRun(run))
  {
    failures.emplace(number, detail::failureOf(run, legs, method, place.map()));
  }
  return run;
}

/// Refuses an option that is given though no kind of world of the run depends on it.
void refuseUnused(const SimulatedTrackOptions& options, bool given, const std::string& name,
                  std::string_view key)
{
  const bool used =
      options.kinds.empty() || std::any_of(options.kinds.begin(), options.kinds.end(),
                                           [&](WorldKind kind) { return usesOption(kind, key); });
  if (given && !used) throw std::invalid_argument(name + ": has no use in these worlds");
}

void check(const SimulatedTrackOptions& options)
{
  if (options.drives == 0) throw std::invalid_argument("--simulate must be at least 1");
  if (options.drives_per_world == 0)
  {
    throw std::invalid_argument("--drives-per-world must be at least 1");
  }
  const bool lasers_only = std::any_of(options.methods.begin(), options.methods.end(),
                                       [](const std::string& name) { return name != "signature"; });
  if (lasers_only && std::find(options.kinds.begin(), options.kinds.end(), WorldKind::points) !=
                         options.kinds.end())
  {
    throw std::invalid_argument("--worlds points: only method signature tracks by landmarks");
  }
  if (options.kidnap && options.foreign)
  {
    throw std::invalid_argument("--kidnap: in a foreign map there is nothing to notice");
  }
  refuseUnused(options, options.moved_share > 0, "--moved-share", "moved_share");
  refuseUnused(options, options.extra_items > 0, "--unmapped", "extra_items");
  if (!(options.mapped_share > 0 && options.mapped_share <= 1))
  {
    throw std::invalid_argument("--mapped-share must be above 0, up to 1");
  }
  if (!(options.map_sigma >= 0)) throw std::invalid_argument("--map-sigma must not be negative");
  checkTrackingMethods(options.methods);
}
}  // namespace

WakeupReport runSimulatedTrack(const SimulatedTrackOptions& options)
{
  check(options);
  WakeupReport report;
  report.provenance = {options.command, options.method.seed, {}};
  report.foreign = options.foreign;
  report.gates = simulationGates();
  for (const std::string& name : options.methods)
  {
    report.methods.emplace_back();
    report.methods.back().name = name;
    report.methods.back().runs.resize(options.drives);
  }
  std::vector<NumberedFailures> failures(options.methods.size());
  const std::size_t worlds =
      (options.drives + options.drives_per_world - 1) / options.drives_per_world;
  std::mutex mutex;
  const auto run_world = [&](std::size_t index)
  {
    const SimulatedPlace place = makePlace(options, index);
    // Each number is another world, of all kinds in turn.
    const std::size_t mapped = options.foreign ? worlds + index + index / 3 : index;
    const EvaluationMap map =
        mapPlace(mapped == index ? place : makePlace(options, mapped), options);
    const DrivenPlace driven(place, map, options);
    const std::size_t first = index * options.drives_per_world;
    const std::size_t last =
        std::min<std::size_t>(first + options.drives_per_world, options.drives);
    std::vector<NumberedFailures> failed(options.methods.size());
    for (std::size_t m = 0; m < report.methods.size(); ++m)
    {
      WakeupMethodReport& method = report.methods[m];
      const auto factory = makeTrackingMethod(method.name, map, options.method);
      for (std::size_t number = first; number < last; ++number)
      {
        method.runs[number] = runDrive(*factory, method.name, driven, number, options, failed[m]);
        method.runs[number].group = toString(place.kind);
      }
    }
    const std::lock_guard<std::mutex> lock(mutex);
    for (std::size_t m = 0; m < failures.size(); ++m) failures[m].merge(failed[m]);
    report.map.add(*map.features, map.build_seconds);
  };
  runParallel(worlds, options.threads, run_world, "worlds", options.progress);
  for (std::size_t m = 0; m < failures.size(); ++m)
  {
    WakeupMethodReport& method = report.methods[m];
    method.peak_rss_mb = peakMemoryMb();
    for (auto& [number, failure] : failures[m])
    {
      if (method.failures.size() < options.keep_failures)
      {
        method.failures.push_back(std::move(failure));
      }
    }
  }
  return report;
}
}  // namespace sigloc

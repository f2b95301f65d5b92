// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/protocols/sweep.h"

#include <fmt/core.h>
#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <stdexcept>

#include "eval/process/cpu_time.h"
#include "eval/protocols/relocate.h"
#include "eval/protocols/swept_quantities.h"
#include "eval/worlds/FreeSpace.h"
#include "eval/worlds/robot_simulation.h"

namespace sigloc
{
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

namespace
{
constexpr double kMappingSpacing = 1.2;  // [m] between mapping scans
constexpr double kHeadingPerMetre = M_PI / 180 / 0.05;  // [rad/m] error of a mapping scan's pose
constexpr std::uint32_t kMaxWorlds = 1000;  // of a kind: seeds of two runs never share a world

struct WorldName
{
  WorldKind kind;
  std::uint64_t seed;

  std::string text() const { return fmt::format("{}-{}", toString(kind), seed); }
};

LaserOptions mappingLaser()
{
  LaserOptions laser;
  laser.max_range = 30;
  return laser;
}

/// A mapping run with errors in the poses of its scans.
EvaluationMap mapOf(const World& world, double sigma, std::uint64_t seed)
{
  std::vector<PosedScans> scans =
      simulateMapping(world, kMappingSpacing, kRobotClearance, mappingLaser(), seed);
  Random random(seed, 21);
  for (PosedScans& posed : scans)
  {
    posed.map_from_robot.x += sigma * random.normal();
    posed.map_from_robot.y += sigma * random.normal();
    posed.map_from_robot.phi += kHeadingPerMetre * sigma * random.normal();
  }
  return evaluationMapFromScans(scans);
}

World worldWhenAsked(const World& mapped, const SweepConditions& conditions, std::uint64_t seed)
{
  WorldChangeOptions change = conditions.change;
  const Bounds& b = mapped.bounds;
  const double area = (b.x_max - b.x_min) * (b.y_max - b.y_min);  // [m^2]
  change.extra_items +=
      static_cast<std::uint32_t>(std::lround(conditions.unmapped_items * area / 100));
  return changedWorld(mapped, change, seed);
}

/// True when the changes since mapping leave room for a robot. Unlike FreeSpace, it does not
/// require a path there: a robot may wake up behind a door that was shut.
bool hasRoom(const World& world, const TPoint2D& p)
{
  for (const Furniture& item : world.furniture)
  {
    const TPoint2D local = item.pose.inverseComposePoint(p);
    if (std::abs(local.x) < 0.5 * item.length + kRobotClearance &&
        std::abs(local.y) < 0.5 * item.width + kRobotClearance)
    {
      return false;
    }
  }
  return std::none_of(world.doors.begin(), world.doors.end(),
                      [&](const Door& door)
                      { return door.closed && distanceTo(door.leaf, p) < kRobotClearance; });
}

TPose2D randomPose(const FreeSpace& mapped, const World& asked, Random& random)
{
  constexpr int kAttempts = 10000;
  for (int attempt = 0; attempt < kAttempts; ++attempt)
  {
    const TPoint2D place = mapped.randomPlace(random);
    const double heading = random.uniform(-M_PI, M_PI);
    if (hasRoom(asked, place)) return {place.x, place.y, heading};
  }
  throw std::invalid_argument("sweep: no room left for a robot");
}

/// A robot that drives through an open door, in either direction.
TPose2D poseInDoor(const World& asked, Random& random)
{
  std::vector<const Door*> open;
  for (const Door& door : asked.doors)
  {
    if (!door.closed) open.push_back(&door);
  }
  if (open.empty()) throw std::invalid_argument("sweep: a world without doors has no thresholds");
  const WallSegment& leaf = open[random.index(open.size())]->leaf;
  const TPoint2D along = leaf.end - leaf.start;
  constexpr double kMostAskew = M_PI / 6;  // [rad]
  const TPoint2D place = leaf.start + along * random.uniform(0.45, 0.55);
  const double across = std::atan2(along.y, along.x) + (random.chance(0.5) ? 0.5 : -0.5) * M_PI;
  return {place.x, place.y, mrpt::math::wrapToPi(across + random.uniform(-kMostAskew, kMostAskew))};
}

/// The robot's laser when its rear (+1) or front (-1) wheels are raised by that height.
LaserOptions tiltedLaser(LaserOptions laser, double threshold, double side)
{
  constexpr double kWheelBase = 0.4;  // [m]
  laser.pitch_deg = side * std::atan(threshold / kWheelBase) * 180 / M_PI;
  return laser;
}

/// The scans of robots on the thresholds of doors, climbing and descending in turn.
std::vector<EvaluationQuery> queriesInDoors(const World& asked, const SweepConditions& conditions,
                                            const WorldName& name, std::uint32_t count)
{
  const LaserSimulator nose_up(asked, tiltedLaser(conditions.laser, *conditions.threshold, -1));
  const LaserSimulator nose_down(asked, tiltedLaser(conditions.laser, *conditions.threshold, 1));
  Random places(name.seed, 23);
  std::vector<EvaluationQuery> queries(count);
  for (std::uint32_t i = 0; i < count; ++i)
  {
    Random noise(name.seed, 1000 + i);
    queries[i].name = std::to_string(i);
    queries[i].truth = poseInDoor(asked, places);
    queries[i].scans = {(i % 2 == 0 ? nose_up : nose_down).scan(*queries[i].truth, noise)};
  }
  return queries;
}

/// The scans of robots at random poses. Poses and noise come from random streams that do not depend
/// on the swept quantity. So its values are compared on the same queries.
std::vector<EvaluationQuery> queriesIn(const World& mapped, const World& asked,
                                       const SweepConditions& conditions, const WorldName& name,
                                       std::uint32_t count)
{
  if (conditions.threshold) return queriesInDoors(asked, conditions, name, count);
  const FreeSpace space(mapped, kRobotClearance);
  const LaserSimulator simulator(asked, conditions.laser);
  Random places(name.seed, 22);
  std::vector<EvaluationQuery> queries(count);
  for (std::uint32_t i = 0; i < count; ++i)
  {
    Random noise(name.seed, 1000 + i);
    queries[i].name = std::to_string(i);
    queries[i].truth = randomPose(space, asked, places);
    queries[i].scans = {simulator.scan(*queries[i].truth, noise)};
  }
  return queries;
}

using Methods = std::vector<std::unique_ptr<RelocationMethod>>;

Methods makeMethods(const EvaluationMap& map, const SweepOptions& options)
{
  RelocationMethodOptions method;
  method.use_dense_field = options.use_dense_field;
  method.seed = options.seed;
  Methods methods;
  for (const std::string& name : options.methods)
  {
    methods.push_back(makeRelocationMethod(name, map, method));
  }
  return methods;
}

/// Runs all values in one world and appends to the rows.
class WorldRun
{
 public:
  WorldRun(const SweepOptions& options, const SweptQuantity& quantity, SweepReport& report)
      : options_(options), quantity_(quantity), report_(report)
  {
  }

  void run(const WorldName& name, double share_before, double share)
  {
    methods_.clear();
    const double value_share = share / static_cast<double>(options_.values.size());
    for (std::size_t i = 0; i < options_.values.size(); ++i)
    {
      SweepConditions conditions;
      quantity_.set(options_.values[i], conditions);
      if (methods_.empty() || quantity_.changes_map)
      {
        mapped_ = makeWorld(name.kind, conditions.world, name.seed);
        map_ = mapOf(mapped_, conditions.map_sigma, name.seed);
        report_.map.add(*map_.features, map_.build_seconds);
        methods_ = makeMethods(map_, options_);
      }
      const World asked = worldWhenAsked(mapped_, conditions, name.seed);
      const auto queries = queriesIn(mapped_, asked, conditions, name, options_.queries_per_world);
      ask(name, queries, i, share_before + static_cast<double>(i) * value_share, value_share);
    }
  }

 private:
  void ask(const WorldName& name, const std::vector<EvaluationQuery>& queries, std::size_t value,
           double share_before, double share)
  {
    const double method_share = share / static_cast<double>(methods_.size());
    for (std::size_t k = 0; k < methods_.size(); ++k)
    {
      const auto progress = [&](const std::string& world, double asked)
      {
        if (!options_.progress) return;
        options_.progress(world, share_before + method_share * (static_cast<double>(k) + asked));
      };
      const auto records = askQueries(*methods_[k], queries, simulationGates(), options_.threads,
                                      name.text(), progress);
      SweepRow& row = report_.rows[value * methods_.size() + k];
      for (const RelocationRecord& record : records) row.records.push_back({name.text(), record});
      auto failures = collectFailures(row.method, *methods_[k], map_, queries, records,
                                      options_.keep_failures - row.failures.size());
      for (FailedQuery& failure : failures) failure.query.name.insert(0, name.text() + "-");
      std::move(failures.begin(), failures.end(), std::back_inserter(row.failures));
    }
  }

  const SweepOptions& options_;
  const SweptQuantity& quantity_;
  SweepReport& report_;
  World mapped_;
  EvaluationMap map_;
  Methods methods_;
};

void check(const SweepOptions& options)
{
  checkRelocationMethods(options.methods);
  if (options.worlds_per_kind == 0 || options.worlds_per_kind > kMaxWorlds)
  {
    throw std::invalid_argument(fmt::format("sweep: worlds of a kind must be 1 to {}", kMaxWorlds));
  }
  if (options.queries_per_world == 0) throw std::invalid_argument("sweep: no queries to ask");
  checkSweptValues(sweptQuantity(options.over), options.values);
}
}  // namespace

SweepReport runSweep(const SweepOptions& given)
{
  SweepOptions options = given;
  const SweptQuantity& quantity = sweptQuantity(options.over);
  if (options.values.empty()) options.values = quantity.values;
  if (options.worlds.empty()) options.worlds = quantity.worlds;
  check(options);
  SweepReport report;
  report.over = quantity.name;
  report.label = quantity.label;
  report.provenance = {options.command, options.seed, {}};
  for (const double value : options.values)
  {
    for (const std::string& method : options.methods)
      report.rows.push_back({value, method, {}, {}});
  }
  std::vector<WorldName> names;
  for (const WorldKind kind : options.worlds)
  {
    for (std::uint32_t k = 0; k < options.worlds_per_kind; ++k)
    {
      names.push_back({kind, std::uint64_t{kMaxWorlds} * options.seed + k});
    }
  }
  WorldRun run(options, quantity, report);
  const double share = 1.0 / static_cast<double>(names.size());
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    run.run(names[i], share * static_cast<double>(i), share);
  }
  report.peak_rss_mb = peakMemoryMb();
  return report;
}
}  // namespace sigloc

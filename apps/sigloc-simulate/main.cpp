// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "eval/data/folder_output.h"
#include "eval/worlds/buildings/buildings.h"
#include "eval/worlds/robot_simulation.h"
#include "eval/worlds/simulation_files.h"
#include "eval/worlds/world_generators.h"
#include "number_option.h"
#include "out_option.h"
#include "run_app.h"
#include "sigloc/config/option_fields.h"

namespace
{
/// An option of which only some worlds make use.
struct SomeWorldsOption
{
  const CLI::Option* option;
  std::function<bool(sigloc::WorldKind)> used_in;
};

bool isScanned(sigloc::WorldKind kind)
{
  return kind != sigloc::WorldKind::points;
}

/// How the maps are made.
struct MapOptions
{
  double map_spacing = 1.5;
  double resolution = 0.05;

  template <class V>
  static void visitFields(V&& visit)
  {
    using O = MapOptions;
    visit(sigloc::OptionField{"map_spacing", &O::map_spacing, 0.2, 100.0,
                              "[m] between the mapping scans"});
    visit(sigloc::OptionField{"resolution", &O::resolution, 0.005, 1.0, "[m] of the grid map"});
  }
};

/// All that the command line sets.
struct Settings
{
  std::string world = "office";
  std::uint64_t seed = 1;
  std::uint64_t drive_seed = 0;
  std::string log = "action-frame";
  std::string out;
  MapOptions maps;
  sigloc::WorldOptions layout;
  sigloc::BuildingOptions buildings;
  sigloc::WorldChangeOptions changes;
  sigloc::LaserOptions laser;
  sigloc::LandmarkSensorOptions landmarks;
  sigloc::DriveOptions drive;
  sigloc::OdometryOptions odometry;
  std::vector<SomeWorldsOption> of_some_worlds;

  /// Throws std::invalid_argument for an option that is given though the world has no use for it.
  void checkUse(sigloc::WorldKind kind) const
  {
    for (const auto& [option, used_in] : of_some_worlds)
    {
      if (option->count() > 0 && !used_in(kind))
      {
        throw std::invalid_argument(option->get_name() + ": has no use in world " +
                                    sigloc::toString(kind));
      }
    }
  }
};

/// Adds one flag for each field of an options table, named after its key: range_sigma becomes
/// --range-sigma. Short names that people type are given as aliases. Returns the options by key.
template <class Options>
std::map<std::string, const CLI::Option*> addFlags(
    CLI::App& app, Options& options, const std::string& group, const std::string& prefix,
    const std::map<std::string, std::string>& aliases = {})
{
  std::map<std::string, const CLI::Option*> added;
  Options::visitFields(
      [&](const auto& field)
      {
        std::string name = "--" + prefix + field.key;
        std::replace(name.begin(), name.end(), '_', '-');
        const auto alias = aliases.find(field.key);
        if (alias != aliases.end()) name = alias->second + "," + name;
        added[field.key] =
            app.add_option(name, options.*(field.member), field.description)
                ->check(sigloc::numberFrom<decltype(field.minimum)>(field.minimum, field.maximum))
                ->group(group)
                ->capture_default_str();
      });
  return added;
}

using Predicate = std::function<bool(sigloc::WorldKind)>;

void describeOptions(CLI::App& app, Settings& settings)
{
  const auto limit = [&](const std::map<std::string, const CLI::Option*>& options,
                         const std::function<Predicate(const std::string& key)>& used_in)
  {
    for (const auto& [key, option] : options)
    {
      settings.of_some_worlds.push_back({option, used_in(key)});
    }
  };
  const auto by_key = [](const std::string& key)
  { return [key](sigloc::WorldKind kind) { return sigloc::usesOption(kind, key); }; };
  const auto scanned = [](const std::string& /*key*/) { return isScanned; };
  const auto unscanned = [](const std::string& /*key*/)
  { return [](sigloc::WorldKind kind) { return !isScanned(kind); }; };

  app.add_option("--world", settings.world, "office, corridor, hall, park, points or round")
      ->check(CLI::IsMember({"office", "corridor", "hall", "park", "points", "round"}))
      ->capture_default_str();
  const auto is_seed =
      sigloc::numberFrom<std::uint64_t>(0, std::numeric_limits<std::uint64_t>::max());
  app.add_option("--seed", settings.seed, "of the world and, by default, of the drive")
      ->check(is_seed)
      ->capture_default_str();
  app.add_option("--drive-seed", settings.drive_seed, "another drive in the same world")
      ->check(is_seed);
  app.add_option("--log", settings.log, "kind of rawlog: action-frame or observations")
      ->check(CLI::IsMember({"action-frame", "observations"}))
      ->capture_default_str();
  app.add_option(sigloc::kOut, settings.out, "folder for the files; made when missing")->required();
  limit(addFlags(app, settings.maps, "Maps", ""), scanned);
  limit(addFlags(app, settings.layout, "World", "", {{"furniture_per_room", "--furniture"}}),
        by_key);
  limit(addFlags(app, settings.buildings, "Buildings", ""), scanned);
  settings.of_some_worlds.push_back(
      {app.add_flag("--identical", settings.buildings.identical, "the buildings share one seed")
           ->group("Buildings"),
       isScanned});
  settings.of_some_worlds.push_back(
      {app.add_flag("--mirrored", settings.buildings.mirrored, "each building is its mirror image")
           ->group("Buildings"),
       isScanned});
  limit(addFlags(app, settings.changes, "What the drive finds changed since the map was made",
                 "drive-", {{"moved_share", "--moved-share"}, {"extra_items", "--unmapped"}}),
        by_key);
  limit(addFlags(app, settings.laser, "Laser", "",
                 {{"fov_deg", "--fov"},
                  {"max_range", "--range"},
                  {"range_sigma", "--noise"},
                  {"clutter_share", "--clutter"}}),
        scanned);
  limit(addFlags(app, settings.landmarks, "Landmark sensor (world points)", "landmark-"),
        unscanned);
  addFlags(app, settings.drive, "Drive", "", {{"max_steps", "--steps"}});
  addFlags(app, settings.odometry, "Odometry", "odometry-");
}

void simulateLandmarks(const Settings& settings, const std::filesystem::path& out,
                       const std::vector<sigloc::PlacedWorld>& buildings,
                       const std::string& command)
{
  using namespace sigloc;
  const World& world = buildings.front().world;
  const LandmarkSimulator sensor(world, settings.landmarks);
  Random random(settings.seed, 20);
  const auto steps = simulateLandmarkDrive(world, settings.drive, settings.odometry,
                                           settings.landmarks, settings.drive_seed);
  const auto kind =
      settings.log == "observations" ? RawlogKind::observations : RawlogKind::action_frame;
  writeLandmarks(sensor.mappedLandmarks(random), out / "map.txt");
  writeRawlog(steps, settings.odometry, kind, out / "drive.rawlog");
  writeTruth(steps, out / "truth.txt");
  writeSimulationNote(command,
                      "* `map.txt`: the mapped landmarks, rows `x y radius sigma`\n"
                      "* `drive.rawlog`: odometry and bearing-range observations\n"
                      "* `truth.txt`: the true path, rows `time x y phi`\n",
                      out);
}

void simulateLaser(const Settings& settings, const std::filesystem::path& out,
                   const std::vector<sigloc::PlacedWorld>& buildings, const std::string& command)
{
  using namespace sigloc;
  checkOptions(settings.maps);
  const double clearance = settings.drive.clearance;
  const auto mapping = simulateMapping(buildings, settings.maps.map_spacing, clearance,
                                       settings.laser, settings.seed);
  writeSimpleMap(mapping, out / "map.simplemap");
  writeGridMap(buildings, settings.maps.resolution, out / "map.gridmap.gz");
  const auto driven = changedBuildings(buildings, settings.changes, settings.seed);
  const auto steps = simulateDrive(driven.front().world, settings.drive, settings.odometry,
                                   settings.laser, settings.drive_seed);
  const auto kind =
      settings.log == "observations" ? RawlogKind::observations : RawlogKind::action_frame;
  writeRawlog(steps, settings.odometry, kind, out / "drive.rawlog");
  writeTruth(steps, out / "truth.txt");
  std::string files =
      "* `map.simplemap`: mapping scans with their exact poses\n"
      "* `map.gridmap.gz`: the same world as an occupancy grid\n"
      "* `drive.rawlog`: odometry and scans of a drive; the mapping scans are not "
      "in it\n"
      "* `truth.txt`: the true path, rows `time x y phi`\n";
  if (settings.buildings.queries > 0)
  {
    writeSimpleMap(simulateQueries(driven, settings.buildings.queries, clearance, settings.laser,
                                   settings.drive_seed),
                   out / "queries.simplemap");
    files +=
        "* `queries.simplemap`: scans at random poses of random buildings, with their exact "
        "poses\n";
  }
  writeSimulationNote(command, files, out);
}

/// The command that makes the same files again.
std::string commandOf(int argc, char** argv)
{
  std::string command = "sigloc-simulate";
  for (int i = 1; i < argc; ++i)
  {
    // The folder is where the reader found the note: naming another would only mislead.
    const std::string argument = argv[i];
    const auto is_out = [&](const char* name) { return argument.rfind(name, 0) == 0; };
    if (argument == "--out" || argument == "-o") ++i;
    command += " " + (is_out("--out") || is_out("-o") ? "--out DIR" : argument);
  }
  return command;
}

void simulate(const Settings& settings, const std::string& command)
{
  const sigloc::WorldKind kind = sigloc::worldKindFrom(settings.world);
  settings.checkUse(kind);
  sigloc::checkSimulationFolder(settings.out);
  const auto buildings =
      sigloc::makeBuildings(kind, settings.layout, settings.buildings, settings.seed);
  const auto write = isScanned(kind) ? simulateLaser : simulateLandmarks;
  sigloc::fillFolder(settings.out, [&](const std::filesystem::path& part)
                     { write(settings, part, buildings, command); });
}
}  // namespace

int main(int argc, char** argv)
{
  Settings settings;
  CLI::App app(
      "Makes a world from a seed, maps of it, a log of a robot driving through, and truth.",
      "sigloc-simulate");
  describeOptions(app, settings);
  const auto work = [&]
  {
    if (app.count("--drive-seed") == 0) settings.drive_seed = settings.seed;
    simulate(settings, commandOf(argc, argv));
    return 0;
  };
  return sigloc::runApp(app, argc, argv, work);
}

// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/wakeup/wakeup.h"

#include <algorithm>
#include <iostream>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "commands.h"
#include "eval/reports/report_files.h"
#include "eval/wakeup/wakeup_simulated.h"
#include "failure_pictures.h"
#include "reading_arguments.h"

namespace sigloc
{
namespace
{
constexpr double kMostParticles = 1e7;

struct TrackFlags
{
  CommonOptions common;
  WakeupOptions options;
  std::vector<double> map_from_truth;
  ReadingArguments reading;

  SimulatedTrackOptions simulated;
  std::vector<std::string> worlds;

  int run(const std::string& command_line)
  {
    checkReportFolder(common.out,
                      inputFiles(options.map, {options.frames, options.rawlog, options.ground_truth,
                                               options.start_from}));
    const WakeupReport report =
        simulated.drives > 0 ? runSimulated(command_line) : runLog(command_line);
    writeWakeupReport(report, common.out);
    FailuresByFolder failures;
    for (const auto& method : report.methods) failures.emplace_back("", method.failures);
    drawFailures(failures, common.out);
    if (!common.quiet) std::cout << wakeupTable(report);
    return exitCode(report.complete, options.rawlog);
  }

  /// Refuses options that no method of the run has a use for.
  void checkUse(const std::vector<std::string>& methods, bool landmarks_only) const
  {
    common.checkDense(methods, !landmarks_only);
    const bool filters =
        std::any_of(methods.begin(), methods.end(),
                    [](const std::string& name) { return name.find("mcl") != std::string::npos; });
    if (options.method.particles && !filters)
    {
      throw std::invalid_argument("--particles: no particle filter is to be run");
    }
    if (options.method.tempering &&
        std::find(methods.begin(), methods.end(), "mcl-best") == methods.end())
    {
      throw std::invalid_argument("--tempering: mcl-best is not to be run");
    }
  }

  WakeupReport runLog(const std::string& command_line)
  {
    const bool landmarks = !options.landmarks.empty();
    if (landmarks != !options.landmark_folder.empty())
    {
      throw std::invalid_argument("--landmarks and --landmark-folder need each other");
    }
    if (landmarks && options.landmarks == "victoria-park")
    {
      options.gates.right_distance = 1.0;  // its truth is itself off by up to 0.3 m
    }
    const bool own_frames = !options.frames.empty();
    const bool drives_frames = own_frames && options.rawlog.empty();
    for (const auto& [path, name, spared] :
         {std::tuple{options.map, "--map", own_frames},
          std::tuple{options.rawlog, "--rawlog", own_frames},
          std::tuple{options.ground_truth, "--ground-truth", options.foreign || drives_frames}})
    {
      if (path.empty() && !landmarks && !spared)
      {
        throw std::invalid_argument(std::string(name) + " is required");
      }
    }
    options.reading = reading.in({own_frames ? options.frames : options.map});
    options.map_from_truth = poseOfFlag(map_from_truth);
    if (landmarks) options.methods = {"signature"};
    common.passTo(options, command_line);
    checkUse(options.methods, landmarks);
    common.passToMethods(options);
    if (common.max_queries > 0) options.starts = std::min(options.starts, common.max_queries);
    return runWakeups(options);
  }

  WakeupReport runSimulated(const std::string& command_line)
  {
    for (const std::string& name : worlds) simulated.kinds.push_back(worldKindFrom(name));
    simulated.travel = options.travel;
    simulated.kidnap = options.kidnap;
    simulated.odometry = options.odometry;
    simulated.foreign = options.foreign;
    common.passTo(simulated, command_line);
    checkUse(simulated.methods,
             !simulated.kinds.empty() &&
                 std::all_of(simulated.kinds.begin(), simulated.kinds.end(),
                             [](WorldKind kind) { return kind == WorldKind::points; }));
    common.passToMethods(simulated);
    simulated.method.particles = options.method.particles;
    simulated.method.tempering = options.method.tempering;
    if (common.max_queries > 0) simulated.drives = std::min(simulated.drives, common.max_queries);
    return runSimulatedTrack(simulated);
  }
};

void declareSimulation(CLI::App& command, TrackFlags& flags)
{
  const std::string group = "Simulated drives";
  SimulatedTrackOptions& options = flags.simulated;
  options.drives = 0;
  CLI::Option* const simulate =
      command
          .add_option("--simulate", options.drives,
                      "drives in simulated worlds, instead of --map, --rawlog, --ground-truth")
          ->check(numberFrom(1, 1e7));
  for (const char* of_logs :
       {"--map", "--frames", "--rawlog", "--ground-truth", "--start-from", "--map-from-truth",
        "--starts", "--apart", "--landmarks", "--landmark-folder"})
  {
    simulate->excludes(command.get_option(of_logs));
  }
  for (const char* of_truth : {"--ground-truth", "--start-from", "--map-from-truth", "--landmarks"})
  {
    command.get_option("--foreign")->excludes(command.get_option(of_truth));
  }
  for (const char* of_scans :
       {"--map", "--frames", "--rawlog", "--ground-truth", "--start-from", "--map-from-truth"})
  {
    command.get_option("--landmarks")->excludes(command.get_option(of_scans));
  }
  command.add_option("--drives-per-world", options.drives_per_world, "that share one world")
      ->capture_default_str();
  command.add_option("--worlds", flags.worlds, "office,corridor,hall,park,points: kinds, in turn")
      ->delimiter(',');
  addNumber(command, "--clutter", options.clutter_share, "share of beams that end too early", 0, 1);
  addNumber(command, "--moved-share", options.moved_share, "share of furniture moved since mapped",
            0, 1);
  command.add_option("--unmapped", options.extra_items, "pieces of furniture added since mapped")
      ->capture_default_str();
  addNumber(command, "--mapped-share", options.mapped_share, "share of the world that is mapped",
            1e-3, 1);
  addNumber(command, "--map-sigma", options.map_sigma, "[m] error common to all of a map", 0, 100);
  simulate->group(group);
  for (const char* of_simulations : {"--drives-per-world", "--worlds", "--clutter", "--moved-share",
                                     "--unmapped", "--mapped-share", "--map-sigma"})
  {
    command.get_option(of_simulations)->needs(simulate)->group(group);
  }
}
}  // namespace

std::function<int()> setUpTrack(CLI::App& command, const std::string& command_line)
{
  const auto flags = std::make_shared<TrackFlags>();
  WakeupOptions& options = flags->options;
  command.add_option("--map", options.map, "whatever sigloc-map build takes");
  flags->reading.declare(command);
  command.add_option("--rawlog", options.rawlog, "the drive");
  command.add_option("--ground-truth", options.ground_truth,
                     "truth of the drive: rows `time x y phi`, 3 or 7 columns, or a simplemap");
  CLI::Option* const frames =
      command
          .add_option("--frames", options.frames,
                      "simplemap of a whole drive: its first 60 % are the map, robots wake up in "
                      "the rest, on mapped area; without --rawlog its odometry is made")
          ->excludes("--map");
  command.add_flag("--reversed", options.reversed, "the last 60 % of --frames are the map")
      ->needs(frames);
  command.add_option("--landmarks", options.landmarks,
                     "dlr or victoria-park: a landmark log in place of these");
  command.add_option("--landmark-folder", options.landmark_folder, "where it is");
  command
      .add_option("--starts", options.starts,
                  "places to wake up at, spaced along the drive; more than it has are refused")
      ->capture_default_str();
  command
      .add_flag("--apart", options.apart, "as many starts as there are whose drives do not overlap")
      ->excludes("--starts");
  addNumber(command, "--travel", options.travel, "[m] driven after each", 0, 1e6);
  command.add_option("--start-from", options.start_from,
                     "simplemap: wake up only where its key frames were taken");
  addNumber(command, "--tempering", options.method.tempering,
            "of mcl-best: exponent of a scan's likelihood, instead of its own", 1e-6, 1);
  addNumber(command, "--particles", options.method.particles,
            "of the particle filters, instead of their own number", 1, kMostParticles);
  command.add_flag("--foreign", options.foreign,
                   "the map is of another place: every claim is wrong, and no truth is read");
  command.add_flag("--kidnap", options.kidnap, "half-way, carry the robot to another start");
  command.add_flag("!--no-odometry", options.odometry, "scans alone");
  addPoseOption(command, "--map-from-truth", flags->map_from_truth,
                "frame of the truth in the map");
  for (const char* of_two_files : {"--start-from", "--foreign", "--map-from-truth"})
  {
    frames->excludes(command.get_option(of_two_files));
  }
  declareSimulation(command, *flags);
  flags->common.declare(command, trackingMethodNames());
  return [flags, command_line] { return flags->run(command_line); };
}
}  // namespace sigloc

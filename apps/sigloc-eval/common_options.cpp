// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common_options.h"

#include <fmt/core.h>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <stdexcept>

#include "eval/data/method_names.h"
#include "out_option.h"
#include "sigloc/io/map_files.h"
#include "warn.h"

namespace sigloc
{
namespace
{
constexpr double kFar = 1e7;  // [m], [deg]
}

void CommonOptions::declareRunning(CLI::App& command)
{
  command.add_option("--seed", seed, "of everything random")->capture_default_str();
  addNumber(command, "--threads", threads, "queries asked at a time; each is timed on its own", 1,
            256);
  command.add_flag("--quiet", quiet, "no progress bar, no table");
  command
      .add_option(kOut, out,
                  "folder for summary.json, results.csv, report.md, report.html and plots; an "
                  "earlier run's are "
                  "replaced, other files of these names are not")
      ->required();
}

void CommonOptions::declare(CLI::App& command, const std::vector<std::string>& known_methods)
{
  command
      .add_option("--method", methods,
                  "methods to run, separated by commas, of: " + joined(known_methods))
      ->delimiter(',');
  command.add_option("--max-queries", max_queries, "ask this many, evenly spaced (default: all)")
      ->check(numberFrom(1, std::numeric_limits<std::uint32_t>::max()));
  command.add_option("--region", region, "x0,x1,y0,y1 [m]: the robot is known to be inside")
      ->check(numberFrom(-kFar, kFar))
      ->delimiter(',')
      ->expected(4);
  command.add_option("--heading", heading, "heading and tolerance [deg]: known roughly")
      ->check(numberFrom(-360, 360))
      ->delimiter(',')
      ->expected(2);
  command.add_option("--draw-failures", draw_failures,
                     "pictures of the first so many failures of each method (and value or size)");
  command.add_flag("--no-dense", no_dense, "the signature methods do without the dense field");
  declareRunning(command);
}

void CommonOptions::refusePrior(const std::string& command) const
{
  if (!region.empty() || !heading.empty())
  {
    throw std::invalid_argument(command + " takes no --region or --heading");
  }
}

void CommonOptions::checkDense(const std::vector<std::string>& methods_run, bool has_field) const
{
  if (!no_dense) return;
  if (!has_field) throw std::invalid_argument("--no-dense: maps of landmarks have no dense field");
  const bool used =
      std::any_of(methods_run.begin(), methods_run.end(),
                  [](const std::string& name) { return name.rfind("signature", 0) == 0; });
  if (!used) throw std::invalid_argument("--no-dense: no signature method is to be run");
}

std::optional<PoseRegion> CommonOptions::poseRegion() const
{
  if (region.empty() && heading.empty()) return std::nullopt;
  PoseRegion prior{-kFar, kFar, -kFar, kFar};
  if (!region.empty())
  {
    prior.x_min = region[0];
    prior.x_max = region[1];
    prior.y_min = region[2];
    prior.y_max = region[3];
    if (prior.x_min > prior.x_max || prior.y_min > prior.y_max)
    {
      throw std::invalid_argument("--region: the lower bound exceeds the upper one");
    }
  }
  if (!heading.empty())
  {
    if (heading[1] < 0) throw std::invalid_argument("--heading: the tolerance is negative");
    prior.heading = heading[0] * M_PI / 180;
    prior.heading_tolerance = heading[1] * M_PI / 180;
  }
  return prior;
}

CLI::Option* addPoseOption(CLI::App& command, const std::string& name, std::vector<double>& values,
                           const std::string& description)
{
  return command.add_option(name, values, "x,y,deg: " + description)
      ->delimiter(',')
      ->expected(3)
      ->check(numberFrom(-kFar, kFar));
}

mrpt::math::TPose2D poseOfFlag(const std::vector<double>& values)
{
  if (values.empty()) return {};
  return {values[0], values[1], values[2] * M_PI / 180};
}

std::vector<std::filesystem::path> inputFiles(const std::filesystem::path& map,
                                              std::vector<std::filesystem::path> others)
{
  if (map.empty()) return others;
  for (const std::filesystem::path& file : filesOfMapSource(map)) others.push_back(file);
  return others;
}

int exitCode(bool complete, const std::filesystem::path& rawlog)
{
  if (complete) return 0;
  warn("sigloc-eval", rawlog, "truncated, only what comes before the damage was used");
  return 2;
}

ShowProgress progressBar(bool quiet)
{
  if (quiet || isatty(STDERR_FILENO) == 0) return {};
  return [](const std::string& what, double share)
  {
    const std::string bar(static_cast<std::size_t>(std::lround(40 * share)), '#');
    std::cerr << fmt::format("\r{:<20} [{:<40}] {:3} %{}", what, bar, std::lround(100 * share),
                             share >= 1 ? "\n" : "")
              << std::flush;
  };
}
}  // namespace sigloc

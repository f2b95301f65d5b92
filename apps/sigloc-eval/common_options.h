// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPose2D.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "eval/process/run_parallel.h"
#include "number_option.h"
#include "sigloc/matching/SignatureMatcher.h"

namespace sigloc
{
/// Returns a progress bar on stderr, or an empty function when it is no terminal or `quiet`.
ShowProgress progressBar(bool quiet);

/// The options that every sub-command takes.
struct CommonOptions
{
  std::vector<std::string> methods;
  std::uint32_t max_queries = 0;
  std::uint32_t seed = 1;
  std::uint32_t threads = 1;
  std::vector<double> region;  ///< x0,x1,y0,y1
  std::vector<double> heading;  ///< degrees, tolerance
  bool no_dense = false;
  std::uint32_t draw_failures = 0;
  bool quiet = false;
  std::string out;

  // The object must live as long as the command.

  /// Declares all of them; the help names the methods there are.
  void declare(CLI::App& command, const std::vector<std::string>& known_methods);

  /// Declares --seed, --threads, --quiet and --out alone, for commands without methods to choose.
  void declareRunning(CLI::App& command);

  /// Throws std::invalid_argument when --region or --heading is given to a command that uses many
  /// maps or none.
  void refusePrior(const std::string& command) const;

  /// Throws std::invalid_argument when --no-dense is given to a run in which no method could use a
  /// dense field: `has_field` is whether its maps have one.
  void checkDense(const std::vector<std::string>& methods_run, bool has_field) const;

  /// Sets the methods, if any are named, the failures to keep and the command line.
  template <class Options>
  void passTo(Options& options, const std::string& command_line) const
  {
    if (!methods.empty()) options.methods = methods;
    options.keep_failures = draw_failures;
    options.command = command_line;
  }

  /// Sets how the methods that use a dense field are run: seed, prior, field, threads, progress.
  template <class Options>
  void passToMethods(Options& options) const
  {
    options.method.seed = seed;
    options.method.region = poseRegion();
    options.method.use_dense_field = !no_dense;
    options.threads = threads;
    options.progress = progressBar(quiet);
  }

  /// The prior that --region and --heading give together.
  std::optional<PoseRegion> poseRegion() const;
};

/// Adds an option "x,y,deg", a pose whose numbers are bounded.
CLI::Option* addPoseOption(CLI::App& command, const std::string& name, std::vector<double>& values,
                           const std::string& description);

/// Returns the pose of such an option; the identity for an empty list.
mrpt::math::TPose2D poseOfFlag(const std::vector<double>& values);

/// Returns the files that a run reads: those of a map source, none for an empty path, and `others`.
/// Throws as filesOfMapSource() does.
std::vector<std::filesystem::path> inputFiles(const std::filesystem::path& map,
                                              std::vector<std::filesystem::path> others);

/// Returns 0. When the rawlog was truncated, writes a line to stderr and returns 2: its readable
/// part was used.
int exitCode(bool complete, const std::filesystem::path& rawlog);
}  // namespace sigloc

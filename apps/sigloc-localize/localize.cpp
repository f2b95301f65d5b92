// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <iostream>
#include <optional>
#include <vector>

#include "arguments.h"
#include "console.h"
#include "sigloc/io/file_output.h"
#include "sigloc/io/map_files.h"
#include "sigloc/localize/RunWriter.h"
#include "StepPictures.h"
#include "warn.h"

namespace
{
namespace fs = std::filesystem;

constexpr const char* kProgram = "sigloc-localize";
constexpr int kTruncatedInput = 2;

constexpr const char* kDefaultsHeader =
    "# SPDX-FileCopyrightText: 2026 the sigloc authors\n"
    "# SPDX-License-Identifier: BSD-3-Clause\n"
    "#\n"
    "# Every option of sigloc with its default, made with: sigloc-localize --print-defaults\n"
    "# The tracker is chosen in pf-localization's section [LocalizationExperiment]:\n"
    "# tracker = gaussians ([sigloc.tracker]), or particles ([sigloc.particles])\n";

/// Runs once, adding to `outcomes`; returns the exit code. Prints what is held once the run has
/// begun.
int localize(const sigloc::LocalizationSetup& setup, bool quiet, sigloc::HeldWarnings& held,
             std::vector<sigloc::ExperimentOutcome>& outcomes)
{
  std::optional<sigloc::RunWriter> writer;
  if (!setup.output_folder.empty()) writer.emplace(setup.output_folder, setup.inputFiles());
  sigloc::Progress progress(quiet);
  sigloc::LocalizationRun run(setup, sigloc::mapCacheFile(setup.map_file),
                              [&](double share) { progress.showMap(share); });
  progress.finish();
  held.print(kProgram);
  if (!run.summary().map_reused)
    sigloc::warn(kProgram, setup.map_file, sigloc::warningOfMapSource(setup.map_file));
  sigloc::warn(kProgram, setup.map_file, sigloc::warningOfMap(run.map()));
  std::optional<sigloc::StepPictures> pictures;
  const bool every_step = writer && !setup.stats_only;
  if (every_step) pictures.emplace(run);
  while (const sigloc::StepRecord* step = run.next())
  {
    progress.show(run);
    if (!every_step) continue;
    if (setup.report.beliefs) writer->writeBelief(*step, run.anywhere());
    pictures->take(run, *writer);
  }
  progress.finish();
  if (writer) writer->finish(run);
  outcomes.push_back(sigloc::outcomeOf(run));
  std::cout << sigloc::summaryTable(run);
  std::cout << "written to              "
            << (writer ? setup.output_folder.string() : "nothing: no --out, no logOutput_dir")
            << '\n';
  sigloc::warn(kProgram, setup.rawlog_file, sigloc::leftOutLine(run.summary().left_out));
  sigloc::warn(kProgram, setup.rawlog_file, run.summary().nothing_seen);
  if (!run.summary().truncated) return 0;
  sigloc::warn(kProgram, setup.rawlog_file,
               fmt::format("truncated or damaged after {} steps; the results cover those",
                           run.steps().size()));
  return kTruncatedInput;
}

/// The folder of one run: pf-localization's name for it where there are several.
fs::path runFolder(const sigloc::LocalizationSetup& setup, bool several, std::uint32_t repetition)
{
  if (setup.output_folder.empty() || !several) return setup.output_folder;
  std::string name = fmt::format("{}_{:03}", setup.output_folder.string(), repetition);
  if (setup.use_particles) name += fmt::format("_{:07}", setup.particles.particles);
  return name;
}

using Experiment = std::vector<sigloc::LocalizationSetup>;  // its repetitions

/// Every number of particles is an experiment; its repetitions share nothing but the map's cache.
std::vector<Experiment> experimentsOf(const sigloc::LocalizationSetup& setup)
{
  std::vector<std::uint32_t> counts = setup.particle_counts;
  if (counts.empty()) counts.push_back(setup.particles.particles);
  const bool several = setup.repetitions > 1 || counts.size() > 1;
  std::vector<Experiment> experiments;
  for (const std::uint32_t count : counts)
  {
    experiments.emplace_back(setup.repetitions, setup);
    for (std::uint32_t i = 0; i < setup.repetitions; ++i)
    {
      sigloc::LocalizationSetup& run = experiments.back()[i];
      run.particles.particles = count;
      run.matcher.seed = setup.matcher.seed + i;
      run.output_folder = runFolder(run, several, i);
    }
  }
  return experiments;
}

bool areSeveral(const std::vector<Experiment>& experiments)
{
  return experiments.size() > 1 || experiments.front().size() > 1;
}

/// Throws where a run would replace an input or a file of another origin. Called before any run
/// begins.
void checkOutputs(const sigloc::LocalizationSetup& setup,
                  const std::vector<Experiment>& experiments)
{
  if (setup.output_folder.empty()) return;
  const auto inputs = setup.inputFiles();
  sigloc::refuseToReplaceInputs(
      sigloc::experimentSummaryFile(setup.output_folder, areSeveral(experiments)), inputs);
  for (const Experiment& experiment : experiments)
  {
    for (const auto& run : experiment) sigloc::checkRunFolder(run.output_folder, inputs);
  }
}

sigloc::LocalizationSetup setupOf(const sigloc::LocalizeArguments& arguments)
{
  if (!arguments.config.empty())
  {
    return sigloc::readLocalizationSetup(arguments.config, arguments.rawlog, arguments.map);
  }
  sigloc::LocalizationSetup setup;
  setup.map_file = arguments.map;
  setup.rawlog_file = arguments.rawlog;
  return setup;
}

int runAll(const sigloc::LocalizeArguments& arguments)
{
  sigloc::LocalizationSetup setup = setupOf(arguments);
  sigloc::requireMapAndLog(setup);
  sigloc::HeldWarnings held(arguments.config, setup.warnings);
  if (arguments.output) setup.output_folder = *arguments.output;
  setup.reading = arguments.reading.in({setup.map_file}, setup.reading);
  if (arguments.seed) setup.matcher.seed = *arguments.seed;
  const std::vector<Experiment> experiments = experimentsOf(setup);
  checkOutputs(setup, experiments);
  int exit_code = 0;
  std::string summary;
  for (const Experiment& experiment : experiments)
  {
    std::vector<sigloc::ExperimentOutcome> outcomes;
    for (const auto& run : experiment)
    {
      exit_code = std::max(exit_code, localize(run, arguments.quiet, held, outcomes));
    }
    summary += sigloc::experimentSummary(outcomes, setup.confidence_share);
  }
  if (!setup.output_folder.empty())
  {
    sigloc::writeFile(sigloc::experimentSummaryFile(setup.output_folder, areSeveral(experiments)),
                      summary);
  }
  return exit_code;
}
}  // namespace

int siglocLocalize(const sigloc::LocalizeArguments& arguments)
{
  if (!arguments.print_defaults) return runAll(arguments);
  std::cout << kDefaultsHeader << sigloc::defaultOptionSections();
  return 0;
}

// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "localize/pf_localization_files.h"

#include "sigloc/localize/RunWriter.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <stdexcept>

#include "localize/quantile.h"
#include "sigloc/io/file_output.h"
#include "sigloc/plugin/pose_pdf.h"

namespace sigloc
{
namespace
{
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr double kSecond = 1e3;  // [ms]
constexpr const char* kSummaryEnding = "_SUMMARY.txt";

double volumeOf(const StepRecord& step, const GaussianPose& anywhere)
{
  if (step.belief.hypotheses.empty()) return kUnknown;
  const Belief whole = withElsewhere(step.belief, anywhere);
  return std::sqrt(std::max(0.0, momentsOf(whole).covariance.det()));
}

/// Mean distance of the hypotheses from the truth [m]; pf-localization's is that of the particles.
double errorOf(const StepRecord& step)
{
  if (!step.truth || step.belief.hypotheses.empty()) return kUnknown;
  double sum = 0;
  double weights = 0;
  for (const TrackedHypothesis& hypothesis : step.belief.hypotheses)
  {
    sum += hypothesis.weight * errorBetween(hypothesis.pose.mean, *step.truth).distance;
    weights += hypothesis.weight;
  }
  return weights > 0 ? sum / weights : kUnknown;
}

double secondsOf(const StepRecord& step)
{
  return (step.extraction_ms + step.tracking_ms) / kSecond;
}

/// Behind pf-localization's column those that it is the sum of.
std::string timesRow(const StepRecord& step, const GaussianPose& /*anywhere*/)
{
  return fmt::format("{:e} {:e} {:e}", secondsOf(step), step.extraction_ms / kSecond,
                     step.tracking_ms / kSecond);
}

std::string odometryRow(const StepRecord& step, const GaussianPose& /*anywhere*/)
{
  return fmt::format("{:f} {:f} {:f}", step.odometry.x, step.odometry.y, step.odometry.phi);
}

std::string statisticsRow(const StepRecord& step, const GaussianPose& anywhere)
{
  const auto& hypotheses = step.belief.hypotheses;
  const auto count = static_cast<double>(hypotheses.size());
  double sum = 0;
  double squares = 0;
  for (const TrackedHypothesis& hypothesis : hypotheses)
  {
    sum += hypothesis.weight;
    squares += hypothesis.weight * hypothesis.weight;
  }
  const double mean_square = sum > 0 ? squares / (sum * sum) : 0;  // of weights that sum to one
  const double effective = sum > 0 ? 1 / mean_square : 0;
  const double variance = sum > 0 ? (mean_square - 1 / count) / count : 0;
  return fmt::format("{} {:e} {:e} {:f} {:f}", hypotheses.size(), effective,
                     std::max(0.0, variance), step.belief.reliability, volumeOf(step, anywhere));
}

std::string numberRow(double value)
{
  return fmt::format("{:e}", value);
}

struct StepFile
{
  const char* name;
  std::string (*row)(const StepRecord& step, const GaussianPose& anywhere);
  bool of_truth = false;  ///< empty where no step has a truth, as pf-localization's
};

constexpr StepFile kStepFiles[] = {
    {"cov_est.txt", [](const StepRecord& s, const GaussianPose& anywhere)
     { return numberRow(volumeOf(s, anywhere)); }},
    {"odo_est.txt", odometryRow},
    {"GT_error.txt",
     [](const StepRecord& s, const GaussianPose& /*anywhere*/) { return numberRow(errorOf(s)); },
     true},
    {"ODO_error.txt",
     [](const StepRecord& s, const GaussianPose& /*anywhere*/)
     { return numberRow(s.truth ? errorBetween(s.odometry, *s.truth).distance : kUnknown); },
     true},
    {"exec_times.txt", timesRow},
    {"PF_stats.txt", statisticsRow},
};

/// Rows `x y yaw log_weight` under MRPT's line of heads.
std::string particleRows(const mrpt::poses::CPosePDFParticles& samples)
{
  std::string rows = "% x  y  yaw[rad] log_weight\n";
  for (const auto& sample : samples.m_particles)
  {
    rows +=
        fmt::format("{:f} {:f} {:f} {:e}\n", sample.d.x, sample.d.y, sample.d.phi, sample.log_w);
  }
  return rows;
}

void writeParticles(const LocalizationRun& run, const std::filesystem::path& folder)
{
  constexpr std::size_t kSamples = 500;
  const std::uint32_t every = run.setup().scene_frequency;
  if (every == 0 || run.setup().stats_only) return;
  std::filesystem::create_directories(folder);
  for (const StepRecord& step : run.steps())
  {
    if ((step.number - 1) % every != 0 || step.belief.hypotheses.empty()) continue;
    const auto path = folder / fmt::format("particles_{:05}.txt", step.number);
    const Belief whole = withElsewhere(step.belief, run.anywhere());
    const auto samples = toParticles(whole, kSamples, run.setup().matcher.seed + step.number);
    writeFile(path, particleRows(samples), Durability::with_folder);
  }
}
}  // namespace

void writePfLocalizationFiles(const LocalizationRun& run, const std::filesystem::path& folder)
{
  const std::vector<StepRecord>& steps = run.steps();
  const bool has_truth = std::any_of(steps.begin(), steps.end(),
                                     [](const StepRecord& step) { return step.truth.has_value(); });
  for (const StepFile& kind : kStepFiles)
  {
    std::string rows;
    if (has_truth || !kind.of_truth)
    {
      for (const StepRecord& step : steps) rows += kind.row(step, run.anywhere()) + "\n";
    }
    writeFile(folder / kind.name, rows, Durability::with_folder);
  }
  writeParticles(run, folder / "particles");
}

const std::vector<std::string>& pfLocalizationFiles()
{
  static const std::vector<std::string> kNames = []
  {
    std::vector<std::string> names = {kSummaryEnding};
    for (const StepFile& kind : kStepFiles) names.emplace_back(kind.name);
    return names;
  }();
  return kNames;
}

ExperimentOutcome outcomeOf(const LocalizationRun& run)
{
  ExperimentOutcome outcome;
  outcome.converged = run.summary().converged;
  if (run.setup().use_particles) outcome.particles = run.setup().particles.particles;
  for (const StepRecord& step : run.steps())
  {
    outcome.seconds += secondsOf(step);
    const double error = errorOf(step);
    if (!std::isnan(error)) outcome.errors.push_back(error);
  }
  return outcome;
}

std::string experimentSummary(const std::vector<ExperimentOutcome>& repetitions,
                              double confidence_share)
{
  double tested = 0;
  double converged = 0;
  double seconds = 0;
  std::vector<double> errors;
  for (const ExperimentOutcome& outcome : repetitions)
  {
    if (outcome.converged)
    {
      ++tested;
      if (*outcome.converged) ++converged;
    }
    seconds += outcome.seconds;
    errors.insert(errors.end(), outcome.errors.begin(), outcome.errors.end());
  }
  std::sort(errors.begin(), errors.end());
  double mean = 0;
  for (const double error : errors) mean += error / static_cast<double>(errors.size());
  const auto quantile = [&](double share)
  { return errors.empty() ? kUnknown : detail::quantileOf(errors, share); };
  const double low = std::min(confidence_share, 1 - confidence_share);
  return fmt::format(
      "% Ratio_covergence_success  #particles  average_time_per_execution  "
      "convergence_mean_error convergence_error_conf_int_inf convergence_error_conf_int_sup\n"
      "{:f} {} {:f} {:f} {:f} {:f}\n",
      tested > 0 ? converged / tested : kUnknown,
      repetitions.empty() ? 0 : repetitions.front().particles,
      seconds / static_cast<double>(std::max<std::size_t>(1, repetitions.size())),
      errors.empty() ? kUnknown : mean, quantile(low), quantile(1 - low));
}

std::filesystem::path experimentSummaryFile(const std::filesystem::path& folder, bool several_runs)
{
  if (!several_runs) return folder / kSummaryEnding;
  // "out/" is "out".
  const auto named = folder.has_filename() ? folder : folder.parent_path();
  std::filesystem::path path = named.string() + kSummaryEnding;
  std::string first_word;
  std::ifstream(path) >> first_word;
  if (!first_word.empty() && first_word != "%")
  {
    throw std::runtime_error(path.string() + ": is no summary of an earlier run; not overwritten");
  }
  return path;
}
}  // namespace sigloc

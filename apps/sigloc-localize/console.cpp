// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "console.h"

#include <fmt/core.h>
#include <mrpt/core/bits_math.h>

#include <cmath>
#include <iostream>
#include <sstream>

#include "sigloc/config/plural.h"
#include "verdict_text.h"

namespace sigloc
{
namespace
{
std::string reached(const std::optional<std::size_t>& step, const std::optional<double>& metres)
{
  if (!step) return "never";
  return fmt::format("step {}", *step) + (metres ? fmt::format(", after {:.1f} m", *metres) : "");
}

std::string distanceText(bool known, double metres)
{
  return known ? fmt::format("{:.1f} m", metres) : "distance unknown";
}

std::string timing(const StepTimes& times)
{
  if (times.steps == 0) return "none";
  return fmt::format("{:.2f} ms in the median, {:.2f} ms in 95 % ({})", times.median, times.p95,
                     times.steps);
}

std::string mapLine(const RunSummary& summary, const LocalizationRun& run)
{
  const std::filesystem::path& file = run.setup().map_file;
  const bool ready = file.extension() == ".sigmap";
  const std::string how =
      summary.map_reused
          ? "unchanged since the last run, reused"
          : fmt::format("{} in {:.1f} s", ready ? "loaded" : "built", summary.map_seconds);
  return fmt::format("{}: {}, {}", file.filename().string(),
                     counted(run.map().features().size(), "feature"), how);
}

/// For how much of the drive the robot was localized.
std::string sureLine(const RunSummary& summary)
{
  std::string line =
      fmt::format("{} of {}", summary.localized_steps, counted(summary.steps, "step"));
  if (summary.localized_metres)
  {
    line += fmt::format(", {:.1f} of {:.1f} m", *summary.localized_metres, summary.distance);
  }
  return line + "; lost " + counted(summary.times_lost, "time");
}

/// Returns what may be wrong where poses and odometry differ much, else an empty text.
std::string doubtOfOdometry(const OdometryMatch& match)
{
  constexpr double kMostTurn = 5;  // [deg]
  constexpr double kMostStretch = 1.25;  // and its inverse
  const double turn = mrpt::RAD2DEG(match.turn);
  if (match.stretch < 1 / kMostStretch || match.stretch > kMostStretch)
  {
    return fmt::format("poses drive {:.2f} times as far: does the laser stand still?",
                       match.stretch);
  }
  if (std::abs(turn) <= kMostTurn) return {};
  return fmt::format("poses drive {:.1f} deg to the {}: is the yaw of the laser's mount right?",
                     std::abs(turn), turn > 0 ? "left" : "right");
}

std::string endLine(const RunSummary& summary, const Belief& belief)
{
  std::string line = summary.final_verdict == Verdict::localized ? "" : "NOT LOCALIZED: ";
  line += verdictText(belief);
  if (const auto& pose = summary.final_pose)
  {
    line += fmt::format(", first hypothesis ({:.2f} m, {:.2f} m, {:.1f} deg)", pose->x, pose->y,
                        mrpt::RAD2DEG(pose->phi));
  }
  return line;
}

std::string errorText(const PoseError& error)
{
  return fmt::format("{:.2f} m, {:.1f} deg", error.distance, mrpt::RAD2DEG(error.angle));
}
}  // namespace

Progress::Progress(bool quiet) : quiet_(quiet), line_(quiet) {}

void Progress::show(const LocalizationRun& run)
{
  if (quiet_) return;
  const StepRecord& step = run.steps().back();
  constexpr double kLines = 10;
  if (!line_.active() && run.progress() < next_line_) return;
  next_line_ = (std::floor(kLines * run.progress()) + 1) / kLines;
  const std::string line =
      fmt::format("{:3.0f} %  step {}  {}  {}  {}", 100 * run.progress(), step.number,
                  distanceText(step.travel_known, step.travelled), verdictText(step.belief),
                  counted(step.belief.hypotheses.size(), "hypothesis", "hypotheses"));
  if (line_.active())
  {
    line_.show(line);
  }
  else
  {
    std::cout << line << '\n';
  }
}

std::string leftOutLine(const LeftOutOfLog& left_out)
{
  std::string line;
  if (left_out.observations > 0)
  {
    line = counted(left_out.observations, "observation") +
           " left out (no beams, or a sensor that is tilted, far off or nowhere)";
  }
  if (left_out.motions > 0)
  {
    line += (line.empty() ? "" : "; ") + counted(left_out.motions, "motion") +
            " taken for unknown (a jump of the odometry, or no number)";
  }
  return line;
}

std::string summaryTable(const LocalizationRun& run)
{
  const RunSummary summary = run.summary();
  std::ostringstream table;
  const auto row = [&](const char* name, const std::string& value)
  { table << std::left << std::setw(24) << name << value << '\n'; };
  row("map", mapLine(summary, run));
  row("log", run.setup().rawlog_file.filename().string() +
                 fmt::format(": {}, {}{}", counted(summary.steps, "step"),
                             distanceText(!std::isnan(summary.distance), summary.distance),
                             summary.truncated ? ", TRUNCATED" : ""));
  if (!run.setup().ground_truth_file.empty())
  {
    row("first right hypothesis",
        reached(summary.steps_to_first_right, summary.metres_to_first_right));
  }
  row("localized", reached(summary.steps_to_localized, summary.metres_to_localized));
  if (summary.confidently_wrong_steps)
    row("confidently wrong", counted(*summary.confidently_wrong_steps, "step"));
  row("localized for", sureLine(summary));
  if (summary.odometry)
  {
    const std::string doubt = doubtOfOdometry(*summary.odometry);
    if (!doubt.empty()) row("against odometry", doubt);
  }
  row("at the end", endLine(summary, run.steps().back().belief));
  if (summary.final_verdict != Verdict::localized) row("why not sure", summary.final_reason);
  if (summary.final_error) row("final error", errorText(*summary.final_error));
  row("relocation", timing(summary.relocation));
  row("tracking step", timing(summary.tracking));
  return table.str();
}
}  // namespace sigloc

// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "StepPictures.h"

#include <fmt/core.h>
#include <mrpt/core/bits_math.h>

#include <filesystem>

#include "picture_file.h"
#include "sigloc/config/plural.h"
#include "verdict_text.h"

namespace sigloc
{
namespace
{
std::vector<std::string> titleOf(const StepRecord& step)
{
  const Belief& belief = step.belief;
  std::string second;
  if (step.error)
  {
    second = fmt::format("off by {:.2f} m, {:.1f} deg", step.error->distance,
                         mrpt::RAD2DEG(step.error->angle));
  }
  else if (step.truth)
  {
    second = "no pose";
  }
  return {fmt::format("step {}, {:.1f} m: {}, {}", step.number, step.travelled, verdictText(belief),
                      counted(belief.hypotheses.size(), "hypothesis", "hypotheses")),
          second};
}
}  // namespace

StepPictures::StepPictures(const LocalizationRun& run)
{
  if (run.setup().report.pictures) pictures_.emplace(run.map());
}

std::string StepPictures::keyMoment(const StepRecord& step)
{
  const auto first = [&](const char* moment) { return moments_seen_.insert(moment).second; };
  const bool ambiguous = step.belief.verdict == Verdict::ambiguous;
  if (step.relocated && first("first_relocation")) return "first_relocation";
  if (step.belief.verdict == Verdict::localized && first("localized")) return "localized";
  if (ambiguous && step.belief.hypotheses.size() > 1 && first("ambiguous")) return "ambiguous";
  return "";
}

/// "lost" and "found_again", the first few times.
std::string StepPictures::changeOfVerdict(const StepRecord& step)
{
  constexpr std::size_t kMostChanges = 8;
  const bool localized = step.belief.verdict == Verdict::localized;
  const bool changed = localized != was_localized_ && moments_seen_.count("localized") > 0;
  was_localized_ = localized;
  if (!changed || changes_ == kMostChanges) return "";
  ++changes_;
  return localized ? "found_again" : "lost";
}

void StepPictures::take(const LocalizationRun& run, const RunWriter& writer)
{
  const StepRecord& step = run.steps().back();
  if (step.belief.verdict == Verdict::localized)
  {
    path_.push_back(step.belief.hypotheses.front().pose.mean);
  }
  const std::string change = changeOfVerdict(step);
  std::string moment = keyMoment(step);
  if (moment.empty()) moment = change;
  if (run.atEnd()) moment = "end";
  const std::uint32_t every = run.setup().scene_frequency;
  if (!moment.empty() || (every != 0 && (step.number - 1) % every == 0)) draw(run, writer, moment);
}

void StepPictures::draw(const LocalizationRun& run, const RunWriter& writer,
                        const std::string& moment)
{
  const StepRecord& step = run.steps().back();
  StepDrawing drawing;
  drawing.observed = &run.scene();
  drawing.belief = &step.belief;
  drawing.truth = step.truth;
  drawing.path = path_;
  writer.writeScene(run.map(), step, drawing);
  if (!pictures_) return;
  const auto folder = writer.workFolder() / "pictures";
  std::filesystem::create_directories(folder);
  const auto file = folder / (stepName(step) + (moment.empty() ? "" : "_" + moment) + ".png");
  const mrpt::img::CImage picture = pictures_->stepPicture(drawing, titleOf(step));
  savePicture(picture, file);
  if (!moment.empty()) sheet_.add(picture);
  if (run.atEnd()) savePicture(sheet_.sheet(), folder / "contact_sheet.png");
}
}  // namespace sigloc

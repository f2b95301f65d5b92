// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "failure_pictures.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "eval/methods/RelocationMethod.h"
#include "picture_file.h"
#include "pictures.h"
#include "sigloc/features/observe_scans.h"
#include "sigloc/io/file_output.h"
#include "sigloc/plugin/pose_pdf.h"

namespace sigloc
{
namespace
{
std::vector<std::string> titleOf(const FailedQuery& failure)
{
  const RelocationRecord& record = failure.record;
  std::string second = failure.fate;
  if (record.error.distance >= 0)
  {
    second = fmt::format("off by {:.2f} m, {:.1f} deg; {}", record.error.distance,
                         mrpt::RAD2DEG(record.error.angle), second);
  }
  std::string first =
      fmt::format("{}, query {}: {}", failure.method, failure.query.name, toString(record.verdict));
  if (!std::isnan(record.probability)) first += " (" + probabilityText(record.probability) + ")";
  return {first, second};
}

std::string scoreText(const Candidate& candidate)
{
  return std::isnan(candidate.score) ? std::string()
                                     : fmt::format(", score {:.3f}", candidate.score);
}

std::vector<PictureMaker::CloseUp> closeUpsOf(const FailedQuery& failure)
{
  std::vector<PictureMaker::CloseUp> places;
  const std::string seen = failure.query.scans.empty() ? "features" : "scan";
  const auto& candidates = failure.answer.candidates;
  if (const auto& truth = failure.record.truth)
  {
    const std::size_t rank = failure.record.rank_of_right;
    places.push_back({*truth, seen + " at the truth"});
    if (rank > 0) places.back().title += scoreText(candidates[rank - 1]);
  }
  if (!candidates.empty())
  {
    places.push_back(
        {candidates.front().pose.mean, seen + " at the first" + scoreText(candidates.front())});
  }
  return places;
}

/// Removes the pictures that an earlier run left in a folder and its subfolders.
void removePictures(const std::filesystem::path& folder)
{
  if (!std::filesystem::is_directory(folder)) return;
  const std::vector<std::string> methods = relocationMethodNames();
  std::vector<std::filesystem::path> old;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
  {
    const std::filesystem::path& file = entry.path();
    const std::string name = file.filename().string();
    const bool ours =
        std::any_of(methods.begin(), methods.end(),
                    [&](const std::string& method) { return name.rfind(method + "-", 0) == 0; });
    if (ours && file.extension() == ".png" && entry.is_regular_file()) old.push_back(file);
  }
  for (const std::filesystem::path& file : old) std::filesystem::remove(file);
}

void drawInto(const std::filesystem::path& folder, const std::vector<FailedQuery>& failures)
{
  std::unique_ptr<PictureMaker> pictures;
  std::shared_ptr<const FeatureMap> drawn_map;
  for (const FailedQuery& failure : failures)
  {
    if (failure.map != drawn_map)
    {
      pictures.reset();  // one rendering context at a time
      pictures = std::make_unique<PictureMaker>(*failure.map);
      drawn_map = failure.map;
    }
    const ObservedScene scene = observeScene(failure.query.scans, failure.landmarks);
    const Belief belief = toBelief(failure.answer);
    StepDrawing drawing;
    drawing.observed = &scene;
    drawing.belief = &belief;
    drawing.truth = failure.record.truth;
    drawing.proposed = failure.proposals;
    std::filesystem::create_directories(folder);
    const auto file = folder / (failure.method + "-" + failure.query.name + ".png");
    savePicture(pictures->comparison(drawing, titleOf(failure), closeUpsOf(failure)), file);
  }
}
}  // namespace

void drawFailures(const FailuresByFolder& failures, const std::filesystem::path& out)
{
  const std::filesystem::path folder = out / "failures";
  removePictures(folder);
  for (const auto& [name, of_folder] : failures) drawInto(folder / name, of_folder);
  syncFolder(out);
}
}  // namespace sigloc

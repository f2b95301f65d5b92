// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "failure_pictures.h"

#include <mrpt/core/format.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "pictures.h"
#include "sigloc/eval/RelocationMethod.h"
#include "sigloc/features/FeatureExtractor.h"

namespace sigloc
{
namespace
{
/// The candidates as the hypotheses of a belief, which is what pictures know how to draw.
Belief beliefOf(const RelocationResult& answer)
{
  Belief belief;
  for (const Candidate& candidate : answer.candidates)
  {
    belief.hypotheses.emplace_back();
    belief.hypotheses.back().pose = candidate.pose;
    belief.hypotheses.back().weight = candidate.probability;
  }
  return belief;
}

std::string fateOfTheRightPose(const FailedQuery& failure)
{
  const RelocationRecord& record = failure.record;
  if (!record.truth) return "another place";
  std::string fate = record.rank_of_right > 0
                         ? mrpt::format("right pose: rank %zu", record.rank_of_right)
                         : std::string("right pose: refused");
  if (record.proposed) fate += *record.proposed ? ", proposed" : ", not proposed";
  return fate;
}

std::vector<std::string> titleOf(const FailedQuery& failure)
{
  const RelocationRecord& record = failure.record;
  std::string second = fateOfTheRightPose(failure);
  if (record.error.distance >= 0)
  {
    second =
        mrpt::format("off by %.2f m, %.1f deg; ", record.error.distance, record.error.angle_deg) +
        second;
  }
  return {mrpt::format("%s, query %s: %s (%.3f)", failure.method.c_str(),
                       failure.query.name.c_str(), toString(record.verdict), record.probability),
          second};
}

std::vector<PictureMaker::CloseUp> closeUpsOf(const FailedQuery& failure)
{
  std::vector<PictureMaker::CloseUp> places;
  const auto& candidates = failure.answer.candidates;
  if (const auto& truth = failure.record.truth)
  {
    const std::size_t rank = failure.record.rank_of_right;
    places.push_back({*truth, "scan at the truth"});
    if (rank > 0) places.back().title += mrpt::format(", score %.3f", candidates[rank - 1].score);
  }
  if (!candidates.empty())
  {
    places.push_back({candidates.front().pose.mean,
                      mrpt::format("scan at the first, score %.3f", candidates.front().score)});
  }
  return places;
}
}  // namespace

void removeFailurePictures(const std::filesystem::path& folder)
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

void drawFailures(const std::vector<FailedQuery>& failures, const std::filesystem::path& folder)
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
    const ObservedScene scene = observeScene(failure.query.scans);
    const Belief belief = beliefOf(failure.answer);
    StepDrawing drawing;
    drawing.observed = &scene;
    drawing.belief = &belief;
    drawing.truth = failure.record.truth;
    drawing.proposed = failure.proposals;
    std::filesystem::create_directories(folder);
    const auto file = folder / (failure.method + "-" + failure.query.name + ".png");
    if (!pictures->comparison(drawing, titleOf(failure), closeUpsOf(failure))
             .saveToFile(file.string()))
    {
      throw std::runtime_error(file.string() + ": cannot write");
    }
  }
}
}  // namespace sigloc

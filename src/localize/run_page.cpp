// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "localize/run_page.h"

#include <fmt/format.h>
#include <mrpt/core/bits_math.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "localize/kept_scans.h"
#include "localize/page_map.h"

namespace sigloc::detail
{
namespace
{
using nlohmann::ordered_json;

constexpr std::size_t kMostHypotheses = 8;  // of a step
constexpr double kLeastWeight = 1e-4;

/// The heaviest hypotheses as [x, y, phi, weight as text, Cxx, Cyy, Cxy, id].
ordered_json hypothesesOf(const Belief& belief)
{
  ordered_json all = ordered_json::array();
  for (const TrackedHypothesis& hypothesis : belief.hypotheses)
  {
    if (all.size() == kMostHypotheses || (hypothesis.weight < kLeastWeight && !all.empty())) break;
    ordered_json row = pagePose(hypothesis.pose.mean);
    const auto& c = hypothesis.pose.covariance;
    row.push_back(probabilityText(hypothesis.weight, 4));
    for (const double value : {c(0, 0), c(1, 1), c(0, 1)}) row.push_back(rounded(value, 5));
    row.push_back(hypothesis.id);
    all.push_back(std::move(row));
  }
  return all;
}

/// Places as x, y, x, y, ... in centimetres.
ordered_json centimetresOf(const std::vector<mrpt::math::TPoint2Df>& places)
{
  ordered_json all = ordered_json::array();
  for (const mrpt::math::TPoint2Df& place : places)
  {
    for (const float value : {place.x, place.y}) all.push_back(std::lround(100 * value));
  }
  return all;
}

class StepRows
{
 public:
  void add(const StepRecord& step, bool with_scan)
  {
    ordered_json row;
    row["n"] = step.number;
    row["m"] = step.travel_known ? ordered_json(rounded(step.travelled, 2)) : ordered_json(nullptr);
    row["v"] = static_cast<int>(step.belief.verdict);
    row["e"] = rounded(step.belief.elsewhere, 4);
    row["r"] = reasonNumber(step.belief.reason);
    row["l"] = step.relocated ? 1 : 0;
    row["ms"] = {rounded(step.extraction_ms, 2), rounded(step.tracking_ms, 2)};
    row["p"] = probabilityText(step.belief.probabilityOfFirst());
    row["h"] = hypothesesOf(step.belief);
    row["a"] = step.belief.hypotheses.size();
    if (step.truth) row["t"] = pagePose(*step.truth);
    if (step.error)
      row["d"] = {rounded(step.error->distance, 2), rounded(mrpt::RAD2DEG(step.error->angle), 1)};
    if (with_scan)
    {
      row["f"] = pageMarks(step.features);
      row["b"] = centimetresOf(step.returns);
    }
    rows_.push_back(std::move(row));
  }

  ordered_json rows() { return std::move(rows_); }
  ordered_json reasons() { return std::move(reasons_); }

 private:
  std::size_t reasonNumber(const std::string& reason)
  {
    const auto [known, is_new] = numbers_.emplace(reason, numbers_.size());
    if (is_new) reasons_.push_back(reason);
    return known->second;
  }

  ordered_json rows_ = ordered_json::array();
  ordered_json reasons_ = ordered_json::array();
  std::map<std::string, std::size_t> numbers_;
};

}  // namespace

std::string runPage(const LocalizationRun& run)
{
  const KeptScans scans = keptScans(run.steps());
  StepRows steps;
  for (std::size_t k = 0; k < run.steps().size(); ++k) steps.add(run.steps()[k], scans.kept[k]);
  ordered_json data;
  data["map_name"] = run.setup().map_file.filename().string();
  data["log_name"] = run.setup().rawlog_file.filename().string();
  data["verdicts"] = ordered_json::array();
  for (const Verdict verdict :
       {Verdict::localized, Verdict::ambiguous, Verdict::not_here, Verdict::too_little_seen})
    data["verdicts"].push_back(toString(verdict));
  data["map"] = pageMap(run.map());
  data["scans_every"] = scans.every;
  data["steps"] = steps.rows();
  data["reasons"] = steps.reasons();
  return kRunPageHead + textForScript(data) + kPageMapScript + kRunPageTail;
}
}  // namespace sigloc::detail

// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "localize/run_page.h"

#include <fmt/format.h>
#include <mrpt/core/bits_math.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "map/field_tiles.h"
#include "sigloc/plugin/map_drawing.h"

namespace sigloc::detail
{
namespace
{
using nlohmann::ordered_json;

constexpr std::uint32_t kMostPixels = 1200;  // of the map's longer side
constexpr std::size_t kMostHypotheses = 8;  // of a step
constexpr double kLeastWeight = 1e-4;
constexpr std::size_t kMostSeen = 2000;  // steps with the features seen: they are the largest part

/// Rounded, so that few digits are written.
double rounded(double value, int digits)
{
  const double unit = std::pow(10, digits);
  return std::round(value * unit) / unit;
}

/// The raster, shrunk: "runs" has how many pixels are unknown, free, wall, unknown, ... in turn,
/// row by row from below.
ordered_json shrunkRaster(const DenseField& field)
{
  const RasterFrame& frame = field.frame;
  const std::uint32_t block =
      std::max(1U, (std::max(frame.width, frame.height) + kMostPixels - 1) / kMostPixels);
  const ShrunkField shrunk = shrunkField(field, block);
  std::vector<std::uint32_t> runs(1);
  const auto add = [&](std::uint32_t shade)
  {
    while ((runs.size() - 1) % 3 != shade) runs.push_back(0);
    ++runs.back();
  };
  for (const CellState state : shrunk.states)
  {
    add(isWall(state) ? 2 : static_cast<std::uint32_t>(state));
  }
  return {{"width", shrunk.width}, {"height", shrunk.height},           {"x", frame.origin.x},
          {"y", frame.origin.y},   {"pixel", frame.resolution * block}, {"runs", runs}};
}

/// A segment as [x, y, x, y], anything else as [x, y].
ordered_json marksOf(const std::vector<Feature>& features)
{
  ordered_json marks = ordered_json::array();
  for (const Feature& feature : features)
  {
    ordered_json mark = ordered_json::array();
    const auto add = [&](const mrpt::math::TPoint2D& p)
    {
      mark.push_back(rounded(p.x, 2));
      mark.push_back(rounded(p.y, 2));
    };
    if (isSegment(feature.type))
    {
      add(segmentStart(feature));
      add(segmentEnd(feature));
    }
    else
    {
      add(feature.position);
    }
    marks.push_back(std::move(mark));
  }
  return marks;
}

ordered_json mapOf(const FeatureMap& map)
{
  const PlanarBox box = boundsOf(map);
  ordered_json json;
  json["box"] = {box.x_min, box.x_max, box.y_min, box.y_max};
  json["raster"] = map.field() ? shrunkRaster(*map.field()) : ordered_json(nullptr);
  json["marks"] = map.field() ? ordered_json::array() : marksOf(map.features());
  return json;
}

ordered_json poseOf(const mrpt::math::TPose2D& pose)
{
  return {rounded(pose.x, 3), rounded(pose.y, 3), rounded(pose.phi, 4)};
}

/// The heaviest hypotheses as [x, y, phi, weight, Cxx, Cyy, Cxy, id].
ordered_json hypothesesOf(const Belief& belief)
{
  ordered_json all = ordered_json::array();
  for (const TrackedHypothesis& hypothesis : belief.hypotheses)
  {
    if (all.size() == kMostHypotheses || (hypothesis.weight < kLeastWeight && !all.empty())) break;
    ordered_json row = poseOf(hypothesis.pose.mean);
    const auto& c = hypothesis.pose.covariance;
    row.push_back(rounded(hypothesis.weight, 4));
    for (const double value : {c(0, 0), c(1, 1), c(0, 1)}) row.push_back(rounded(value, 5));
    row.push_back(hypothesis.id);
    all.push_back(std::move(row));
  }
  return all;
}

class StepRows
{
 public:
  explicit StepRows(std::size_t steps) : seen_every_(1 + (steps - 1) / kMostSeen) {}

  void add(const StepRecord& step)
  {
    ordered_json row;
    row["n"] = step.number;
    row["m"] = step.travel_known ? ordered_json(rounded(step.travelled, 2)) : ordered_json(nullptr);
    row["v"] = static_cast<int>(step.belief.verdict);
    row["e"] = rounded(step.belief.elsewhere, 4);
    row["r"] = reasonNumber(step.belief.reason);
    row["l"] = step.relocated ? 1 : 0;
    row["ms"] = {rounded(step.extraction_ms, 2), rounded(step.tracking_ms, 2)};
    row["h"] = hypothesesOf(step.belief);
    if (step.truth) row["t"] = poseOf(*step.truth);
    if (step.error)
      row["d"] = {rounded(step.error->distance, 2), rounded(mrpt::RAD2DEG(step.error->angle), 1)};
    if (rows_.size() % seen_every_ == 0) row["f"] = marksOf(step.features);
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

  std::size_t seen_every_;
  ordered_json rows_ = ordered_json::array();
  ordered_json reasons_ = ordered_json::array();
  std::map<std::string, std::size_t> numbers_;
};

/// JSON that can stand within a script of a page.
std::string textForScript(const ordered_json& json)
{
  std::string text = json.dump(-1, ' ', true, ordered_json::error_handler_t::replace);
  for (std::size_t at = text.find("</"); at != std::string::npos; at = text.find("</", at + 3))
    text.insert(at + 1, "\\");
  return text;
}
}  // namespace

std::string runPage(const LocalizationRun& run)
{
  StepRows steps(std::max<std::size_t>(1, run.steps().size()));
  for (const StepRecord& step : run.steps()) steps.add(step);
  ordered_json data;
  data["map_name"] = run.setup().map_file.filename().string();
  data["log_name"] = run.setup().rawlog_file.filename().string();
  data["verdicts"] = ordered_json::array();
  for (const Verdict verdict :
       {Verdict::localized, Verdict::ambiguous, Verdict::not_here, Verdict::too_little_seen})
    data["verdicts"].push_back(toString(verdict));
  data["map"] = mapOf(run.map());
  data["steps"] = steps.rows();
  data["reasons"] = steps.reasons();
  return kRunPageHead + textForScript(data) + kRunPageTail;
}
}  // namespace sigloc::detail

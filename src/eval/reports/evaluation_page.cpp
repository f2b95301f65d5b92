// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/reports/evaluation_page.h"

#include "localize/page_map.h"

namespace sigloc
{
using nlohmann::ordered_json;

namespace
{
ordered_json poseOrNull(const std::optional<mrpt::math::TPose2D>& pose)
{
  return pose ? detail::pagePose(*pose) : ordered_json(nullptr);
}

ordered_json pathOf(const PagePlace& place)
{
  ordered_json path = ordered_json::array();
  for (const auto& [pose, claim] : place.path)
    path.push_back({detail::rounded(pose.x, 2), detail::rounded(pose.y, 2), claim});
  return path;
}

ordered_json placesOf(const std::vector<PagePlace>& places)
{
  ordered_json all = ordered_json::array();
  for (const PagePlace& place : places)
  {
    ordered_json row;
    row["method"] = place.method;
    row["name"] = place.name;
    row["outcome"] = place.outcome;
    row["truth"] = poseOrNull(place.truth);
    row["first"] = poseOrNull(place.first);
    row["facts"] = place.facts;
    row["path"] = pathOf(place);
    all.push_back(std::move(row));
  }
  return all;
}

ordered_json plotsOf(const std::vector<std::pair<std::string, Plot>>& plots)
{
  ordered_json all = ordered_json::array();
  for (const auto& [file, plot] : plots)
  {
    ordered_json series = ordered_json::array();
    for (const PlotSeries& curve : plot.series)
    {
      series.push_back({{"title", curve.title},
                        {"points", curve.points},
                        {"markers", curve.markers},
                        {"intervals", curve.intervals}});
    }
    all.push_back({{"title", plot.title},
                   {"x", plot.x_label},
                   {"y", plot.y_label},
                   {"log_x", plot.log_x},
                   {"log_y", plot.log_y},
                   {"series", series}});
  }
  return all;
}
}  // namespace

PageOutcome pageOutcome(bool right, const std::optional<Claim>& claim)
{
  switch (claim.value_or(Claim::none))
  {
    case Claim::right:
      return PageOutcome::claimed_right;
    case Claim::inaccurate:
      return PageOutcome::inaccurate;
    case Claim::wrong:
      return PageOutcome::claimed_wrong;
    case Claim::none:
      break;
  }
  return right ? PageOutcome::right : PageOutcome::not_right;
}

std::string evaluationPage(const std::string& title, const std::string& markdown,
                           const std::vector<std::pair<std::string, Plot>>& plots,
                           const PageMap& map)
{
  ordered_json data;
  data["title"] = title;
  data["text"] = markdown;
  data["plots"] = plotsOf(plots);
  data["map"] = map.map ? detail::pageMap(*map.map) : ordered_json(nullptr);
  data["places"] = map.map ? placesOf(map.places) : ordered_json::array();
  return detail::kEvaluationPageHead + detail::textForScript(data) + detail::kPageMapScript +
         detail::kEvaluationPageTail;
}
}  // namespace sigloc

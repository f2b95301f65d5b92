// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "eval/reports/plot.h"
#include "eval/scoring/relocation_scoring.h"
#include "sigloc/map/FeatureMap.h"

namespace sigloc
{
/// What became of a place that was asked, as the page colours it.
enum class PageOutcome : std::uint8_t
{
  claimed_right,
  right,  ///< without a claim
  inaccurate,  ///< claimed, and off by more than what counts as right
  not_right,  ///< without a claim
  claimed_wrong,
  saw_nothing,
};

/// The outcome of an answer; `claim` is none where a method does not say whether it is sure.
PageOutcome pageOutcome(bool right, const std::optional<Claim>& claim);

/// A query or a run on the page's map.
struct PagePlace
{
  std::string method;
  std::string name;
  PageOutcome outcome = PageOutcome::saw_nothing;
  std::optional<mrpt::math::TPose2D> truth;
  std::optional<mrpt::math::TPose2D> first;  ///< the first pose of the answer
  std::vector<std::pair<std::string, std::string>> facts;
  std::vector<std::pair<mrpt::math::TPose2D, Claim>> path;  ///< what a run took for its poses
};

/// What the page shows besides text and plots.
struct PageMap
{
  std::shared_ptr<const FeatureMap> map;  ///< none: the evaluation has no map, or several
  std::vector<PagePlace> places;
};

/// Returns a page that shows an evaluation in a browser: the text, given as Markdown, the plots,
/// and each place on the map. It holds all of its data, and needs neither network nor other files.
std::string evaluationPage(const std::string& title, const std::string& markdown,
                           const std::vector<std::pair<std::string, Plot>>& plots,
                           const PageMap& map);

namespace detail
{
/// The page around the data: the text before it, and after the script that draws the map.
extern const char* const kEvaluationPageHead;
extern const char* const kEvaluationPageTail;
}  // namespace detail
}  // namespace sigloc

// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "eval/reports/plot.h"
#include "eval/scoring/statistics.h"
#include "eval/wakeup/wakeup.h"

namespace sigloc::detail
{
/// Steps whose first hypothesis had a weight in [low, high), and the share that was not right.
struct CalibrationBin
{
  double low = 0;
  double high = 0;
  bool claims = false;  ///< the steps that claimed (localized), whatever their weight
  Proportion wrong_steps;
  Proportion wrong_episodes;  ///< unbroken stretches in the bin; wrong when any step of it is
};

/// What a method's figures about itself are worth, over the steps with truth in the mapped area.
struct SelfKnowledge
{
  std::vector<CalibrationBin> bins;  ///< the last one: claims (localized)
  Quantiles nees;  ///< squared normalised error while localized, 3 degrees of freedom
  Proportion in_ellipse;  ///< share of it within the 95 % ellipse
};

/// Empty bins for a method that tells no weights.
SelfKnowledge selfKnowledgeOf(const WakeupMethodReport& method, const AccuracyGates& gates);

nlohmann::ordered_json toJson(const SelfKnowledge& knowledge);

/// Tables in Markdown; empty for a method that tells no weights.
std::string toMarkdown(const SelfKnowledge& knowledge);

/// Two kinds of plots over the distance driven, with their file names: how many hypotheses are
/// left, and the weights of the two heaviest of some runs. None for a method without weights.
std::vector<std::pair<std::string, Plot>> beliefPlots(const WakeupMethodReport& method);
}  // namespace sigloc::detail

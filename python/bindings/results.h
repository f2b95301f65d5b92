// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sigloc/matching/RelocationResult.h"
#include "sigloc/tracking/Belief.h"

namespace sigloc::python
{
/// A pose that the robot may be at; `id` and `age` are a tracker's.
struct Hypothesis
{
  GaussianPose pose;
  double probability = 0;
  std::optional<std::uint64_t> id;
  std::optional<std::uint32_t> age;
};

/// What a scan, or all steps so far, tell: RelocationResult and Belief in one form.
struct Answer
{
  Verdict verdict = Verdict::too_little_seen;
  double probability = 0;
  double elsewhere = 1;
  std::string reason;
  std::vector<Hypothesis> hypotheses;
};

Answer answerOf(const RelocationResult& result);
Answer answerOf(const Belief& belief);
}  // namespace sigloc::python

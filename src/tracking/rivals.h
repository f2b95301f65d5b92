// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sigloc/map/DenseField.h"
#include "sigloc/tracking/Belief.h"

namespace sigloc
{
/// Returns one line on what keeps the first of the hypotheses (heaviest first, at least one) from
/// being the answer: how many remain, where the next one is, and where the two differ. Without a
/// field it says nothing of the last.
std::string describeRivals(const std::vector<TrackedHypothesis>& hypotheses,
                           const DenseField* field);
}  // namespace sigloc

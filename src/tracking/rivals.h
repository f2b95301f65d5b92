// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sigloc/map/DenseField.h"
#include "sigloc/tracking/Belief.h"

namespace sigloc
{
/// Returns one line that says why the first hypothesis is not the answer yet. Where "somewhere
/// else" weighs more than the other hypotheses, in [0, 1], that is why. Else it says how many
/// remain, where the next one is, and where the map differs for the two. The hypotheses are given
/// heaviest first, at least one. Without a field (null) the line leaves out where the map differs.
std::string describeRivals(const std::vector<TrackedHypothesis>& hypotheses, double elsewhere,
                           const DenseField* field);
}  // namespace sigloc

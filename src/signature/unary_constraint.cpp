// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "signature/unary_constraint.h"

namespace sigloc
{
bool unaryCompatible(const DirectedFeature& observed, const DirectedFeature& mapped, double gate)
{
  if (observed.type() != mapped.type()) return false;
  if (observed.label >= 0 && mapped.label >= 0 && observed.label != mapped.label) return false;
  const FeatureType type = observed.type();
  if (!hasSize(type)) return true;
  const Feature& e = *observed.feature;
  const Feature& f = *mapped.feature;
  // A vanishing variance would make the gate an equality test on floating point numbers.
  constexpr double kRounding = 1e-12;
  const double variance = e.size_variance + f.size_variance + kRounding;
  if (isSegment(type))
  {
    // The test is one-sided, because a wall is seen in part, but never longer than it is.
    const double end_variance =
        varianceAlong(e, observed.tangent()) + varianceAlong(f, mapped.tangent());
    const double excess = observed.length() - mapped.length();
    return excess <= 0 || excess * excess <= gate * (variance + 2 * end_variance);
  }
  const double excess = e.size - f.size;
  const bool agrees = excess * excess <= gate * variance;
  return isSeenInPart(type) ? e.side == f.side && (excess <= 0 || agrees) : agrees;
}
}  // namespace sigloc

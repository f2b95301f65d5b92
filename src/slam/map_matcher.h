// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/maps/CMultiMetricMap.h>

#include <memory>

#include "sigloc/matching/SignatureMatcher.h"

namespace sigloc
{
/// Returns the map itself, or the first of its kind in a multi-map; null when there is none.
template <class Kind>
const Kind* findMap(const mrpt::maps::CMetricMap* map)
{
  if (const auto* own = dynamic_cast<const Kind*>(map)) return own;
  const auto* several = dynamic_cast<const mrpt::maps::CMultiMetricMap*>(map);
  if (several == nullptr) return nullptr;
  for (const auto& each : several->maps)
  {
    if (const auto* found = dynamic_cast<const Kind*>(each.get())) return found;
  }
  return nullptr;
}

/// Returns the matcher of a map. Makes it anew where `matcher` is null or of another map.
inline const SignatureMatcher& matcherOf(const std::shared_ptr<const FeatureMap>& map,
                                         const MatcherOptions& options,
                                         std::shared_ptr<const SignatureMatcher>& matcher)
{
  if (!matcher || &matcher->map() != map.get())
  {
    matcher = std::make_shared<const SignatureMatcher>(map, options);
  }
  return *matcher;
}
}  // namespace sigloc

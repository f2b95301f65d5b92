// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "matching/features/FeatureHypothesis.h"
#include "matching/features/GeneratorOptions.h"
#include "sigloc/map/FeatureMap.h"

namespace sigloc
{
/// Returns the feature-only method of a name: "signature" (the default mode), "signature-plain",
/// "-anchors", "-pairs", "-patterns", or an opponent: "jcbb" and its variants,
/// "interpretation-tree", "clique". The map must outlive it. Throws std::invalid_argument for
/// another name.
std::unique_ptr<FeatureHypothesisGenerator> makeFeatureMethod(const std::string& name,
                                                              const FeatureMap& map,
                                                              const GeneratorOptions& options);

/// Names that `makeFeatureMethod` accepts.
std::vector<std::string> featureMethodNames();

/// Throws std::invalid_argument for an empty list or a name that `makeFeatureMethod` does not
/// accept.
void checkFeatureMethods(const std::vector<std::string>& names);

/// True for methods whose cost is linear in the map by a large constant.
bool isLinearMethod(const std::string& name);
}  // namespace sigloc

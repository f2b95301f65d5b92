// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "matching/features/FeatureHypothesis.h"
#include "matching/features/FeatureVerifier.h"
#include "matching/features/GeneratorOptions.h"
#include "sigloc/matching/SignatureMatcher.h"

#include <memory>

namespace sigloc
{
class FeatureMap;

/// Returns the generator of a mode for a map, which must outlive it. `automatic` stands for
/// patterns with their fall-backs. Throws std::invalid_argument for mode `minimal_sets`, which
/// needs a dense field, and for mode `plain` in a map of more than 10 000 features. The options are
/// not checked.
std::unique_ptr<FeatureHypothesisGenerator> makeGenerator(GenerationMode mode,
                                                          const FeatureMap& map,
                                                          const GeneratorOptions& options = {});

/// The same with a verifier that is shared with others.
std::unique_ptr<FeatureHypothesisGenerator> makeGenerator(
    GenerationMode mode, const std::shared_ptr<const FeatureVerifier>& verifier);
}  // namespace sigloc

// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sigloc/matching/FeatureHypothesis.h"
#include "sigloc/matching/FeatureVerifier.h"
#include "sigloc/matching/GenerationMode.h"
#include "sigloc/matching/GeneratorOptions.h"

#include <memory>

namespace sigloc
{
class FeatureMap;

/// Returns the generator of a mode over a map, which must outlive it; `automatic` is patterns with
/// their fall-backs. Throws std::invalid_argument for mode `bases`, which needs a dense field, and
/// for options outside their ranges.
std::unique_ptr<FeatureHypothesisGenerator> makeGenerator(GenerationMode mode,
                                                          const FeatureMap& map,
                                                          const GeneratorOptions& options = {});

/// The same with a verifier that others use too.
std::unique_ptr<FeatureHypothesisGenerator> makeGenerator(
    GenerationMode mode, const std::shared_ptr<const FeatureVerifier>& verifier);
}  // namespace sigloc

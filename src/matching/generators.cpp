// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "matching/generators.h"

#include "matching/generation/AnchorGenerator.h"
#include "matching/generation/PairIndexGenerator.h"
#include "matching/generation/PatternGenerator.h"
#include "matching/generation/PlainGenerator.h"

#include <fmt/core.h>

#include <stdexcept>

namespace sigloc
{
std::unique_ptr<FeatureHypothesisGenerator> makeGenerator(GenerationMode mode,
                                                          const FeatureMap& map,
                                                          const GeneratorOptions& options)
{
  const auto prepared = std::make_shared<const PreparedMap>(map);
  return makeGenerator(mode, std::make_shared<const FeatureVerifier>(prepared, options));
}

std::unique_ptr<FeatureHypothesisGenerator> makeGenerator(
    GenerationMode mode, const std::shared_ptr<const FeatureVerifier>& verifier)
{
  if (mode == GenerationMode::minimal_sets)
  {
    throw std::invalid_argument("makeGenerator: minimal sets need a dense field");
  }
  const PreparedMap& prepared = verifier->map();
  if (mode == GenerationMode::plain && prepared.size() > PlainGenerator::kMostFeatures)
  {
    throw std::invalid_argument(fmt::format("mode {} (plain) is for maps of {} features at most",
                                            static_cast<int>(mode), PlainGenerator::kMostFeatures));
  }
  const double cut_off = mode == GenerationMode::plain
                             ? PairLists::kUncut
                             : PairLists::cutOffFor(prepared, verifier->options());
  const auto lists = std::make_shared<const PairLists>(prepared, cut_off);
  switch (mode)
  {
    case GenerationMode::plain:
      return std::make_unique<PlainGenerator>(verifier, lists);
    case GenerationMode::anchors:
      return std::make_unique<AnchorGenerator>(verifier, lists);
    case GenerationMode::pairs:
      return std::make_unique<PairIndexGenerator>(verifier, lists);
    default:
      return std::make_unique<PatternGenerator>(verifier, lists);
  }
}
}  // namespace sigloc

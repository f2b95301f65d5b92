// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/methods/feature_methods.h"

#include <utility>

#include "eval/data/method_names.h"
#include "eval/methods/features/CliqueAssociation.h"
#include "eval/methods/features/InterpretationTree.h"
#include "eval/methods/features/JcbbRelocation.h"
#include "matching/generators.h"

namespace sigloc
{
namespace
{
// Its authors leave P_good to the user: what he expects to be mapped.
constexpr std::pair<const char*, JcbbOptions> kJcbbVariants[] = {
    {"jcbb", {0.5, false}},
    {"jcbb-0.35", {0.35, false}},
    {"jcbb-0.25", {0.25, false}},
    {"jcbb-greedy", {0.5, true}},
};
}  // namespace

std::vector<std::string> featureMethodNames()
{
  return {
      "signature", "signature-plain", "signature-anchors", "signature-pairs", "signature-patterns",
      "jcbb",      "jcbb-0.35",       "jcbb-0.25",         "jcbb-greedy",     "interpretation-tree",
      "clique"};
}

void checkFeatureMethods(const std::vector<std::string>& names)
{
  checkMethodNames(names, featureMethodNames());
}

std::unique_ptr<FeatureHypothesisGenerator> makeFeatureMethod(const std::string& name,
                                                              const FeatureMap& map,
                                                              const GeneratorOptions& options)
{
  if (name == "signature") return makeGenerator(GenerationMode::automatic, map, options);
  if (name == "signature-plain") return makeGenerator(GenerationMode::plain, map, options);
  if (name == "signature-anchors") return makeGenerator(GenerationMode::anchors, map, options);
  if (name == "signature-pairs") return makeGenerator(GenerationMode::pairs, map, options);
  if (name == "signature-patterns") return makeGenerator(GenerationMode::patterns, map, options);
  for (const auto& [known, jcbb] : kJcbbVariants)
  {
    if (name == known) return std::make_unique<JcbbRelocation>(map, options, jcbb);
  }
  if (name == "interpretation-tree") return std::make_unique<InterpretationTree>(map, options);
  if (name == "clique") return std::make_unique<CliqueAssociation>(map, options);
  refuseMethod(name, featureMethodNames());
}

bool isLinearMethod(const std::string& name)
{
  return name != "signature" && name != "signature-patterns";
}
}  // namespace sigloc

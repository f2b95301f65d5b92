// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sigloc/config/option_fields.h"

namespace sigloc
{
/// How hypotheses are generated and verified by features alone: modes (a) to (d). Units, ranges and
/// meanings are in `visitFields`. \cite algorithm sections 4 and 5
struct GeneratorOptions
{
  double gate_probability = 0.995;
  double failure_probability = 0.01;
  double good_share = 0.5;
  std::uint32_t partners = 3;
  double detection_probability = 0.8;
  double min_overlap = 0.5;
  std::uint32_t min_support = 3;
  double significance = 0.001;
  std::uint32_t max_hypotheses = 50;
  double effective_range = 0;
  std::uint32_t max_neighbours = 48;
  std::uint32_t pattern_size = 0;
  std::uint32_t max_patterns = 24;
  double pattern_cell = 0;
  std::uint32_t fall_back_hypotheses = 400000;
  std::uint32_t seed = 1;

  template <class V>
  static void visitFields(V&& visit)
  {
    using O = GeneratorOptions;
    visit(OptionField{"gate_probability", &O::gate_probability, 0.5, 0.9999999,
                      "[-] share of right pairings that pass a gate"});
    visit(OptionField{"failure_probability", &O::failure_probability, 1e-9, 0.5,
                      "[-] P_fail: chance that sampling misses a pose of good_share support"});
    visit(OptionField{"good_share", &O::good_share, 0.05, 1.0,
                      "[-] w: share of the observed features that really are in the map"});
    visit(OptionField{"partners", &O::partners, 1U, 100U, "[-] s: partners tried with an anchor"});
    visit(OptionField{"detection_probability", &O::detection_probability, 0.01, 0.999,
                      "[-] P_D: chance that a mapped feature in view is observed"});
    visit(OptionField{"min_overlap", &O::min_overlap, 0.0, 1.0,
                      "[-] share of an observed wall that must lie on the mapped one"});
    visit(OptionField{"min_support", &O::min_support, 2U, 100U,
                      "[-] fewest pairings of a hypothesis"});
    visit(OptionField{"significance", &O::significance, 1e-12, 1.0,
                      "[-] hypotheses as good expected by chance, below which one is significant"});
    visit(OptionField{"max_hypotheses", &O::max_hypotheses, 1U, 100000U,
                      "[-] how many hypotheses are returned at most"});
    visit(OptionField{"effective_range", &O::effective_range, 0.0, 1000.0,
                      "[m] r_eff: within which features are really seen; 0: by max_neighbours"});
    visit(OptionField{"max_neighbours", &O::max_neighbours, 2U, 1000000U,
                      "[-] mean number of neighbours a feature is indexed with"});
    visit(OptionField{"pattern_size", &O::pattern_size, 0U, 5U,
                      "[-] features of an indexed pattern, 3 to 5; 0: grows with log m"});
    visit(OptionField{"max_patterns", &O::max_patterns, 1U, 10000U,
                      "[-] mean number of patterns a feature is indexed with"});
    visit(OptionField{"pattern_cell", &O::pattern_cell, 0.0, 10.0,
                      "[m] cell of the pattern hash; 0: twice the expected tolerance"});
    visit(OptionField{"fall_back_hypotheses", &O::fall_back_hypotheses, 0U, 0xFFFFFFFFU,
                      "[-] budget of pairs and of anchors each, when patterns find nothing"});
    visit(OptionField{"seed", &O::seed, 0U, 0xFFFFFFFFU, "[-] of the sampling"});
  }
};
}  // namespace sigloc

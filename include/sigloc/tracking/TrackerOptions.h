// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "sigloc/config/option_fields.h"
#include "sigloc/matching/RelocationResult.h"

namespace sigloc
{
/// How HypothesisTracker tracks hypotheses and when it claims one. Units, ranges and meanings are
/// in `visitFields`. \cite algorithm section 8
struct TrackerOptions
{
  std::uint32_t max_hypotheses = 20;
  double localized_probability = kLocalizedProbability;
  double prune_weight = 1e-4;
  double evidence_distance = 1.0;
  double evidence_turn = 3.0;
  double lost_distance = 0.3;
  double min_elsewhere = kLeastElsewhere;
  double relocation_distance = 0.5;
  double confirmation_distance = 2.0;
  double score_drop = 0.2;
  double suspicion = 0.3;
  double free_motion_sigma = 0.3;
  double free_turn_sigma = 0.2;

  template <class V>
  static void visitFields(V&& visit)
  {
    using O = TrackerOptions;
    visit(OptionField{"max_hypotheses", &O::max_hypotheses, 1U, 1000U,
                      "[-] how many hypotheses are tracked at most"});
    visit(OptionField{"localized_probability", &O::localized_probability, 0.5, 1.0,
                      "[-] the verdict is localized from this probability on"});
    visit(OptionField{"prune_weight", &O::prune_weight, 0.0, 0.1,
                      "[-] lighter hypotheses are given up, their weight goes elsewhere"});
    visit(OptionField{
        "evidence_distance", &O::evidence_distance, 0.01, 100.0,
        "[m] travel after which a scan is fresh evidence; between rivals seven tenths of it"});
    visit(OptionField{"evidence_turn", &O::evidence_turn, 0.01, 100.0,
                      "[rad] turn that counts as much as the distance"});
    visit(OptionField{
        "lost_distance", &O::lost_distance, 0.01, 100.0,
        "[m] with landmarks, travel after which a scan is fresh evidence of being lost; "
        "without odometry, travel from step to step"});
    visit(OptionField{
        "min_elsewhere", &O::min_elsewhere, 0.0, 0.5,
        "[-] weight of somewhere else kept to start new tracks; what is published may be lower"});
    visit(OptionField{"relocation_distance", &O::relocation_distance, 0.0, 100.0,
                      "[m] travel between two relocations while no pose is known"});
    visit(OptionField{"confirmation_distance", &O::confirmation_distance, 0.0, 1000.0,
                      "[m] travel between two relocations while one pose is known"});
    visit(
        OptionField{"score_drop", &O::score_drop, 0.01, 1.0,
                    "[-] fall of the score below its mean over 10 m that calls for a relocation"});
    visit(OptionField{
        "suspicion", &O::suspicion, 0.0, 1.0,
        "[-] weight of somewhere else when relocation finds the robot far from all tracks"});
    visit(OptionField{"free_motion_sigma", &O::free_motion_sigma, 0.001, 10.0,
                      "[m] standard deviation of a step without odometry"});
    visit(OptionField{"free_turn_sigma", &O::free_turn_sigma, 0.001, 3.0,
                      "[rad] standard deviation of the turn of a step without odometry"});
  }
};

/// Section [sigloc.particles]: MRPT's filter where `tracker = particles`.
struct ParticleOptions
{
  static constexpr std::uint32_t kMostParticles = 10000000;

  std::uint32_t particles = 500;
  double motion_sigma = 0.05;
  double motion_turn_sigma = 0.05;

  template <class V>
  static void visitFields(V&& visit)
  {
    using O = ParticleOptions;
    visit(OptionField{"particles", &O::particles, 1U, kMostParticles,
                      "[-] how many are drawn when the robot is lost"});
    visit(OptionField{"motion_sigma", &O::motion_sigma, 0.0, 1.0,
                      "[m] standard deviation that a metre of travel adds to the odometry's own"});
    visit(
        OptionField{"motion_turn_sigma", &O::motion_turn_sigma, 0.0, 1.0,
                    "[rad] standard deviation that a metre of travel adds to the odometry's own"});
  }
};
}  // namespace sigloc

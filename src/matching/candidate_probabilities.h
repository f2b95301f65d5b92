// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "matching/dense/DenseEvidence.h"
#include "sigloc/matching/SignatureMatcher.h"

namespace sigloc
{
/// Returns the log-likelihood of a dense score in about [-1, 1], tempered for the correlation of
/// neighbouring beams. \cite algorithm eq. (7.1)
double logLikelihoodOfScore(double score);

/// Returns how well a pose explains a scan, in [0, 1]: the share of returns on walls, less half of
/// the share through walls. Returns in free space are left out. \cite algorithm eq. (8.11)
double reliabilityOf(const DenseEvidence& evidence);

/// Returns ½ (F + C) - ½ T of (6.8), over the returns that are not in free space, at most 1, as if
/// nothing unmapped had hidden the walls. \cite algorithm section 8, "Publish"
double scoreOfUnhidden(const DenseEvidence& evidence);

/// Returns the share, in [0, 1], of the returns in known cells that the map does not explain.
/// Returns in free space count as explained, because people and moved furniture hide walls.
/// \cite algorithm eq. (8.21)
double unexplainedShare(const DenseEvidence& evidence);

/// Returns what the scan of a tracked pose adds to the in-map log-odds if all that it sees is new
/// to the track. It grows with the share that the map explains. \cite algorithm eq. (8.21)
double trackedLogOdds(const DenseEvidence& evidence);

/// Prior log-odds that the robot is in the map: one wake-up in fourteen is somewhere else.
/// \cite algorithm eq. (7.2)
constexpr double kPriorHereLogOdds = 2.6;

/// Returns the part of the log-odds (7.2) that a pose has by itself, without the prior and its
/// rivals: how much of the scan and how many constraints it explains. \cite algorithm eq. (7.2)
double fitLogOdds(const Candidate& candidate);

/// Returns the part of the log-odds (7.2) that comes from the lead of a score over the best
/// rival's. \cite algorithm eq. (7.2)
double leadLogOdds(double score, double rival_score);

/// Returns the evidence of one scan that the robot is in the map at all: the log-odds (7.2) at
/// candidate k without their prior. The rival is the best other candidate. Evidence of scans of
/// different areas may be added up. \cite algorithm eq. (7.2)
double inMapLogOdds(const RelocationResult& result, std::size_t k);

/// What may keep the right pose from being a candidate.
struct Missed
{
  double unproposed = 0;  ///< prior probability that it was not proposed, \cite algorithm eq. (7.6)
  bool unrefined = false;  ///< more places fitted than were refined, \cite algorithm eq. (7.8)
};

/// Distributes probability over the candidates (best first, scores set) and "elsewhere", and sets
/// the verdict. A candidate gains by what it explains and by its lead over the best rival, which
/// measures what the background reaches. Look-alikes share the probability.
/// Poses `outside` a prior region are rivals with a small prior that count as "elsewhere". So does
/// the right pose where it was `missed`. \cite algorithm eq. (7.3), (7.6), (7.8)
void weighCandidates(RelocationResult& result, const std::vector<Candidate>& outside = {},
                     const Missed& missed = {});

/// The same for maps without a dense field, where scores are log-odds against "all clutter". There
/// the candidates compete with the clutter hypothesis itself. `place_background` is for scenes
/// without walls: the expected number of hypotheses as good as the first by chance, eq. (5.12).
/// `missed` is the prior probability that a search that was cut short has missed the right pose.
/// \cite algorithm eq. (7.4)
void weighByLogOdds(RelocationResult& result, std::optional<double> place_background = {},
                    double missed = 0);
}  // namespace sigloc

// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "matching/dense/DenseVerifier.h"
#include "sigloc/matching/SignatureMatcher.h"

namespace sigloc
{
/// Returns the tempered log-likelihood of a dense score in about [-1, 1]: what a score says about a
/// pose once the correlation of neighbouring beams is allowed for. \cite algorithm eq. (7.1)
double logLikelihoodOfScore(double score);

/// Returns how well a pose explains what is seen, in [0, 1]: of the returns that nothing unmapped
/// cut short, the share on walls, less what came through walls. \cite algorithm eq. (8.11)
double reliabilityOf(const DenseEvidence& evidence);

/// Returns the score of the returns that nothing unmapped cut short, in [-2, 1]: what (6.8) would
/// be if nothing stood in the way. \cite algorithm eq. (8.23)
double scoreOfUnhidden(const DenseEvidence& evidence);

/// Returns the share, in [0, 1], of what ends where the map knows something that it does not
/// explain. What ends in its free space counts as explained: people and moved furniture hide walls.
/// \cite algorithm eq. (8.21)
double unexplainedShare(const DenseEvidence& evidence);

/// Returns what a tracked pose's scan adds to the log-odds of standing in the map, were all that it
/// sees new to the track: how much of it the map explains, and how little it contradicts.
/// \cite algorithm eq. (8.21)
double trackedLogOdds(const DenseEvidence& evidence);

/// Prior log-odds of standing in the map: one wake-up in fourteen is somewhere else.
/// \cite algorithm eq. (7.2)
constexpr double kPriorHereLogOdds = 2.6;

/// Returns what a pose by itself adds to the log-odds of standing there rather than somewhere else,
/// prior and rivals aside: how much of the scan it explains and how telling the scan is.
/// \cite algorithm eq. (7.2)
double fitLogOdds(const Candidate& candidate);

/// Returns how much the log-odds of (7.2) gain from the lead of a score over the best rival's.
/// \cite algorithm eq. (7.2)
double leadLogOdds(double score, double rival_score);

/// Returns how much candidate k's scan speaks for standing in the map at all: the log-odds (7.2)
/// without their prior, the best other candidate being the rival. Evidence of one scan, to be added
/// up over scans of different places. \cite algorithm eq. (7.2)
double inMapLogOdds(const RelocationResult& result, std::size_t k);

/// Distributes probability over candidates (best first, scores set) and "elsewhere", and fills the
/// verdict. A candidate convinces by what it explains and by its lead over the best rival:
/// look-alikes share the weight, and the runner-up measures what chance reaches. Poses `outside` a
/// prior region are rivals with a small prior that count as "elsewhere". So does the right place if
/// it was not proposed, the probability of which, before any score is looked at, is `missed`.
/// \cite algorithm eq. (7.3), (7.6)
void weighCandidates(RelocationResult& result, const std::vector<Candidate>& outside = {},
                     double missed = 0);

/// The same for candidates whose scores are log-odds against "all clutter" (maps without a dense
/// field): the clutter hypothesis itself is what they compete with. Of scenes without walls
/// `chance_of_places` says how many hypotheses as good as the first chance would give, (5.12).
/// \cite algorithm eq. (7.4)
void weighByLogOdds(RelocationResult& result, std::optional<double> chance_of_places = {});
}  // namespace sigloc

// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/matching/SignatureMatcher.h"

#include <algorithm>
#include <array>
#include <future>
#include <stdexcept>

#include "features/feature_values.h"
#include "geometry/same_place.h"
#include "map/wall_blur.h"
#include "matching/candidate_probabilities.h"
#include "matching/candidates.h"
#include "matching/dense/DenseVerifier.h"
#include "matching/dense/PoseProposer.h"
#include "matching/features/FeatureVerifier.h"
#include "matching/features/GeneratorOptions.h"
#include "matching/features/PreparedScene.h"
#include "matching/generators.h"
#include "matching/keypoints/KeyPairSearch.h"

namespace sigloc
{
using mrpt::math::TPose2D;

namespace
{
constexpr double kPoorScore = 0.65;  // below this score further poses are proposed, section 4 (e)
constexpr std::array<std::size_t, 3> kPairProposals = {1024, 4096, 16000};  // after each round
constexpr std::size_t kLeastSupporters = 3;  // of a pose that ends the search
constexpr std::size_t kLastSupporters = 5;  // the same where no pair is left
constexpr std::size_t kMinLandmarks = 2;  // features needed without a laser
// The probability that the right pose was not proposed where nothing significant was found.
constexpr double kMissed = 0.2;

/// Returns the prior probability that the right pose was not among the hypotheses that features
/// support. It is near 0 where the best pose explains significantly many of them, and 0 in modes
/// (e) and (f), which have no such hypotheses. \cite algorithm eq. (7.6)
double unproposedProbability(const std::vector<FeatureHypothesis>& hypotheses, const TPose2D& best)
{
  if (hypotheses.empty()) return 0;
  double chance = 1;
  for (const FeatureHypothesis& hypothesis : hypotheses)
  {
    if (samePlace(hypothesis.pose.mean, best)) chance = std::min(chance, hypothesis.chance);
  }
  return kMissed * chance;
}

/// How many pairs must propose a pose that ends the search. One that few of all pairs support has
/// few mapped key points, and one like it may have none. \cite algorithm eq. (4.13)
std::size_t supportersNeeded(const KeyPairSearch& search)
{
  return search.finished() ? kLastSupporters : kLeastSupporters;
}

/// Returns whether the best pose needs no further search: it explains the scan well, leads, and
/// different pairs of key points have proposed it. \cite algorithm eq. (4.13)
bool isSettled(const std::vector<RankedPose>& poses, const KeyPairSearch& search)
{
  constexpr double kLead = 0.05;
  constexpr double kGood = 0.9;  // score of a pose that needs no more than this lead
  constexpr double kFair = 0.65;  // least score of a pose with a larger lead
  if (poses.empty()) return false;
  const double score = poses[0].evidence.score;
  const double lead = poses.size() > 1 ? score - poses[1].evidence.score : score;
  if (lead < kLead || score < kFair || (score < kGood && score + lead < 1)) return false;
  return search.supportersOf(poses[0].pose) >= supportersNeeded(search);
}

std::vector<PoseProposal> proposalsOf(const std::vector<FeatureHypothesis>& hypotheses)
{
  std::vector<PoseProposal> proposals;
  proposals.reserve(hypotheses.size());
  for (const FeatureHypothesis& hypothesis : hypotheses)
  {
    const TPose2D& pose = hypothesis.pose.mean;
    proposals.push_back(
        {static_cast<float>(pose.x), static_cast<float>(pose.y), static_cast<float>(pose.phi)});
  }
  return proposals;
}
}  // namespace

SignatureMatcher::SignatureMatcher(std::shared_ptr<const FeatureMap> map,
                                   const MatcherOptions& options)
    : map_(std::move(map)), options_(options)
{
  if (!map_) throw std::invalid_argument("SignatureMatcher: no map");
  checkOptions(options);
  const bool dense = map_->field() && options.use_dense_field;
  const auto mode = static_cast<GenerationMode>(options.mode);
  if (mode == GenerationMode::minimal_sets && !dense)
    throw std::invalid_argument("SignatureMatcher: minimal sets need a dense field");
  // The pairs take long, and need nothing of the rest.
  std::future<std::unique_ptr<const KeyPairIndex>> key_pairs;
  if (mode == GenerationMode::automatic && dense)
  {
    key_pairs = std::async(
        [this]
        { return std::make_unique<const KeyPairIndex>(mappedKeyPoints(*map_), map_->error()); });
  }
  if (dense)
  {
    verifier_ =
        std::make_unique<DenseVerifier>(*map_->field(), wallBlur(map_->features(), *map_->field()));
  }
  if (dense && (mode == GenerationMode::automatic || mode == GenerationMode::minimal_sets))
  {
    proposer_ = std::make_unique<PoseProposer>(*map_);
  }
  else
  {
    GeneratorOptions generation;
    generation.seed = options.seed;
    feature_verifier_ = std::make_shared<const FeatureVerifier>(
        std::make_shared<const PreparedMap>(*map_), generation);
    generator_ = makeGenerator(mode, feature_verifier_);
  }
  if (key_pairs.valid()) key_pairs_ = key_pairs.get();
}

SignatureMatcher::~SignatureMatcher() = default;

RelocationResult SignatureMatcher::localize(const ObservedScene& scene,
                                            const std::optional<PoseRegion>& region) const
{
  checkScene(scene);
  RelocationResult result;
  result.view = angularCoverage(scene);
  // Without returns, only a search by features can find anything.
  const bool enough = seesEnoughReturns(scene) ||
                      (generator_ && scene.beams.empty() && scene.features.size() >= kMinLandmarks);
  if (!enough)
  {
    result.verdict = Verdict::too_little_seen;
    result.probability = 1;
    return result;
  }
  // 1. Propose by the signatures of features, in the modes that do so.
  std::vector<FeatureHypothesis> hypotheses;
  if (generator_) hypotheses = generator_->generate(scene.features, result.counters);
  result.complete = result.counters.cut_short == 0;

  // 2. Judge by the dense field, where the map has one and the scene has returns. Without proposals
  // so far, pairs of key points and minimal sets propose, and are judged in turn.
  if (verifier_ && !scene.beams.empty())
  {
    const DenseScan scan = makeDenseScan(scene, kRelocationBeams);
    const VerifiedPoses verified =
        generator_ ? verify(scan, proposalsOf(hypotheses), region, result.counters, {})
                   : searchDensely(scene, scan, region, result.counters);
    // 3. Weigh the candidates and "somewhere else", and decide the verdict.
    concludeDensely(scene, scan, verified, hypotheses, result);
    return result;
  }
  concludeByFeatures(scene, std::move(hypotheses), region, result);
  return result;
}

std::vector<TPose2D> SignatureMatcher::propose(const ObservedScene& scene) const
{
  checkScene(scene);
  MatchingCounters counters;
  std::vector<PoseProposal> proposals =
      generator_ ? proposalsOf(generator_->generate(scene.features, counters))
                 : proposer_->propose(scene.features);
  if (key_pairs_)
  {
    const std::vector<PoseProposal> by_pairs =
        KeyPairSearch(*key_pairs_, scene.features).next(kPairProposals.back());
    proposals.insert(proposals.begin(), by_pairs.begin(), by_pairs.end());
  }
  if (proposer_)
  {
    const std::vector<PoseProposal> further = proposer_->proposeFurther(scene.features);
    proposals.insert(proposals.end(), further.begin(), further.end());
  }
  std::vector<TPose2D> poses;
  poses.reserve(proposals.size());
  for (const PoseProposal& p : proposals) poses.emplace_back(p.x, p.y, p.phi);
  return poses;
}

/// Pairs of key points come first. What they propose is judged once any pose has enough supporters,
/// else together with what minimal sets propose.
SignatureMatcher::VerifiedPoses SignatureMatcher::searchDensely(
    const ObservedScene& scene, const DenseScan& scan, const std::optional<PoseRegion>& region,
    MatchingCounters& counters) const
{
  if (!key_pairs_) return verifyMinimalSets(scene, scan, region, counters, {}, {});
  KeyPairSearch search(*key_pairs_, scene.features);
  VerifiedPoses verified;
  std::vector<PoseProposal> pending;
  for (const std::size_t wanted : kPairProposals)
  {
    const std::vector<PoseProposal> proposals = search.next(wanted);
    counters.hypotheses += proposals.size();
    pending.insert(pending.end(), proposals.begin(), proposals.end());
    if (!pending.empty() && search.anySupportedBy(supportersNeeded(search)))
    {
      verified = verify(scan, std::move(pending), region, counters, std::move(verified));
      pending.clear();
    }
    if (search.finished() || isSettled(verified.inside, search)) break;
  }
  counters.signature_pairs += search.entriesRead();
  if (isSettled(verified.inside, search))
  {
    ++counters.settled_by_pairs;
    return verified;
  }
  return verifyMinimalSets(scene, scan, region, counters, std::move(pending), std::move(verified));
}

/// The first proposals explain most scenes. Where they do so poorly, their results compete with
/// those of further proposals.
SignatureMatcher::VerifiedPoses SignatureMatcher::verifyMinimalSets(
    const ObservedScene& scene, const DenseScan& scan, const std::optional<PoseRegion>& region,
    MatchingCounters& counters, std::vector<PoseProposal> pending, VerifiedPoses before) const
{
  std::vector<PoseProposal> proposals = proposer_->propose(scene.features);
  counters.hypotheses += proposals.size();
  proposals.insert(proposals.end(), pending.begin(), pending.end());
  VerifiedPoses first = verify(scan, std::move(proposals), region, counters, std::move(before));
  if (!first.inside.empty() && first.inside.front().evidence.score >= kPoorScore) return first;
  proposals = proposer_->proposeFurther(scene.features);
  counters.hypotheses += proposals.size();
  return verify(scan, std::move(proposals), region, counters, std::move(first));
}

SignatureMatcher::VerifiedPoses SignatureMatcher::verify(const DenseScan& scan,
                                                         std::vector<PoseProposal> proposals,
                                                         const std::optional<PoseRegion>& region,
                                                         MatchingCounters& counters,
                                                         VerifiedPoses before) const
{
  const auto ranked = [&](const std::vector<PoseProposal>& poses, std::vector<RankedPose> rivals)
  { return verifier_->rank(scan, poses, options_.max_candidates, counters, std::move(rivals)); };
  VerifiedPoses out;
  if (region)
  {
    const auto outside = std::stable_partition(proposals.begin(), proposals.end(),
                                               [&](const PoseProposal& p) {
                                                 return region->contains({p.x, p.y, p.phi});
                                               });
    out.outside = ranked({outside, proposals.end()}, std::move(before.outside));
    proposals.erase(outside, proposals.end());
  }
  out.inside = ranked(proposals, std::move(before.inside));
  return out;
}

void SignatureMatcher::concludeDensely(const ObservedScene& scene, const DenseScan& scan,
                                       const VerifiedPoses& verified,
                                       const std::vector<FeatureHypothesis>& hypotheses,
                                       RelocationResult& result) const
{
  result.candidates = candidatesOf(verified.inside, *verifier_, scene);
  for (Candidate& candidate : result.candidates)
  {
    candidate.pose.covariance = verifier_->covarianceAt(scan, candidate.pose.mean);
    candidate.pose = withCommonError(candidate.pose, map_->error());
  }
  Missed missed;
  if (!result.candidates.empty())
    missed.unproposed = unproposedProbability(hypotheses, result.candidates.front().pose.mean);
  missed.unrefined = result.complete && result.counters.cut_short > 0;
  weighCandidates(result, candidatesOf(verified.outside, *verifier_, scene), missed);
}

void SignatureMatcher::concludeByFeatures(const ObservedScene& scene,
                                          std::vector<FeatureHypothesis> hypotheses,
                                          const std::optional<PoseRegion>& region,
                                          RelocationResult& result) const
{
  // Log-odds do not tie as scores in a field do.
  const std::size_t most =
      std::min<std::size_t>(options_.max_candidates, DenseVerifier::kUsuallyRanked);
  std::optional<double> place_background;
  for (FeatureHypothesis& hypothesis : hypotheses)
  {
    if (result.candidates.size() == most) break;
    if (region && !region->contains(hypothesis.pose.mean)) continue;
    Candidate candidate;
    candidate.pose = hypothesis.pose;
    candidate.score = hypothesis.log_odds;
    if (result.candidates.empty() && !seesWalls(scene.features))
      place_background = hypothesis.chance;
    candidate.pairings = std::move(hypothesis.pairings);
    result.candidates.push_back(std::move(candidate));
  }
  weighByLogOdds(result, place_background, result.complete ? 0 : kMissed);
}
}  // namespace sigloc

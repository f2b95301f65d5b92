// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sigloc/config/option_fields.h"
#include "sigloc/features/ObservedScene.h"
#include "sigloc/geometry/GaussianPose.h"
#include "sigloc/map/FeatureMap.h"
#include "sigloc/matching/RelocationResult.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace sigloc
{
/// How hypotheses are generated: the modes of \cite algorithm section 4.
enum class GenerationMode : std::uint8_t
{
  automatic = 0,  ///< (f) key pairs, then (e), for a dense field; else (d)
  plain = 1,  ///< (a) compares every signature with every mapped one
  anchors = 2,  ///< (b) sampled anchors and partners
  pairs = 3,  ///< (c) pair index
  patterns = 4,  ///< (d) patterns of places, falling back to pairs and anchors
  minimal_sets = 5,  ///< (e) minimal sets of features, scored by the dense field
};

/// How SignatureMatcher relocates. Units, ranges and meanings are in `visitFields`.
struct MatcherOptions
{
  std::uint32_t mode = 0;
  bool use_dense_field = true;
  std::uint32_t max_candidates = 32;
  std::uint32_t min_beams = 10;
  std::uint32_t seed = 1;

  template <class V>
  static void visitFields(V&& visit)
  {
    using O = MatcherOptions;
    visit(
        OptionField{"mode", &O::mode, 0U, 5U,
                    "[-] 0: automatic; 1 to 4: by features, (a) to (d); 5: by minimal sets, (e)"});
    visit(OptionField{"use_dense_field", &O::use_dense_field, false, true,
                      "[-] verify proposed poses in the dense field where the map has one"});
    visit(OptionField{"max_candidates", &O::max_candidates, 1U, 1000U,
                      "[-] returned at most; after ten only those that tie with the first"});
    visit(OptionField{"min_beams", &O::min_beams, 1U, 1000U,
                      "[-] with fewer returns the verdict is too little seen"});
    visit(OptionField{"seed", &O::seed, 0U, 0xFFFFFFFFU, "[-] of the sampling modes"});
  }
};

class PoseProposer;
class DenseVerifier;
class KeyPairIndex;
class FeatureHypothesisGenerator;
class FeatureVerifier;
struct DenseScan;
struct FeatureHypothesis;
struct PoseProposal;
struct RankedPose;

/// Finds the poses in a known map that explain a scene. With a dense field pairs of key points
/// propose them, mode (f), then minimal sets, mode (e). Without one, signatures of features do,
/// modes (a) to (d).
///
///     const SignatureMatcher matcher(map);
///     const RelocationResult result = matcher.localize(observeScene(scans));
///     if (result.verdict == Verdict::localized) drive(result.candidates.front().pose);
///
/// Construction builds the indices. `localize` is const and thread-safe. Its result depends only on
/// the scene, the region, the options and the seed. \cite algorithm sections 4 to 7
class SignatureMatcher
{
 public:
  /// Throws std::invalid_argument for a null map, for options outside their ranges, for mode
  /// `minimal_sets` without a dense field, and for mode `plain` above 10 000 features.
  explicit SignatureMatcher(std::shared_ptr<const FeatureMap> map,
                            const MatcherOptions& options = {});
  ~SignatureMatcher();
  SignatureMatcher(const SignatureMatcher&) = delete;
  SignatureMatcher& operator=(const SignatureMatcher&) = delete;

  /// Returns ranked candidates and a verdict. With a region the candidates come from proposals
  /// inside it. Poses outside that fit count as elsewhere, with a prior of 0.01 each.
  /// Throws std::invalid_argument for a scene that cannot be used. It has a number that is not
  /// finite or out of range, a beam of no sensor origin, or a parent that is no feature.
  RelocationResult localize(const ObservedScene& scene,
                            const std::optional<PoseRegion>& region = std::nullopt) const;

  /// Returns the poses that are proposed for a scene, before the dense field verifies any: for
  /// evaluation and drawing.
  std::vector<mrpt::math::TPose2D> propose(const ObservedScene& scene) const;

  /// True for a scene with `min_beams` returns, the fewest that a search in a dense field uses.
  bool seesEnoughReturns(const ObservedScene& scene) const
  {
    return scene.beams.size() >= options_.min_beams;
  }

  const FeatureMap& map() const { return *map_; }
  const MatcherOptions& options() const { return options_; }
  /// The dense verifier, or null when the map has no dense field or it is switched off.
  const DenseVerifier* verifier() const { return verifier_.get(); }
  /// The verifier by features alone, or null where the dense verifier is used.
  const FeatureVerifier* featureVerifier() const
  {
    return verifier_ ? nullptr : feature_verifier_.get();
  }

 private:
  /// The poses that passed verification in the dense field, best first.
  struct VerifiedPoses
  {
    std::vector<RankedPose> inside, outside;  ///< of the region
  };
  VerifiedPoses verify(const DenseScan& scan, std::vector<PoseProposal> proposals,
                       const std::optional<PoseRegion>& region, MatchingCounters& counters,
                       VerifiedPoses before) const;
  VerifiedPoses searchDensely(const ObservedScene& scene, const DenseScan& scan,
                              const std::optional<PoseRegion>& region,
                              MatchingCounters& counters) const;
  VerifiedPoses verifyMinimalSets(const ObservedScene& scene, const DenseScan& scan,
                                  const std::optional<PoseRegion>& region,
                                  MatchingCounters& counters, std::vector<PoseProposal> pending,
                                  VerifiedPoses before) const;
  /// Fills the result from the verified poses. `hypotheses` are those that the proposals came from;
  /// empty for mode (e), which hardly ever misses the right pose.
  void concludeDensely(const ObservedScene& scene, const DenseScan& scan,
                       const VerifiedPoses& verified,
                       const std::vector<FeatureHypothesis>& hypotheses,
                       RelocationResult& result) const;
  /// The same from hypotheses that only features have judged.
  void concludeByFeatures(const ObservedScene& scene, std::vector<FeatureHypothesis> hypotheses,
                          const std::optional<PoseRegion>& region, RelocationResult& result) const;

  std::shared_ptr<const FeatureMap> map_;
  MatcherOptions options_;
  std::unique_ptr<const DenseVerifier> verifier_;
  std::unique_ptr<const PoseProposer> proposer_;  // mode (e)
  std::unique_ptr<const KeyPairIndex> key_pairs_;  // mode (f)
  std::shared_ptr<const FeatureVerifier> feature_verifier_;  // of modes (a) to (d)
  std::unique_ptr<const FeatureHypothesisGenerator> generator_;  // modes (a) to (d)
};
}  // namespace sigloc

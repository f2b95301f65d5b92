// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <functional>
#include <stdexcept>
#include <utility>

#include "eval/data/method_names.h"
#include "eval/methods/feature_methods.h"
#include "eval/methods/features/FeatureVoting.h"
#include "eval/methods/lattice/lattice_search.h"
#include "eval/methods/RelocationMethod.h"
#include "map/wall_blur.h"
#include "matching/candidate_probabilities.h"
#include "matching/candidates.h"
#include "matching/dense/DenseVerifier.h"
#include "sigloc/features/observe_scans.h"

namespace sigloc
{
namespace
{
class SignatureRelocation : public RelocationMethod
{
 public:
  SignatureRelocation(const EvaluationMap& map, const RelocationMethodOptions& options,
                      GenerationMode mode)
      : matcher_(map.features, matcherOptions(options, mode)), region_(options.region)
  {
  }

  RelocationResult localize(const std::vector<LaserScan>& scans) const override
  {
    return matcher_.localize(observeScene(scans), region_);
  }

  std::optional<std::vector<mrpt::math::TPose2D>> propose(
      const std::vector<LaserScan>& scans) const override
  {
    return matcher_.propose(observeScene(scans));
  }

  bool claimsVerdict() const override { return true; }

 private:
  static MatcherOptions matcherOptions(const RelocationMethodOptions& options, GenerationMode mode)
  {
    MatcherOptions out;
    out.mode = static_cast<std::uint32_t>(mode);
    out.use_dense_field = options.use_dense_field;
    out.seed = options.seed;
    return out;
  }

  SignatureMatcher matcher_;
  std::optional<PoseRegion> region_;
};

/// What the dense searches differ in.
struct DenseVariant
{
  bool pruned = false;  ///< by branch and bound
  bool own_raster = false;  ///< the raster that signatures use, of 5 cm where scans made the map
  std::uint32_t refined = DenseSearchOptions().refined;
};

DenseSearchSpace searchSpaceOf(const EvaluationMap& map, const RelocationMethodOptions& options,
                               const DenseVariant& variant)
{
  if (!map.raster) throw std::invalid_argument("a dense search needs a map with a grid or scans");
  DenseSearchOptions search;
  search.region = options.region;
  search.refined = variant.refined;
  return {variant.own_raster ? rasterOf(*map.features->field()) : *map.raster, search};
}

/// The reference search and its other forms share all but the search itself, and the raster.
class DenseRelocation : public RelocationMethod
{
 public:
  DenseRelocation(const EvaluationMap& map, const RelocationMethodOptions& options,
                  const DenseVariant& variant)
      : space_(searchSpaceOf(map, options, variant))
  {
    if (variant.pruned) pruned_search_.emplace(space_);
  }

  RelocationResult localize(const std::vector<LaserScan>& scans) const override
  {
    const auto points = space_.latticePoints(scans);
    RelocationResult result;
    if (points.empty()) return result;
    const LatticeSearchResult found =
        pruned_search_ ? pruned_search_->search(points) : searchExhaustively(space_, points);
    result.candidates = space_.refineAndRank(found.best, scans);
    result.verdict = Verdict::ambiguous;
    result.counters.poses_scored = found.poses_scored;
    return result;
  }

  double lookupsPerPose() const override { return space_.options().points; }

 private:
  DenseSearchSpace space_;
  std::optional<BranchAndBoundSearch> pruned_search_;
};

/// Scores free poses on a coarse lattice by our own dense cascade: our method without the features.
class LatticeRelocation : public RelocationMethod
{
 public:
  LatticeRelocation(const EvaluationMap& map, const RelocationMethodOptions& options)
      : map_(map.features), verifier_(fieldOf(*map_), wallBlur(map_->features(), fieldOf(*map_)))
  {
    DenseSearchOptions lattice;
    lattice.lattice_step = 0.4;
    lattice.headings = 60;
    lattice.region = options.region;
    for (const mrpt::math::TPose2D& pose : freeLatticePoses(rasterOf(*map_->field()), lattice))
    {
      proposals_.push_back(
          {static_cast<float>(pose.x), static_cast<float>(pose.y), static_cast<float>(pose.phi)});
    }
  }

  RelocationResult localize(const std::vector<LaserScan>& scans) const override
  {
    const ObservedScene scene = observeScene(scans);
    RelocationResult result;
    if (scene.beams.empty()) return result;
    const DenseScan scan = makeDenseScan(scene, kRelocationBeams);
    result.candidates = candidatesOf(verifier_.rank(scan, proposals_, kMaxRanked, result.counters),
                                     verifier_, scene);
    result.view = angularCoverage(scene);
    weighCandidates(result);
    return result;
  }

  bool claimsVerdict() const override { return true; }

 private:
  static constexpr std::size_t kMaxRanked = 10;

  static const DenseField& fieldOf(const FeatureMap& map)
  {
    if (!map.field()) throw std::invalid_argument("the lattice needs a map with a dense field");
    return *map.field();
  }

  std::shared_ptr<const FeatureMap> map_;
  DenseVerifier verifier_;
  std::vector<PoseProposal> proposals_;
};

class VotingRelocation : public RelocationMethod
{
 public:
  VotingRelocation(const EvaluationMap& map, const RelocationMethodOptions& options)
      : map_(map.features), voting_(*map_, votingOptions(options))
  {
  }

  RelocationResult localize(const std::vector<LaserScan>& scans) const override
  {
    FeatureVoting::Result votes = voting_.vote(observeScene(scans).features);
    RelocationResult result;
    result.candidates = std::move(votes.candidates);
    result.verdict = Verdict::ambiguous;
    result.counters.hypotheses = votes.votes;
    return result;
  }

 private:
  static FeatureVotingOptions votingOptions(const RelocationMethodOptions& options)
  {
    FeatureVotingOptions out;
    out.region = options.region;
    return out;
  }

  std::shared_ptr<const FeatureMap> map_;
  FeatureVoting voting_;
};

/// An opponent that uses features alone.
class FeatureOpponentRelocation : public RelocationMethod
{
 public:
  FeatureOpponentRelocation(const EvaluationMap& map, const RelocationMethodOptions& options,
                            const char* name)
      : map_(map.features),
        method_(makeFeatureMethod(name, *map_, generatorOptions(options))),
        region_(options.region)
  {
  }

  RelocationResult localize(const std::vector<LaserScan>& scans) const override
  {
    RelocationResult result;
    result.verdict = Verdict::ambiguous;
    for (const FeatureHypothesis& hypothesis :
         method_->generate(observeScene(scans).features, result.counters))
    {
      if (region_ && !region_->contains(hypothesis.pose.mean)) continue;
      if (result.candidates.size() == kMaxRanked) break;
      Candidate candidate;
      candidate.pose = hypothesis.pose;
      candidate.score = hypothesis.log_odds;
      candidate.pairings = hypothesis.pairings;
      result.candidates.push_back(std::move(candidate));
    }
    return result;
  }

 private:
  static constexpr std::size_t kMaxRanked = 10;

  static GeneratorOptions generatorOptions(const RelocationMethodOptions& options)
  {
    GeneratorOptions out;
    out.seed = options.seed;
    return out;
  }

  std::shared_ptr<const FeatureMap> map_;
  std::unique_ptr<FeatureHypothesisGenerator> method_;
  std::optional<PoseRegion> region_;
};

struct MethodEntry
{
  const char* name;
  std::function<std::unique_ptr<RelocationMethod>(const EvaluationMap&,
                                                  const RelocationMethodOptions&)>
      make;
};

template <class Method, class... Arguments>
MethodEntry entry(const char* name, Arguments... arguments)
{
  return {name, [=](const EvaluationMap& map, const RelocationMethodOptions& options)
          { return std::make_unique<Method>(map, options, arguments...); }};
}

MethodEntry monteCarlo(const char* name)
{
  return {name, [=](const EvaluationMap& map, const RelocationMethodOptions& options)
          { return detail::makeMonteCarloRelocation(name, map, options); }};
}

const std::vector<MethodEntry>& methodTable()
{
  static const std::vector<MethodEntry> kTable = {
      entry<SignatureRelocation>("signature", GenerationMode::automatic),
      entry<SignatureRelocation>("signature-plain", GenerationMode::plain),
      entry<SignatureRelocation>("signature-anchors", GenerationMode::anchors),
      entry<SignatureRelocation>("signature-pairs", GenerationMode::pairs),
      entry<SignatureRelocation>("signature-patterns", GenerationMode::patterns),
      entry<SignatureRelocation>("signature-bases", GenerationMode::minimal_sets),
      entry<DenseRelocation>("exhaustive", DenseVariant{}),
      entry<DenseRelocation>("exhaustive-fine", DenseVariant{false, true}),
      entry<DenseRelocation>("branch-and-bound", DenseVariant{true, false, 10}),
      entry<DenseRelocation>("branch-and-bound-1", DenseVariant{true, false, 1}),
      entry<LatticeRelocation>("lattice"),
      entry<VotingRelocation>("voting"),
      entry<FeatureOpponentRelocation>("jcbb", "jcbb"),
      entry<FeatureOpponentRelocation>("jcbb-0.35", "jcbb-0.35"),
      entry<FeatureOpponentRelocation>("jcbb-0.25", "jcbb-0.25"),
      entry<FeatureOpponentRelocation>("jcbb-greedy", "jcbb-greedy"),
      entry<FeatureOpponentRelocation>("interpretation-tree", "interpretation-tree"),
      entry<FeatureOpponentRelocation>("clique", "clique"),
      monteCarlo("mcl"),
      monteCarlo("mcl-tuned"),
  };
  return kTable;
}
}  // namespace

std::vector<std::string> relocationMethodNames()
{
  std::vector<std::string> names;
  for (const MethodEntry& method : methodTable()) names.emplace_back(method.name);
  return names;
}

std::unique_ptr<RelocationMethod> makeRelocationMethod(const std::string& name,
                                                       const EvaluationMap& map,
                                                       const RelocationMethodOptions& options)
{
  for (const MethodEntry& method : methodTable())
  {
    if (name == method.name) return method.make(map, options);
  }
  refuseMethod(name, relocationMethodNames());
}
}  // namespace sigloc

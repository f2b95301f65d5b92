// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/landmarks/FeatureAssociation.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "matching/features/negative_information.h"
#include "signature/location_constraint.h"
#include "tracking/tracks/pose_update.h"
#include "tracking/tracks/TrackSet.h"

namespace sigloc
{
namespace
{
constexpr std::size_t kAnchors = 3;  // observed features that bases start from
constexpr std::size_t kMostPartners = 6;  // mapped features tried for one observed feature

/// True for poses that two tracks may have side by side: farther apart than merging reaches, and
/// farther than their uncertainty explains.
bool distinct(const FeatureAssociation& a, const FeatureAssociation& b)
{
  const GaussianPose p = toGaussian(a.pose);
  const GaussianPose q = toGaussian(b.pose);
  return !wouldMerge(p.mean, q.mean) && squaredMahalanobisDistance(p, q) > kUpdateGate;
}

/// Returns ln of the Gaussian density of an innovation. A residual that is not `fresh` repeats the
/// map's error, so its squared distance is replaced by the mean, the degrees of freedom. Eq. (8.14)
double logDensity(double squared_distance, const Symmetric2& s, int degrees, bool fresh)
{
  const double volume = degrees == 2 ? determinant(s) : s.xx;
  return -0.5 *
         ((fresh ? squared_distance : degrees) + degrees * std::log(2 * M_PI) + std::log(volume));
}
}  // namespace

/// An association that is being built.
struct FeatureAssociator::Growing
{
  FeatureAssociation result;
  double joint_distance = 0;
  int joint_degrees = 0;
  std::vector<bool> paired;  // by observed feature
  std::size_t fresh = 0;
};

/// The mapped features that an observed feature may be at the predicted pose.
struct FeatureAssociator::Option
{
  std::uint32_t observed;
  double range;  // [m], from the robot
  std::vector<FeaturePairing> pairings;
};

FeatureAssociator::FeatureAssociator(const FeatureVerifier& verifier, const FeatureSpacing& spacing,
                                     const std::vector<Feature>& observed, double travelled)
    : verifier_(verifier),
      spacing_(spacing),
      scene_(observed, verifier.map(), verifier.options(), verifier.gates()),
      order_(observed.size()),
      travelled_(travelled)
{
  std::iota(order_.begin(), order_.end(), 0U);
  std::sort(order_.begin(), order_.end(),
            [&](std::uint32_t a, std::uint32_t b)
            {
              const bool derived_a = observed[a].parent >= 0;
              const bool derived_b = observed[b].parent >= 0;
              if (derived_a != derived_b) return derived_b;
              const double range_a = observed[a].position.norm();
              const double range_b = observed[b].position.norm();
              return range_a != range_b ? range_a < range_b : a < b;
            });
}

double FeatureAssociator::relativeSigma(std::uint32_t q) const
{
  return verifier_.map().map().error().relativeSigma(scene_.views[q].position().norm());
}

/// Adds a pairing if it is jointly compatible with those before. Eq. (5.6), (8.13), (8.14)
bool FeatureAssociator::tryPairing(const FeaturePairing& pairing, Growing& growing) const
{
  FeatureAssociation& result = growing.result;
  const DirectedFeature& observed = scene_.views[pairing.observed];
  const DirectedFeature& mapped = verifier_.map().view(pairing.mapped);
  const double relative = relativeSigma(pairing.observed);
  const PlanarMeasurement place = placeMeasurement(result.pose, observed, mapped, relative);
  const Symmetric2 map_noise = mapNoise(result.pose, observed, mapped, relative);
  const Symmetric2 s = result.correlation.innovation(result.pose, place, pairing.mapped, map_noise);
  double distance = squaredInnovation(place, s);
  int degrees = 2;
  const bool fresh = !result.correlation.knows(pairing.mapped);
  double gain = std::log(verifier_.options().detection_probability /
                         spacing_.clutterDensity(observed.type())) +
                logDensity(distance, s, 2, fresh);
  const bool directed = hasBearing(observed.type());
  PlanarMeasurement direction;
  if (directed)
  {
    direction = directionMeasurement(result.pose, observed, mapped);
    const Symmetric2 turn = innovationCovariance(result.pose.covariance, direction);
    const double turned = squaredInnovation(direction, turn);
    gain += logDensity(turned, turn, 1, fresh);
    distance += turned;
    ++degrees;
  }
  const double joint = growing.joint_distance + distance;
  if (!(joint <= verifier_.jointGate(growing.joint_degrees + degrees))) return false;

  growing.joint_distance = joint;
  growing.joint_degrees += degrees;
  growing.fresh += fresh;
  growing.paired[pairing.observed] = true;
  result.pairings.push_back(pairing);
  result.log_odds += gain;
  result.correlation.update(result.pose, place, pairing.mapped, map_noise, travelled_);
  if (directed)
  {
    result.correlation.updateFreely(result.pose,
                                    directionMeasurement(result.pose, observed, mapped));
  }
  return true;
}

/// Pairs the other features, nearest to the robot first, each with its nearest compatible partner.
void FeatureAssociator::grow(Growing& growing) const
{
  FeatureAssociation& result = growing.result;
  for (const std::uint32_t q : order_)
  {
    if (growing.paired[q] || !counts(scene_, {q, 0}, result.pairings)) continue;
    const bool shared = isSegment(scene_.views[q].type());  // a wall is seen in several pieces
    const FeatureVerifier::Workspace::Match* best = nullptr;
    const auto candidates = verifier_.compatibleAt(scene_, q, result.pose, relativeSigma(q));
    for (const auto& candidate : candidates)
    {
      const bool taken = !shared && std::any_of(result.pairings.begin(), result.pairings.end(),
                                                [&](const FeaturePairing& other) {
                                                  return other.mapped == candidate.pairing.mapped;
                                                });
      const bool nearer = !best || candidate.squared_distance < best->squared_distance;
      if (!taken && nearer) best = &candidate;
    }
    if (best) tryPairing(best->pairing, growing);
  }
}

/// Adds the log-odds of the features that were seen but not paired, and of the mapped ones that
/// were missed. Eq. (8.14)
FeatureAssociation FeatureAssociator::finished(const Growing& growing) const
{
  FeatureAssociation result = growing.result;
  for (std::uint32_t q = 0; q < scene_.size(); ++q)
  {
    const bool counted = counts(scene_, {q, 0}, result.pairings);
    if (growing.paired[q] || !counted) continue;
    // Where nothing is mapped, a feature without a partner is no surprise.
    const DirectedFeature& view = scene_.views[q];
    const bool expected = spacing_.isMapped(result.pose.place(view.position()), view.type());
    if (expected) result.log_odds += scene_.miss_gain[q];
  }
  result.log_odds +=
      std::log1p(-verifier_.options().detection_probability) *
      static_cast<double>(countMissedInView(scene_, verifier_.map(), result.pose, result.pairings));
  const std::size_t paired = result.pairings.size();
  result.new_feature_share =
      paired > 0 ? static_cast<double>(growing.fresh) / static_cast<double>(paired) : 0;
  return result;
}

std::vector<FeatureAssociator::Option> FeatureAssociator::optionsAt(
    const PoseEstimate& predicted) const
{
  std::vector<Option> options;
  for (const std::uint32_t q : order_)
  {
    const auto compatible = verifier_.compatibleAt(scene_, q, predicted, relativeSigma(q));
    if (compatible.empty()) continue;
    Option option{q, scene_.views[q].position().norm(), {}};
    option.pairings.reserve(compatible.size());
    for (const auto& match : compatible)
    {
      const bool known = std::any_of(option.pairings.begin(), option.pairings.end(),
                                     [&](const FeaturePairing& other)
                                     { return other.mapped == match.pairing.mapped; });
      if (!known) option.pairings.push_back(match.pairing);
    }
    options.push_back(std::move(option));
  }
  return options;
}

/// Where features have several partners, the nearest ones may be wrong together. Two observed
/// features, far apart, fix a pose that decides the rest. All pairs of partners are tried, for the
/// three observed features with the fewest partners.
std::vector<FeatureAssociation> FeatureAssociator::grownFromBases(
    const Growing& start, const std::vector<Option>& options) const
{
  std::vector<const Option*> anchors;
  for (const Option& option : options)
  {
    if (option.pairings.size() <= kMostPartners) anchors.push_back(&option);
  }
  std::stable_sort(anchors.begin(), anchors.end(),
                   [](const Option* a, const Option* b)
                   { return a->pairings.size() < b->pairings.size(); });
  std::vector<FeatureAssociation> grown;
  for (std::size_t k = 0; k < std::min(kAnchors, anchors.size()); ++k)
  {
    const Option& anchor = *anchors[k];
    const auto distance = [&](const Option* other)
    {
      return (scene_.views[other->observed].position() - scene_.views[anchor.observed].position())
          .norm();
    };
    const Option& partner = **std::max_element(anchors.begin(), anchors.end(),
                                               [&](const Option* a, const Option* b)
                                               { return distance(a) < distance(b); });
    for (const FeaturePairing& first : anchor.pairings)
    {
      Growing half = start;
      if (!tryPairing(first, half)) continue;
      for (const FeaturePairing& second : partner.pairings)
      {
        Growing base = half;
        const bool alone = &partner == &anchor;
        if (!alone && (second.mapped == first.mapped || !tryPairing(second, base))) continue;
        grow(base);
        grown.push_back(finished(base));
        if (alone) break;
      }
    }
  }
  return grown;
}

std::vector<FeatureAssociation> FeatureAssociator::associate(
    const GaussianPose& predicted, const SchmidtKalmanFilter& correlation) const
{
  Growing start;
  start.result.pose = toEstimate(predicted);
  start.result.correlation = correlation;
  start.paired.assign(scene_.size(), false);

  // 1. Pair every feature with its nearest partner; where one is ambiguous, try other starts too.
  Growing nearest = start;
  grow(nearest);
  std::vector<FeatureAssociation> all{finished(nearest)};
  const std::vector<Option> options = optionsAt(start.result.pose);
  const bool ambiguous =
      std::any_of(options.begin(), options.end(),
                  [](const Option& option) { return option.pairings.size() > 1; });
  if (ambiguous)
  {
    std::vector<FeatureAssociation> more = grownFromBases(start, options);
    std::move(more.begin(), more.end(), std::back_inserter(all));
  }

  // 2. The best at each pose. Eq. (8.15)
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.log_odds > b.log_odds; });
  std::vector<FeatureAssociation> kept;
  double sum = 0;
  for (FeatureAssociation& association : all)
  {
    association.share = std::exp(kFeatureTempering * (association.log_odds - all.front().log_odds));
    const bool apart =
        std::all_of(kept.begin(), kept.end(),
                    [&](const FeatureAssociation& other) { return distinct(other, association); });
    if (!apart) continue;
    sum += association.share;
    kept.push_back(association);
  }
  for (FeatureAssociation& association : kept) association.share /= sum;
  return kept;
}
}  // namespace sigloc

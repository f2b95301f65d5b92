// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "matching/features/FeatureVerifier.h"

#include "matching/features/FeatureQuery.h"
#include "matching/features/negative_information.h"
#include "signature/location_constraint.h"
#include "signature/unary_constraint.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sigloc
{
using mrpt::math::TPoint2D;

namespace
{
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr int kTabulatedDegrees = 200;  // degrees of freedom whose gates are tabulated
constexpr double kGiveUp = -2.3;  // ln 0.1, Wald's lower bound of the log-odds, eq. (5.7)
constexpr double kWorthKeeping = 0.6;  // share of the best support that a rival must reach

bool contains(const std::vector<FeaturePairing>& pairings, std::uint32_t mapped)
{
  return std::any_of(pairings.begin(), pairings.end(),
                     [&](const FeaturePairing& pairing) { return pairing.mapped == mapped; });
}

bool samePairings(const std::vector<FeaturePairing>& a, const std::vector<FeaturePairing>& b)
{
  const auto in_b = [&](const FeaturePairing& pairing)
  {
    return std::any_of(
        b.begin(), b.end(),
        [&](const FeaturePairing& other)
        { return other.observed == pairing.observed && other.mapped == pairing.mapped; });
  };
  return a.size() == b.size() && std::all_of(a.begin(), a.end(), in_b);
}

/// Returns the largest variance [m^2] along any direction. It is computed for every feature at
/// every pose, so it avoids std::hypot, which guards against an overflow that cannot occur here.
double largestVariance(double xx, double xy, double yy)
{
  const double half = 0.5 * (xx - yy);
  return 0.5 * (xx + yy) + std::sqrt(half * half + xy * xy);
}

std::uint32_t supportOf(const PreparedScene& scene, const std::vector<FeaturePairing>& pairings)
{
  return static_cast<std::uint32_t>(std::count_if(pairings.begin(), pairings.end(),
                                                  [&](const FeaturePairing& pairing)
                                                  { return counts(scene, pairing, pairings); }));
}
}  // namespace

/// State of the sequential filter over one hypothesis.
struct FeatureVerifier::Filter
{
  PoseEstimate pose;
  double joint_distance = 0;  ///< running sum of the normalised innovations
  int joint_degrees = 0;
  TPoint2D base_place;  ///< [m] robot frame, origin of the map's relative error
};

FeatureVerifier::FeatureVerifier(std::shared_ptr<const PreparedMap> map,
                                 const GeneratorOptions& options)
    : map_(std::move(map)),
      options_(options),
      chi_square_(options.gate_probability, kTabulatedDegrees),
      gates_{chi_square_(1), chi_square_(2), options.min_overlap}
{
}

bool FeatureVerifier::makeBase(FeatureQuery& query, const FeaturePairing& first,
                               const FeaturePairing& second) const
{
  const PreparedScene& scene = query.scene;
  ++query.counters.hypotheses;
  const auto pose =
      poseFromBase({scene.views[first.observed], map_->view(first.mapped)},
                   {scene.views[second.observed], map_->view(second.mapped)}, scene.relative_sigma);
  if (!pose) return false;
  query.workspace.base.pairings.assign({first, second});
  query.workspace.base.pose = *pose;
  return true;
}

bool FeatureVerifier::gatePairing(const PreparedScene& scene, std::uint32_t q, std::uint32_t p,
                                  const PoseEstimate& pose, double relative_sigma,
                                  double& squared_distance) const
{
  const DirectedFeature& observed = scene.views[q];
  const DirectedFeature& mapped = map_->view(p);
  const PlanarMeasurement place = placeMeasurement(pose, observed, mapped, relative_sigma);
  const Symmetric2 innovation = innovationCovariance(pose.covariance, place);
  squared_distance = squaredInnovation(place, innovation);
  if (!(squared_distance <= gates_.planar)) return false;
  if (hasBearing(observed.type()))
  {
    const PlanarMeasurement direction = directionMeasurement(pose, observed, mapped);
    const double distance =
        squaredInnovation(direction, innovationCovariance(pose.covariance, direction));
    if (!(distance <= gates_.scalar)) return false;
    squared_distance += distance;
  }
  if (!unaryCompatible(observed, mapped, gates_.scalar)) return false;
  if (isSegment(observed.type()))
  {
    // The extension constraint (3.12): at least a part of the placed piece lies on its mapped wall.
    const TPoint2D tangent = mapped.tangent();
    const double along = tangent.x * tangent.x * pose.covariance.xx +
                         2 * tangent.x * tangent.y * pose.covariance.xy +
                         tangent.y * tangent.y * pose.covariance.yy +
                         varianceAlong(*observed.feature, observed.tangent()) +
                         varianceAlong(*mapped.feature, tangent);
    const Stretch stretch = placedStretch(pose, observed, mapped);
    if (map_->coveredShare(p, stretch.low, stretch.high, std::sqrt(gates_.scalar * along)) <
        gates_.min_overlap)
    {
      return false;
    }
  }
  return true;
}

/// Returns how many cells and entries of the grid were read.
template <class Visit>
std::uint64_t FeatureVerifier::visitCandidates(const PreparedScene& scene, std::uint32_t q,
                                               const PoseEstimate& pose, double relative_sigma,
                                               Visit&& visit) const
{
  const DirectedFeature& observed = scene.views[q];
  const FeatureType type = observed.type();
  const TPoint2D arm = pose.turn(observed.position());
  const Symmetric3& p = pose.covariance;
  const auto& own = observed.feature->position_covariance;
  // The longest half axis of the gate around the predicted place: an upper bound by the sum of the
  // largest variances of the pose's and the features' parts.
  const double xx = p.xx - 2 * arm.y * p.xt + arm.y * arm.y * p.tt;
  const double xy = p.xy + arm.x * p.xt - arm.y * p.yt - arm.x * arm.y * p.tt;
  const double yy = p.yy + 2 * arm.x * p.yt + arm.x * arm.x * p.tt;
  const double longest = largestVariance(xx, xy, yy) +
                         largestVariance(own(0, 0), own(0, 1), own(1, 1)) +
                         map_->largestPositionVariance(type) + relative_sigma * relative_sigma;
  const double radius = std::sqrt(gates_.planar * std::max(0.0, longest)) + 1e-3;
  if (!isSegment(type))
  {
    return map_->grid().visitNear({pose.x + arm.x, pose.y + arm.y}, radius, type, visit);
  }
  // The grid has samples along a mapped wall, so the search is along the observed piece as well.
  const double step = 2 * map_->grid().cellSize();
  const auto pieces = 1 + static_cast<int>(observed.length() / step);
  const TPoint2D tangent = pose.turn(observed.tangent());
  const double across = std::min(radius, 2.0);
  std::uint64_t read = 0;
  for (int k = 0; k < pieces; ++k)
  {
    const double at = observed.start + observed.length() * (k + 0.5) / static_cast<double>(pieces);
    const TPoint2D place{pose.x + arm.x + tangent.x * at, pose.y + arm.y + tangent.y * at};
    read += map_->grid().visitNear(place, across, type, visit);
  }
  return read;
}

std::vector<FeatureVerifier::Workspace::Match> FeatureVerifier::compatibleAt(
    const PreparedScene& scene, std::uint32_t q, const PoseEstimate& pose,
    double relative_sigma) const
{
  std::vector<Workspace::Match> compatible;
  visitCandidates(scene, q, pose, relative_sigma,
                  [&](std::uint32_t p)
                  {
                    double distance = 0;
                    if (!gatePairing(scene, q, p, pose, relative_sigma, distance)) return;
                    compatible.push_back({distance, {q, p}});
                  });
  return compatible;
}

std::uint32_t FeatureVerifier::bestCandidate(FeatureQuery& query, const CandidateLists* lists,
                                             std::uint32_t q, const Filter& filter,
                                             double& squared_distance) const
{
  const PreparedScene& scene = query.scene;
  const TPoint2D from_base = scene.views[q].position() - filter.base_place;
  const double relative = map_->map().error().relativeSigma(std::sqrt(dot(from_base, from_base)));
  std::uint32_t best = kNone;
  std::uint64_t checks = 0;
  const auto consider = [&](std::uint32_t p)
  {
    ++checks;
    double distance = 0;
    if (!gatePairing(scene, q, p, filter.pose, relative, distance)) return;
    if (best != kNone && distance >= squared_distance) return;
    if (!isSegment(scene.views[q].type()) && contains(query.workspace.pairings, p)) return;
    best = p;
    squared_distance = distance;
  };
  if (lists)
  {
    for (const std::uint32_t p : (*lists)[q]) consider(p);
    query.counters.visits += (*lists)[q].size();
  }
  else
  {
    query.counters.visits += visitCandidates(scene, q, filter.pose, relative, consider);
    checks = std::max<std::uint64_t>(checks, 1);  // a search without candidates is work as well
  }
  query.counters.checks += checks;
  return best;
}

bool FeatureVerifier::associate(FeatureQuery& query, const CandidateLists* lists,
                                std::uint32_t needed, Filter& filter) const
{
  const PreparedScene& scene = query.scene;
  Workspace& workspace = query.workspace;
  const HypothesisBase& base = workspace.base;
  workspace.pairings = base.pairings;
  const std::uint32_t* order = scene.orderFrom(base.pairings.front().observed);
  auto remaining = static_cast<std::uint32_t>(scene.size() - base.pairings.size());
  double evidence = 0;
  for (std::size_t step = 0; step < scene.size(); ++step)
  {
    const std::uint32_t q = order[step];
    const bool in_base =
        std::any_of(base.pairings.begin(), base.pairings.end(),
                    [&](const FeaturePairing& pairing) { return pairing.observed == q; });
    if (in_base) continue;
    if (workspace.pairings.size() + remaining < needed) return false;
    --remaining;

    double distance = 0;
    const std::uint32_t p = bestCandidate(query, lists, q, filter, distance);
    const int degrees = hasBearing(scene.views[q].type()) ? 3 : 2;
    const bool jointly_compatible = p != kNone && filter.joint_distance + distance <=
                                                      chi_square_(filter.joint_degrees + degrees);
    if (!jointly_compatible)
    {
      evidence += scene.miss_gain[q];
      if (!lists && evidence < kGiveUp) return false;
      continue;
    }
    evidence += scene.hit_gain[q];
    filter.joint_distance += distance;
    filter.joint_degrees += degrees;
    const TPoint2D from_base = scene.views[q].position() - filter.base_place;
    const double relative = map_->map().error().relativeSigma(std::sqrt(dot(from_base, from_base)));
    update(filter.pose, placeMeasurement(filter.pose, scene.views[q], map_->view(p), relative));
    if (hasBearing(scene.views[q].type()))
    {
      update(filter.pose, directionMeasurement(filter.pose, scene.views[q], map_->view(p)));
    }
    workspace.pairings.push_back({q, p});
  }
  return supportOf(scene, workspace.pairings) >= needed;
}

std::optional<PoseEstimate> FeatureVerifier::fit(FeatureQuery& query,
                                                 const PoseEstimate& start) const
{
  const PreparedScene& scene = query.scene;
  Workspace& workspace = query.workspace;
  workspace.fitted.clear();
  for (const FeaturePairing& pairing : workspace.pairings)
  {
    if (!counts(scene, pairing, workspace.pairings)) continue;
    workspace.fitted.push_back({scene.views[pairing.observed], map_->view(pairing.mapped)});
  }
  return refinePose(start, workspace.fitted, scene.relative_sigma);
}

void FeatureVerifier::recount(FeatureQuery& query, const PoseEstimate& pose) const
{
  const PreparedScene& scene = query.scene;
  Workspace& workspace = query.workspace;
  workspace.matches.clear();
  for (std::uint32_t q = 0; q < scene.size(); ++q)
  {
    const auto consider = [&](std::uint32_t p)
    {
      ++query.counters.checks;
      double distance = 0;
      if (!gatePairing(scene, q, p, pose, scene.relative_sigma, distance)) return;
      workspace.matches.push_back({distance, {q, p}});
    };
    query.counters.visits += visitCandidates(scene, q, pose, scene.relative_sigma, consider);
  }
  std::sort(workspace.matches.begin(), workspace.matches.end(),
            [](const Workspace::Match& a, const Workspace::Match& b)
            {
              if (a.squared_distance != b.squared_distance)
              {
                return a.squared_distance < b.squared_distance;
              }
              return a.pairing.observed != b.pairing.observed
                         ? a.pairing.observed < b.pairing.observed
                         : a.pairing.mapped < b.pairing.mapped;
            });
  workspace.pairings.clear();
  for (const Workspace::Match& match : workspace.matches)
  {
    const auto& [q, p] = match.pairing;
    const bool taken = std::any_of(
        workspace.pairings.begin(), workspace.pairings.end(),
        [&, q = q, p = p](const FeaturePairing& other) {
          return other.observed == q || (other.mapped == p && !isSegment(scene.views[q].type()));
        });
    if (!taken) workspace.pairings.push_back(match.pairing);
  }
}

double FeatureVerifier::logOdds(FeatureQuery& query, const PoseEstimate& pose) const
{
  const PreparedScene& scene = query.scene;
  const std::vector<FeaturePairing>& pairings = query.workspace.pairings;
  const double log_two_pi = std::log(2 * M_PI);
  // The prior of the pose over the mapped area, times the Laplace volume of its posterior.
  double sum = -std::log(2 * M_PI * map_->area()) +
               0.5 * (3 * log_two_pi + std::log(std::max(determinant(pose.covariance), 1e-300)));
  const auto density = [&](const PlanarMeasurement& m)
  {
    const double noise = m.degrees == 2 ? determinant(m.noise) : m.noise.xx;
    return -0.5 * (squaredInnovation(m, m.noise) + m.degrees * log_two_pi + std::log(noise));
  };
  for (const FeaturePairing& pairing : pairings)
  {
    if (!counts(scene, pairing, pairings)) continue;
    const DirectedFeature& observed = scene.views[pairing.observed];
    const DirectedFeature& mapped = map_->view(pairing.mapped);
    sum += std::log(options_.detection_probability / map_->clutterDensity(observed.type())) +
           density(placeMeasurement(pose, observed, mapped, scene.relative_sigma));
    if (hasBearing(observed.type())) sum += density(directionMeasurement(pose, observed, mapped));
  }
  sum += static_cast<double>(countMissed(scene, *map_, pose, pairings, query.counters)) *
         std::log1p(-options_.detection_probability);
  return sum;
}

void FeatureVerifier::verify(FeatureQuery& query, const CandidateLists* lists) const
{
  const PreparedScene& scene = query.scene;
  HypothesisSet& found = query.found;
  Workspace& workspace = query.workspace;
  const HypothesisBase& base = workspace.base;
  if (found.explains(base.pairings[0], base.pairings[1])) return;
  const auto wanted = std::min(options_.min_support, static_cast<std::uint32_t>(scene.size()));
  const auto rival = static_cast<std::uint32_t>(kWorthKeeping * found.bestSupport());
  const std::uint32_t needed = lists ? wanted : std::max(wanted, rival);

  // 1. Grow the base feature by feature, with ever tighter gates: eq. (5.5) to (5.7).
  Filter filter;
  filter.pose = base.pose;
  filter.base_place = scene.views[base.pairings.front().observed].position();
  if (!associate(query, lists, needed, filter)) return;

  // 2. Refit on all pairings and recount with the tight gates of the refitted pose, twice. This
  // adds what the base's error excluded, and removes what it let in: eq. (5.8).
  PoseEstimate pose = filter.pose;
  constexpr int kRecounts = 2;
  for (int fits = 0; fits <= kRecounts; ++fits)
  {
    const auto refitted = fit(query, pose);
    if (!refitted) return;
    pose = *refitted;
    if (fits == kRecounts) break;
    workspace.before = workspace.pairings;
    recount(query, pose);
    if (supportOf(scene, workspace.pairings) < wanted) return;
    if (samePairings(workspace.before, workspace.pairings)) break;  // nothing left to refit
  }

  // 3. Weigh it against "all clutter": eq. (5.10).
  FeatureHypothesis hypothesis;
  hypothesis.pose = toGaussian(pose);
  hypothesis.pairings = workspace.pairings;
  hypothesis.support = supportOf(scene, workspace.pairings);
  hypothesis.log_odds = logOdds(query, pose);
  found.add(std::move(hypothesis));
}
}  // namespace sigloc

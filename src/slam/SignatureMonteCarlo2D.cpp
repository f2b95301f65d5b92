// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/slam/SignatureMonteCarlo2D.h"

#include <mrpt/math/wrap2pi.h>
#include <mrpt/random/RandomGenerators.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "io/motion_conversion.h"
#include "io/scan_conversion.h"
#include "sigloc/plugin/pose_pdf.h"
#include "sigloc/plugin/SignatureMap.h"
#include "slam/map_matcher.h"
#include "slam/ModeTracker.h"
#include "slam/particle_modes.h"

namespace sigloc
{
using mrpt::math::TPose2D;
using mrpt::obs::CActionCollection;
using mrpt::obs::CSensoryFrame;
using mrpt::slam::CMonteCarloLocalization2D;

namespace
{
constexpr double kGathered = 0.5;  // [m], particles within are a pose given by the caller
constexpr double kGatheredAngle = 0.5;  // [rad]
constexpr std::size_t kCompared = 16;  // particles checked for whether the caller has set them anew

ObservedScene sceneOf(const CSensoryFrame* frame, const FeatureExtractorOptions& extraction)
{
  if (frame == nullptr) return {};
  return observeScene(laserScansOf(*frame), landmarksOf(*frame), extraction);
}

/// The box around the particles, a little wider than the samples reach, and their headings.
PoseRegion boxAround(const CMonteCarloLocalization2D& filter, const TPose2D& mean)
{
  constexpr double kAllHeadings = 2.8;  // [rad], samples that reach farther are of all headings
  const auto& particles = filter.m_particles;
  const TPose2D& first = particles.front().d;
  PoseRegion box{first.x, first.x, first.y, first.y, mean.phi, 0};
  for (const auto& particle : particles)
  {
    box.x_min = std::min(box.x_min, particle.d.x);
    box.x_max = std::max(box.x_max, particle.d.x);
    box.y_min = std::min(box.y_min, particle.d.y);
    box.y_max = std::max(box.y_max, particle.d.y);
    box.heading_tolerance = std::max(box.heading_tolerance,
                                     std::abs(mrpt::math::wrapToPi(particle.d.phi - box.heading)));
  }
  const double beyond = 3.0 / static_cast<double>(particles.size());
  const double margin_x = kGathered + beyond * (box.x_max - box.x_min);
  const double margin_y = kGathered + beyond * (box.y_max - box.y_min);
  box.x_min -= margin_x;
  box.x_max += margin_x;
  box.y_min -= margin_y;
  box.y_max += margin_y;
  box.heading_tolerance *= 1 + beyond;
  if (box.heading_tolerance > kAllHeadings) box.heading_tolerance = M_PI + 1e-6;
  return box;
}
}  // namespace

SignatureMonteCarlo2D::SignatureMonteCarlo2D(std::size_t particles, const TrackerOptions& tracking)
    : CMonteCarloLocalization2D(particles), particles_when_lost_(particles), tracking_(tracking)
{
  if (particles == 0) throw std::invalid_argument("SignatureMonteCarlo2D: no particles");
  checkOptions(tracking);
  modes_ = std::make_unique<ModeTracker>(tracking);
  forget();
}
SignatureMonteCarlo2D::~SignatureMonteCarlo2D() = default;

void SignatureMonteCarlo2D::useMatcher(std::shared_ptr<const SignatureMatcher> matcher)
{
  matcher_ = std::move(matcher);
  own_matcher_ = matcher_ == nullptr;
}

void SignatureMonteCarlo2D::useExtraction(const FeatureExtractorOptions& extraction)
{
  checkOptions(extraction);
  extraction_ = extraction;
}

void SignatureMonteCarlo2D::forget(const std::optional<PoseRegion>& region)
{
  believe(region, false);
}

/// Begins anew: with the particles as they are, where the pose is `known`, else lost.
void SignatureMonteCarlo2D::believe(const std::optional<PoseRegion>& region, bool known)
{
  lost_ = !known;
  region_ = known ? std::nullopt : region;
  modes_->forget(known);
  belief_ = {};
  rememberParticles();
}

void SignatureMonteCarlo2D::prediction_and_update_pfStandardProposal(
    const CActionCollection* action, const CSensoryFrame* observation,
    const FilterOptions& filtering)
{
  using Base = CMonteCarloLocalization2D;
  step(action, observation, filtering,
       [&](const FilterOptions& tempered)
       { Base::prediction_and_update_pfStandardProposal(action, observation, tempered); });
}

void SignatureMonteCarlo2D::prediction_and_update_pfAuxiliaryPFStandard(
    const CActionCollection* action, const CSensoryFrame* observation,
    const FilterOptions& filtering)
{
  using Base = CMonteCarloLocalization2D;
  step(action, observation, filtering,
       [&](const FilterOptions& tempered)
       { Base::prediction_and_update_pfAuxiliaryPFStandard(action, observation, tempered); });
}

void SignatureMonteCarlo2D::prediction_and_update_pfAuxiliaryPFOptimal(
    const CActionCollection* action, const CSensoryFrame* observation,
    const FilterOptions& filtering)
{
  using Base = CMonteCarloLocalization2D;
  step(action, observation, filtering,
       [&](const FilterOptions& tempered)
       { Base::prediction_and_update_pfAuxiliaryPFOptimal(action, observation, tempered); });
}

/// Runs MRPT's step while the robot is not lost. Then judges its result, and corrects it where a
/// relocation contradicts it. \cite algorithm section 9
void SignatureMonteCarlo2D::step(const CActionCollection* action, const CSensoryFrame* observation,
                                 FilterOptions filtering,
                                 const std::function<void(const FilterOptions&)>& update)
{
  const SignatureMatcher& signatures = matcher();
  noticeReset();
  const ObservedScene scene = sceneOf(observation, extraction_);
  const bool by_features = signatures.verifier() == nullptr && !scene.features.empty();
  const bool blind = !signatures.seesEnoughReturns(scene) && !by_features;
  const Travel travel = modes_->predict(motionIn(action));
  // Evidence counts by distance driven, because the errors of map and scan stay the same for a
  // while.
  filtering.powFactor *=
      std::min(1.0, travel.with_turns / tracking_.evidence_distance);  // eq. (9.1)
  relocated_ = false;
  if (!lost_)
  {
    update(filtering);
    modes_->gather(modesOf(*this, tracking_.max_hypotheses), signatures);
  }
  if (!blind) relocated_ = modes_->judge(scene, signatures, lost_ ? region_ : std::nullopt);
  if (relocated_) drawStarted();
  belief_ = modes_->publish(signatures, blind);
  rememberParticles();
}

/// The motion of an action; none where it is as uncertain as without odometry.
std::optional<MotionIncrement> SignatureMonteCarlo2D::motionIn(
    const CActionCollection* action) const
{
  if (action == nullptr) return std::nullopt;
  const auto known = detail::motionOf(*action).motion;
  if (!known) return std::nullopt;
  const bool guessed =
      std::sqrt(known->cov(0, 0) + known->cov(1, 1)) >= tracking_.free_motion_sigma;
  return guessed ? std::nullopt : std::optional(detail::toMotionIncrement(*known));
}

const SignatureMatcher& SignatureMonteCarlo2D::matcher()
{
  if (!own_matcher_) return *matcher_;
  const auto* map = findMap<SignatureMap>(options.metricMap.get());
  if (map == nullptr)
  {
    throw std::invalid_argument("SignatureMonteCarlo2D: no SignatureMap in options.metricMap");
  }
  return matcherOf(map->featureMap(), {}, matcher_);
}

void SignatureMonteCarlo2D::rememberParticles()
{
  known_x_.clear();
  for (const auto& particle : m_particles) known_x_.push_back(particle.d.x);
  std::sort(known_x_.begin(), known_x_.end());
}

/// Resampling only copies particles, so one at a new position was put there by the caller. MRPT's
/// functions that do so cannot be overridden.
void SignatureMonteCarlo2D::noticeReset()
{
  if (m_particles.empty()) return;
  const std::size_t stride = std::max<std::size_t>(1, m_particles.size() / kCompared);
  bool known = true;
  for (std::size_t i = 0; i < m_particles.size(); i += stride)
  {
    known = known && std::binary_search(known_x_.begin(), known_x_.end(), m_particles[i].d.x);
  }
  if (known) return;
  const auto [covariance, mean] = getCovarianceAndMean();
  const bool gathered = std::sqrt(covariance(0, 0) + covariance(1, 1)) < kGathered &&
                        std::sqrt(covariance(2, 2)) < kGatheredAngle;
  believe(boxAround(*this, mean.asTPose()), gathered);
}

/// Draws particles at the poses that a relocation has started, as many as their share of the
/// weight, and keeps the others. \cite algorithm section 9, "Drawing"
void SignatureMonteCarlo2D::drawStarted()
{
  Belief started;
  double share = 0;
  for (const ParticleMode& mode : modes_->started())
  {
    started.hypotheses.emplace_back();
    started.hypotheses.back().pose = mode.pose;
    started.hypotheses.back().weight = mode.weight;
    share += mode.weight;
  }
  const auto total = static_cast<double>(particles_when_lost_);
  const std::size_t fresh =
      lost_ ? particles_when_lost_ : static_cast<std::size_t>(std::lround(total * share));
  if (started.hypotheses.empty() || fresh == 0) return;
  CParticleList particles;
  const std::size_t kept = particles_when_lost_ - std::min(fresh, particles_when_lost_);
  if (kept > 0) particles = resampled(kept);
  const auto seeds =
      toParticles(started, fresh, mrpt::random::getRandomGenerator().drawUniform32bit());
  particles.insert(particles.end(), seeds.m_particles.begin(), seeds.m_particles.end());
  m_particles = std::move(particles);
  lost_ = false;
  region_.reset();
}

/// Returns `count` of the particles, drawn systematically by their weights.
SignatureMonteCarlo2D::CParticleList SignatureMonteCarlo2D::resampled(std::size_t count)
{
  normalizeWeights();
  double passed = std::exp(m_particles.front().log_w);
  double sum = 0;
  for (const auto& particle : m_particles) sum += std::exp(particle.log_w);
  const double offset = mrpt::random::getRandomGenerator().drawUniform(0.0, 1.0);
  CParticleList particles;
  std::size_t chosen = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    const double position = (static_cast<double>(i) + offset) / static_cast<double>(count) * sum;
    while (position > passed && chosen + 1 < m_particles.size())
    {
      passed += std::exp(m_particles[++chosen].log_w);
    }
    particles.push_back(m_particles[chosen]);
    particles.back().log_w = 0;
  }
  return particles;
}
}  // namespace sigloc

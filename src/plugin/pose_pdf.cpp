// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/plugin/pose_pdf.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <Eigen/Dense>
#include <random>
#include <stdexcept>
#include <vector>

#include "geometry/pose_fusion.h"

namespace sigloc
{

namespace
{
constexpr double kSmallestWeight = 1e-300;  // keeps the log-weight of a weightless mode finite
// A verdict of localized takes a probability of 0.99, so that 0.01 of doubt is the least without
// it.
constexpr double kLeastDoubt = 0.01;

/// The hypotheses' weights, scaled to sum to one; equal where they are all zero.
std::vector<double> normalizedWeights(const Belief& belief)
{
  std::vector<double> weights;
  double sum = 0;
  for (const auto& hypothesis : belief.hypotheses)
  {
    weights.push_back(std::max(0.0, hypothesis.weight));
    sum += weights.back();
  }
  const double equal = 1.0 / static_cast<double>(std::max<std::size_t>(1, weights.size()));
  for (double& weight : weights) weight = sum > 0 ? weight / sum : equal;
  return weights;
}

mrpt::poses::CPose2D toPose(const mrpt::math::TPose2D& pose)
{
  return {pose.x, pose.y, mrpt::math::wrapToPi(pose.phi)};
}

/// Returns A with A A' = covariance; works for singular covariances too.
Eigen::Matrix3d squareRoot(const mrpt::math::CMatrixDouble33& covariance)
{
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(
      Eigen::Matrix3d(covariance.asEigen()));
  const Eigen::Vector3d scales = solver.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  return solver.eigenvectors() * scales.asDiagonal();
}

const TrackedHypothesis& firstOf(const Belief& belief)
{
  if (belief.hypotheses.empty()) throw std::invalid_argument("the belief has no hypothesis");
  return belief.hypotheses.front();
}
}  // namespace

Belief toBelief(const RelocationResult& result)
{
  Belief belief;
  for (const Candidate& candidate : result.candidates)
  {
    TrackedHypothesis hypothesis;
    hypothesis.pose = candidate.pose;
    hypothesis.weight = candidate.probability;
    belief.hypotheses.push_back(hypothesis);
  }
  belief.elsewhere = result.elsewhere;
  belief.verdict = result.verdict;
  belief.probability = result.probability;
  return belief;
}

GaussianPose anywhereIn(const PlanarBox& box)
{
  const auto variance = [](double width) { return width * width / 12; };  // of a uniform density
  GaussianPose anywhere;
  anywhere.mean = {0.5 * (box.x_min + box.x_max), 0.5 * (box.y_min + box.y_max), 0};
  anywhere.covariance.setZero();
  anywhere.covariance(0, 0) = variance(box.x_max - box.x_min);
  anywhere.covariance(1, 1) = variance(box.y_max - box.y_min);
  anywhere.covariance(2, 2) = variance(2 * M_PI);
  return anywhere;
}

Belief withElsewhere(const Belief& belief, const GaussianPose& anywhere)
{
  if (belief.verdict == Verdict::localized) return belief;
  Belief whole = belief;
  TrackedHypothesis elsewhere;
  elsewhere.pose = anywhere;
  elsewhere.weight = belief.hypotheses.empty() ? 1 : std::max(belief.elsewhere, kLeastDoubt);
  const std::vector<double> shares = normalizedWeights(belief);
  for (std::size_t i = 0; i < shares.size(); ++i)
  {
    whole.hypotheses[i].weight = (1 - elsewhere.weight) * shares[i];
  }
  whole.hypotheses.push_back(elsewhere);
  whole.elsewhere = 0;
  return whole;
}

GaussianPose reportedPose(const Belief& belief, const GaussianPose& anywhere)
{
  GaussianPose reported = firstOf(belief).pose;
  if (belief.verdict == Verdict::localized) return reported;
  const GaussianPose whole = momentsOf(withElsewhere(belief, anywhere));
  const Eigen::Vector3d offset(whole.mean.x - reported.mean.x, whole.mean.y - reported.mean.y,
                               mrpt::math::wrapToPi(whole.mean.phi - reported.mean.phi));
  reported.covariance = whole.covariance.asEigen() + offset * offset.transpose();
  return reported;
}

mrpt::poses::CPosePDFSOG toSumOfGaussians(const Belief& belief)
{
  const std::vector<double> weights = normalizedWeights(belief);
  mrpt::poses::CPosePDFSOG sum(0);
  for (std::size_t i = 0; i < weights.size(); ++i)
  {
    const GaussianPose& pose = belief.hypotheses[i].pose;
    mrpt::poses::CPosePDFSOG::TGaussianMode mode;
    mode.mean = toPose(pose.mean);
    mode.cov = pose.covariance;
    mode.log_w = std::log(std::max(weights[i], kSmallestWeight));
    sum.push_back(mode);
  }
  return sum;
}

mrpt::poses::CPosePDFGaussian toGaussian(const Belief& belief)
{
  const GaussianPose& pose = firstOf(belief).pose;
  return mrpt::poses::CPosePDFGaussian(toPose(pose.mean), pose.covariance);
}

GaussianPose momentsOf(const Belief& belief)
{
  const std::vector<double> weights = normalizedWeights(belief);
  GaussianPose whole = firstOf(belief).pose;
  double gathered = std::max(weights.front(), kSmallestWeight);
  for (std::size_t i = 1; i < weights.size(); ++i)
  {
    whole = mergeByMoments(whole, gathered, belief.hypotheses[i].pose, weights[i]);
    gathered += weights[i];
  }
  return whole;
}

mrpt::poses::CPosePDFParticles toParticles(const Belief& belief, std::size_t count,
                                           std::uint64_t seed)
{
  firstOf(belief);
  const std::vector<double> weights = normalizedWeights(belief);
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  mrpt::poses::CPosePDFParticles particles(count);
  // Systematic sampling of the hypotheses: each gets its share of the samples to within one.
  const double offset = std::uniform_real_distribution<double>()(random);
  std::size_t chosen = 0;
  double passed = weights[0];
  Eigen::Matrix3d root = squareRoot(belief.hypotheses[0].pose.covariance);
  for (std::size_t i = 0; i < count; ++i)
  {
    const double position = (static_cast<double>(i) + offset) / static_cast<double>(count);
    while (position > passed && chosen + 1 < weights.size())
    {
      ++chosen;
      passed += weights[chosen];
      root = squareRoot(belief.hypotheses[chosen].pose.covariance);
    }
    const mrpt::math::TPose2D& mean = belief.hypotheses[chosen].pose.mean;
    Eigen::Vector3d unit;
    for (int k = 0; k < 3; ++k) unit[k] = normal(random);
    const Eigen::Vector3d shift = root * unit;
    auto& particle = particles.m_particles[i];
    particle.d = {mean.x + shift[0], mean.y + shift[1], mrpt::math::wrapToPi(mean.phi + shift[2])};
    particle.log_w = 0;
  }
  return particles;
}

mrpt::obs::CObservationRobotPose::Ptr toRobotPoseObservation(const Belief& belief,
                                                             const GaussianPose& anywhere,
                                                             double time)
{
  const GaussianPose pose = reportedPose(belief, anywhere);
  auto observation = mrpt::obs::CObservationRobotPose::Create();
  observation->pose = mrpt::poses::CPose3DPDFGaussian(
      mrpt::poses::CPosePDFGaussian(toPose(pose.mean), pose.covariance));
  observation->timestamp = mrpt::Clock::fromDouble(time);
  observation->sensorLabel =
      belief.verdict == Verdict::localized ? kSurePoseLabel : kUnsurePoseLabel;
  return observation;
}
}  // namespace sigloc

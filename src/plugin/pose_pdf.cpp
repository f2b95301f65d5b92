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

mrpt::obs::CObservationRobotPose::Ptr toRobotPoseObservation(const Belief& belief, double time)
{
  auto observation = mrpt::obs::CObservationRobotPose::Create();
  observation->pose = mrpt::poses::CPose3DPDFGaussian(toGaussian(belief));
  observation->timestamp = mrpt::Clock::fromDouble(time);
  observation->sensorLabel = "sigloc";
  return observation;
}
}  // namespace sigloc

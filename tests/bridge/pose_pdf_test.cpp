// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/plugin/pose_pdf.h"

#include <gtest/gtest.h>
#include <mrpt/math/wrap2pi.h>

#include <cmath>
#include <stdexcept>

using namespace sigloc;

namespace
{
TrackedHypothesis hypothesis(double x, double phi, double weight)
{
  TrackedHypothesis made;
  made.pose.mean = {x, -x, phi};
  made.pose.covariance(0, 0) = 0.04;
  made.pose.covariance(1, 1) = 0.09;
  made.pose.covariance(0, 1) = made.pose.covariance(1, 0) = 0.03;
  made.pose.covariance(2, 2) = 0.01;
  made.weight = weight;
  return made;
}

Belief twoPlaces()
{
  Belief belief;
  belief.hypotheses = {hypothesis(1, M_PI - 0.01, 0.6), hypothesis(20, 0.5, 0.2)};
  belief.elsewhere = 0.2;
  return belief;
}
}  // namespace

TEST(PosePdf, SumOfGaussiansHasNormalizedWeights)
{
  const auto sum = toSumOfGaussians(twoPlaces());
  ASSERT_EQ(sum.size(), 2U);
  EXPECT_NEAR(std::exp(sum[0].log_w), 0.75, 1e-9);
  EXPECT_NEAR(std::exp(sum[1].log_w), 0.25, 1e-9);
  EXPECT_NEAR(sum[1].mean.x(), 20.0, 1e-12);
  EXPECT_NEAR(sum[0].cov(0, 1), 0.03, 1e-12);
  EXPECT_EQ(toSumOfGaussians(Belief{}).size(), 0U);
}

TEST(PosePdf, GaussianIsTheFirstHypothesis)
{
  const auto gaussian = toGaussian(twoPlaces());
  EXPECT_NEAR(gaussian.mean.phi(), M_PI - 0.01, 1e-9);
  EXPECT_NEAR(gaussian.cov(1, 1), 0.09, 1e-12);
  EXPECT_THROW(toGaussian(Belief{}), std::invalid_argument);
  EXPECT_THROW(toParticles(Belief{}, 10, 1), std::invalid_argument);
  EXPECT_THROW(toRobotPoseObservation(Belief{}, GaussianPose{}, 0), std::invalid_argument);
}

TEST(PosePdf, MomentsAreThoseOfAllHypotheses)
{
  const GaussianPose whole = momentsOf(twoPlaces());  // 0.75 at x = 1, 0.25 at x = 20
  EXPECT_NEAR(whole.mean.x, 5.75, 1e-9);
  EXPECT_NEAR(whole.covariance(0, 0), 0.04 + 0.75 * 0.25 * 19 * 19, 1e-9);
  EXPECT_THROW(momentsOf(Belief{}), std::invalid_argument);
}

TEST(PosePdf, ParticlesHaveTheMomentsOfTheirHypotheses)
{
  constexpr std::size_t kCount = 20000;
  const auto particles = toParticles(twoPlaces(), kCount, 42);
  ASSERT_EQ(particles.m_particles.size(), kCount);
  double near_first = 0;
  double variance_x = 0;
  double covariance_xy = 0;
  double variance_phi = 0;
  for (const auto& particle : particles.m_particles)
  {
    EXPECT_LE(std::abs(particle.d.phi), M_PI);
    EXPECT_EQ(particle.log_w, 0.0);
    if (particle.d.x > 10) continue;
    near_first += 1;
    variance_x += std::pow(particle.d.x - 1, 2);
    covariance_xy += (particle.d.x - 1) * (particle.d.y + 1);
    variance_phi += std::pow(mrpt::math::wrapToPi(particle.d.phi - (M_PI - 0.01)), 2);
  }
  EXPECT_NEAR(near_first / kCount, 0.75, 1.0 / kCount);
  EXPECT_NEAR(variance_x / near_first, 0.04, 0.002);
  EXPECT_NEAR(covariance_xy / near_first, 0.03, 0.002);
  EXPECT_NEAR(variance_phi / near_first, 0.01, 0.0006);
}

TEST(PosePdf, SameSeedSameParticles)
{
  const auto a = toParticles(twoPlaces(), 50, 7);
  const auto b = toParticles(twoPlaces(), 50, 7);
  const auto c = toParticles(twoPlaces(), 50, 8);
  EXPECT_EQ(a.m_particles[17].d, b.m_particles[17].d);
  EXPECT_NE(a.m_particles[17].d, c.m_particles[17].d);
}

TEST(PosePdf, SamplesASingularCovariance)
{
  Belief belief;
  belief.hypotheses = {hypothesis(1, 0, 1)};
  belief.hypotheses[0].pose.covariance = mrpt::math::CMatrixDouble33();
  belief.hypotheses[0].pose.covariance(0, 0) = 1;
  for (const auto& particle : toParticles(belief, 100, 1).m_particles)
  {
    EXPECT_EQ(particle.d.y, -1.0);
    EXPECT_EQ(particle.d.phi, 0.0);
  }
}

TEST(PosePdf, AnywhereIsUniformInTheBox)
{
  const GaussianPose anywhere = anywhereIn({-10, 20, 0, 12});
  EXPECT_EQ(anywhere.mean.x, 5.0);
  EXPECT_EQ(anywhere.mean.y, 6.0);
  EXPECT_NEAR(anywhere.covariance(0, 0), 75, 1e-9);
  EXPECT_NEAR(anywhere.covariance(1, 1), 12, 1e-9);
  EXPECT_NEAR(anywhere.covariance(2, 2), M_PI * M_PI / 3, 1e-9);
}

TEST(PosePdf, SomewhereElseIsTheLastHypothesisOfAnUnsureBelief)
{
  const GaussianPose anywhere = anywhereIn({-10, 20, 0, 12});
  Belief belief = twoPlaces();
  for (const Verdict verdict : {Verdict::ambiguous, Verdict::not_here, Verdict::too_little_seen})
  {
    belief.verdict = verdict;
    const Belief whole = withElsewhere(belief, anywhere);
    ASSERT_EQ(whole.hypotheses.size(), 3U);
    EXPECT_NEAR(whole.hypotheses[0].weight, 0.6, 1e-12);
    EXPECT_NEAR(whole.hypotheses[1].weight, 0.2, 1e-12);
    EXPECT_NEAR(whole.hypotheses[2].weight, 0.2, 1e-12);
    EXPECT_EQ(whole.hypotheses[2].pose.mean.x, 5.0);
  }
  belief.verdict = Verdict::localized;
  EXPECT_EQ(withElsewhere(belief, anywhere).hypotheses.size(), 2U);
  EXPECT_EQ(withElsewhere(Belief{}, anywhere).hypotheses.size(), 1U);
  EXPECT_EQ(withElsewhere(Belief{}, anywhere).hypotheses[0].weight, 1.0);
}

// The weights may call a pose certain that the verdict does not vouch for.
TEST(PosePdf, AnUnsurePoseIsNeverNarrow)
{
  const GaussianPose anywhere = anywhereIn({-10, 20, 0, 12});
  Belief belief;
  belief.hypotheses = {hypothesis(1, 0.3, 1)};
  belief.elsewhere = 0;
  belief.verdict = Verdict::localized;
  EXPECT_NEAR(reportedPose(belief, anywhere).covariance(0, 0), 0.04, 1e-12);
  belief.verdict = Verdict::ambiguous;
  const GaussianPose unsure = reportedPose(belief, anywhere);
  EXPECT_EQ(unsure.mean.x, 1.0);
  // 99 % at the pose, 1 % anywhere: the mean squared deviation from the pose.
  EXPECT_NEAR(unsure.covariance(0, 0), 0.99 * 0.04 + 0.01 * (75 + 4 * 4), 1e-9);
  EXPECT_NEAR(unsure.covariance(1, 1), 0.99 * 0.09 + 0.01 * (12 + 7 * 7), 1e-9);
}

TEST(PosePdf, RobotPoseObservationCarriesPoseTimeAndLabel)
{
  const GaussianPose anywhere = anywhereIn({-10, 20, 0, 12});
  Belief belief = twoPlaces();
  belief.verdict = Verdict::not_here;
  const auto unsure = toRobotPoseObservation(belief, anywhere, 1234.5);
  EXPECT_EQ(unsure->sensorLabel, "sigloc_unsure");
  EXPECT_GT(unsure->pose.cov(0, 0), 50.0);
  belief.verdict = Verdict::localized;
  const auto observation = toRobotPoseObservation(belief, anywhere, 1234.5);
  EXPECT_EQ(observation->sensorLabel, "sigloc");
  EXPECT_NEAR(mrpt::Clock::toDouble(observation->timestamp), 1234.5, 1e-6);
  EXPECT_NEAR(observation->pose.mean.yaw(), M_PI - 0.01, 1e-9);
  EXPECT_NEAR(observation->pose.cov(3, 3), 0.01, 1e-12);
}

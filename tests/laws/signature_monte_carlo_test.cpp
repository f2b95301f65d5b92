// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/slam/SignatureMonteCarlo2D.h"

#include <gtest/gtest.h>
#include <mrpt/maps/CMultiMetricMap.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/random/RandomGenerators.h>

#include <cmath>

#include "io/GroundTruth.h"
#include "sigloc/io/map_files.h"
#include "slam/particle_modes.h"
#include "slam/ParticleTracker.h"

namespace sigloc
{
namespace
{
using mrpt::bayes::CParticleFilter;
using mrpt::math::TPose2D;

const std::filesystem::path kSource = SIGLOC_SOURCE_DIR;
constexpr std::size_t kParticles = 300;
constexpr std::uint32_t kFilterSeed = 11;

/// The simulated office, its drive with truth, and MRPT's executor.
struct Office
{
  Office()
  {
    map =
        std::make_shared<SignatureMap>(buildMapFromFile(kSource / "maps/office.simplemap", {}, {}));
    RawlogReader log(kSource / "rawlogs/office.rawlog");
    while (auto step = log.next()) steps.push_back(std::move(*step));
    mrpt::random::getRandomGenerator() = mrpt::random::CRandomGenerator(kFilterSeed);
  }

  TPose2D truthAt(std::size_t step) const { return truth.at(step, steps[step].time).value(); }

  void advance(SignatureMonteCarlo2D& filter, std::size_t step, bool moved = true)
  {
    mrpt::obs::CActionRobotMovement2D movement;
    const TPose2D increment = moved && steps[step].motion ? steps[step].motion->mean : TPose2D();
    movement.computeFromOdometry(mrpt::poses::CPose2D(increment), {});
    mrpt::obs::CActionCollection actions;
    actions.insert(movement);
    executor.executeOn(filter, &actions, steps[step].frame.get());
  }

  std::shared_ptr<SignatureMap> map;
  std::vector<RawlogStep> steps;
  GroundTruth truth = GroundTruth::read(kSource / "rawlogs/office-truth.txt");
  CParticleFilter executor;
};

double distanceOf(const Belief& belief, const TPose2D& truth)
{
  if (belief.hypotheses.empty()) return 1e9;
  const TPose2D& pose = belief.hypotheses.front().pose.mean;
  return std::hypot(pose.x - truth.x, pose.y - truth.y);
}

TEST(SignatureMonteCarlo, FindsTheRobotWithEveryAlgorithmOfMrpt)
{
  Office office;
  for (const auto algorithm :
       {CParticleFilter::pfStandardProposal, CParticleFilter::pfAuxiliaryPFStandard,
        CParticleFilter::pfAuxiliaryPFOptimal})
  {
    SignatureMonteCarlo2D filter(kParticles);
    const auto several = mrpt::maps::CMultiMetricMap::Create();
    several->maps.push_back(office.map);
    filter.options.metricMap = several;
    office.executor.m_options.PF_algorithm = algorithm;
    office.executor.m_options.pfAuxFilterOptimal_MaximumSearchSamples = 5;
    for (std::size_t i = 0; i < 40; ++i) office.advance(filter, i);
    EXPECT_LT(distanceOf(filter.belief(), office.truthAt(39)), 0.5) << algorithm;
    EXPECT_EQ(filter.belief().verdict, Verdict::localized) << filter.belief().reason;
    EXPECT_EQ(filter.size(), kParticles);
  }
}

TEST(SignatureMonteCarlo, FollowsMrptsAdaptiveSampleSize)
{
  Office office;
  SignatureMonteCarlo2D filter(kParticles);
  filter.options.metricMap = office.map;
  filter.options.KLD_params.KLD_binSize_XY = 0.4;
  filter.options.KLD_params.KLD_binSize_PHI = 0.4;
  filter.options.KLD_params.KLD_epsilon = 0.05;
  filter.options.KLD_params.KLD_minSampleSize = 50;
  filter.options.KLD_params.KLD_maxSampleSize = kParticles;
  office.executor.m_options.adaptiveSampleSize = true;
  for (std::size_t i = 0; i < 40; ++i) office.advance(filter, i);
  EXPECT_LT(distanceOf(filter.belief(), office.truthAt(39)), 0.5);
  EXPECT_LT(filter.size(), kParticles);
}

TEST(SignatureMonteCarlo, IsSetByTheCallersOwnParticles)
{
  Office office;
  SignatureMonteCarlo2D filter(kParticles);
  filter.options.metricMap = office.map;
  const TPose2D start = office.truthAt(0);
  filter.resetDeterministic(start, kParticles);
  office.advance(filter, 0, false);
  EXPECT_FALSE(filter.relocated()) << "gathered particles are believed";
  EXPECT_LT(distanceOf(filter.belief(), start), 0.1);

  filter.resetUniform(start.x - 8, start.x + 8, start.y - 8, start.y + 8, -M_PI, M_PI, 1000);
  office.advance(filter, 0, false);
  EXPECT_TRUE(filter.relocated()) << "spread particles mean lost";
  EXPECT_LT(distanceOf(filter.belief(), start), 0.3);
  EXPECT_EQ(filter.size(), kParticles);

  filter.resetUniform(start.x + 3, start.x + 8, start.y - 8, start.y + 8, -M_PI, M_PI, 1000);
  office.advance(filter, 0, false);
  EXPECT_TRUE(filter.relocated());
  EXPECT_NE(filter.belief().verdict, Verdict::localized) << "the box excludes the truth";
  for (const TrackedHypothesis& hypothesis : filter.belief().hypotheses)
  {
    EXPECT_GT(hypothesis.pose.mean.x, start.x + 1.5);
  }
}

TEST(SignatureMonteCarlo, SaysNotHereOnlyOfAMapThatWasSearched)
{
  Office office;
  SignatureMonteCarlo2D filter(kParticles);
  filter.options.metricMap = office.map;
  TPose2D wrong = office.truthAt(0);
  wrong.x += 3;
  filter.resetDeterministic(wrong, kParticles);
  office.advance(filter, 0, false);
  ASSERT_FALSE(filter.relocated());
  EXPECT_EQ(filter.belief().verdict, Verdict::ambiguous) << filter.belief().reason;
}

TEST(SignatureMonteCarlo, RecoversFromKidnapping)
{
  Office office;
  SignatureMonteCarlo2D filter(kParticles);
  filter.options.metricMap = office.map;
  for (std::size_t i = 0; i < 20; ++i) office.advance(filter, i);
  const std::size_t elsewhere = office.steps.size() / 2;
  const TPose2D from = office.truthAt(19);
  const TPose2D to = office.truthAt(elsewhere);
  ASSERT_GT(std::hypot(to.x - from.x, to.y - from.y), 2.0);
  office.advance(filter, elsewhere, false);
  for (std::size_t i = elsewhere + 1; i < elsewhere + 40; ++i)
  {
    office.advance(filter, i);
    if (filter.belief().verdict == Verdict::localized && i > elsewhere + 10)
    {
      EXPECT_LT(distanceOf(filter.belief(), office.truthAt(i)), 1.0) << "step " << i;
    }
  }
  EXPECT_LT(distanceOf(filter.belief(), office.truthAt(elsewhere + 39)), 0.5);
}

TEST(SignatureMonteCarlo, NeedsASignatureMap)
{
  Office office;
  SignatureMonteCarlo2D filter(kParticles);
  EXPECT_THROW(
      filter.prediction_and_update_pfStandardProposal(nullptr, office.steps[0].frame.get(), {}),
      std::invalid_argument);
  EXPECT_THROW(SignatureMonteCarlo2D(0), std::invalid_argument);
}

TEST(ParticleTracker, IsAFunctionOfItsSeed)
{
  const Office office;
  const auto matcher = std::make_shared<const SignatureMatcher>(office.map->featureMap());
  const auto endOf = [&](std::uint32_t seed)
  {
    ParticleTracker tracker({office.map, matcher, {}, {}, seed, {}});
    for (std::size_t i = 0; i < 15; ++i) tracker.step(office.steps[i]);
    return tracker.filter().belief().hypotheses.front().pose.mean;
  };
  const TPose2D first = endOf(kFilterSeed);
  EXPECT_EQ(first, endOf(kFilterSeed));
  EXPECT_NE(first, endOf(kFilterSeed + 1));
}

TEST(ParticleTracker, FollowsWithoutOdometry)
{
  const Office office;
  const auto matcher = std::make_shared<const SignatureMatcher>(office.map->featureMap());
  ParticleTracker tracker({office.map, matcher, {}, {}, kFilterSeed, {}});
  constexpr std::size_t kEnd = 30;
  for (std::size_t i = 0; i <= kEnd; ++i)
  {
    RawlogStep step = office.steps[i];
    step.motion.reset();
    tracker.step(step);
  }
  const Belief& belief = tracker.filter().belief();
  ASSERT_FALSE(belief.hypotheses.empty());
  EXPECT_LT(distanceOf(belief, office.truthAt(kEnd)), 0.5);
}

TEST(ParticleTracker, RefusesTooManyParticlesBeforeItMakesThem)
{
  const Office office;
  const auto matcher = std::make_shared<const SignatureMatcher>(office.map->featureMap());
  ParticleOptions options;
  options.particles = 4000000000U;
  EXPECT_THROW(ParticleTracker({office.map, matcher, {}, options, 1, {}}), std::invalid_argument);
}

TEST(ParticleTracker, SeesFeaturesAsItIsTold)
{
  const Office office;
  const auto matcher = std::make_shared<const SignatureMatcher>(office.map->featureMap());
  const auto endOf = [&](double min_segment_length)
  {
    FeatureExtractorOptions extraction;
    extraction.min_segment_length = min_segment_length;
    ParticleTracker tracker({office.map, matcher, {}, {}, kFilterSeed, extraction});
    tracker.step(office.steps[0]);
    const Belief& belief = tracker.filter().belief();
    return belief.hypotheses.empty() ? TPose2D() : belief.hypotheses.front().pose.mean;
  };
  EXPECT_EQ(endOf(0.25), endOf(0.25));
  EXPECT_NE(endOf(0.25), endOf(6));
}

TEST(ParticleModes, AreTheirParticlesMoments)
{
  mrpt::poses::CPosePDFParticles particles(4);
  const double weights[] = {0.2, 0.2, 0.3, 0.3};
  const TPose2D poses[] = {{1, 0, 3.1}, {1.2, 0, -3.1}, {9, 9, 0}, {9, 9.4, 0}};
  for (int i = 0; i < 4; ++i)
  {
    particles.m_particles[static_cast<std::size_t>(i)].d = poses[i];
    particles.m_particles[static_cast<std::size_t>(i)].log_w = std::log(weights[i]) - 50;
  }
  const auto modes = modesOf(particles, 10);
  ASSERT_EQ(modes.size(), 2U);
  EXPECT_NEAR(modes[0].weight, 0.6, 1e-9);
  EXPECT_NEAR(modes[0].pose.mean.y, 9.2, 1e-9);
  EXPECT_NEAR(modes[0].pose.covariance(1, 1), 0.04, 1e-9);
  EXPECT_NEAR(modes[1].pose.mean.x, 1.1, 1e-9);
  EXPECT_NEAR(std::abs(modes[1].pose.mean.phi), M_PI, 1e-9) << "headings wrap";
  EXPECT_EQ(modesOf(particles, 1).size(), 1U);
}
}  // namespace
}  // namespace sigloc

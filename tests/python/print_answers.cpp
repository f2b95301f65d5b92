// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Prints every bit of what C++ answers to a log, for answers_test.py to compare with. A step has
// two lines: what the scan alone tells, and what the tracker knows.
//
//     print_answers MAP RAWLOG
#include <cstdio>
#include <exception>
#include <memory>

#include "sigloc/sigloc.h"

namespace
{
using namespace sigloc;

void printPose(const GaussianPose& pose, double probability)
{
  std::printf(" %a %a %a %a", probability, pose.mean.x, pose.mean.y, pose.mean.phi);
  for (int r = 0; r < 3; ++r)
  {
    for (int c = 0; c < 3; ++c) std::printf(" %a", pose.covariance(r, c));
  }
}

void print(const RelocationResult& result)
{
  std::printf("%s: %a %a", toString(result.verdict), result.probability, result.elsewhere);
  for (const Candidate& candidate : result.candidates)
  {
    printPose(candidate.pose, candidate.probability);
  }
  std::printf("\n");
}

void print(const Belief& belief)
{
  std::printf("%s: %a %a", toString(belief.verdict), belief.probability, belief.elsewhere);
  for (const TrackedHypothesis& tracked : belief.hypotheses)
    printPose(tracked.pose, tracked.weight);
  std::printf(" %s\n", belief.reason.c_str());
}

void printAnswers(const char* map_file, const char* rawlog_file)
{
  const auto map = std::make_shared<const FeatureMap>(buildMapFromFile(map_file, {}, {}));
  const auto matcher = std::make_shared<const SignatureMatcher>(map);
  HypothesisTracker tracker(matcher);
  RawlogReader log(rawlog_file);
  while (const auto step = log.next())
  {
    const ObservedScene scene = observe(*step);
    print(matcher->localize(scene));
    print(tracker.step(step->motion, scene));
  }
}
}  // namespace

int main(int argc, char** argv)
{
  if (argc != 3) return 2;
  try
  {
    printAnswers(argv[1], argv[2]);
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}

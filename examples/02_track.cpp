// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Follows every pose that is possible until one is left, along a whole log.
//
//     02_track [MAP] [RAWLOG]
#include <mrpt/core/bits_math.h>

#include <cstddef>
#include <cstdio>
#include <exception>
#include <memory>

#include "sigloc/features/observe_scans.h"
#include "sigloc/io/map_files.h"
#include "sigloc/io/RawlogReader.h"
#include "sigloc/matching/SignatureMatcher.h"
#include "sigloc/tracking/HypothesisTracker.h"

namespace
{
void show(std::size_t step, const sigloc::Belief& belief)
{
  std::printf("step %3zu: %s (%s), %zu hypotheses", step, sigloc::toString(belief.verdict),
              sigloc::probabilityText(belief.probability).c_str(), belief.hypotheses.size());
  if (!belief.hypotheses.empty())
  {
    const mrpt::math::TPose2D& pose = belief.hypotheses.front().pose.mean;
    std::printf(", best at (%.2f m, %.2f m, %.1f deg)", pose.x, pose.y, mrpt::RAD2DEG(pose.phi));
  }
  std::printf(": %s\n", belief.reason.c_str());
}

void follow(const char* map_file, const char* rawlog_file)
{
  const auto map =
      std::make_shared<const sigloc::FeatureMap>(sigloc::buildMapFromFile(map_file, {}, {}));
  sigloc::HypothesisTracker tracker(std::make_shared<const sigloc::SignatureMatcher>(map));

  // Each step: how the robot moved since the last one, if that is known, and what it sees now.
  sigloc::RawlogReader log(rawlog_file);
  std::size_t count = 0;
  while (const auto step = log.next())
  {
    tracker.step(step->motion, sigloc::observe(*step));
    if (count++ % 20 == 0) show(count, tracker.belief());
  }
  show(count, tracker.belief());
}
}  // namespace

int main(int argc, char** argv)
{
  try
  {
    follow(argc > 1 ? argv[1] : "maps/office.simplemap",
           argc > 2 ? argv[2] : "rawlogs/office.rawlog");
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}

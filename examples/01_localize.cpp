// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Where is the robot? One scan, one map, no idea of the pose.
//
//     01_localize [MAP] [RAWLOG]
#include <mrpt/core/bits_math.h>

#include <cstdio>
#include <exception>
#include <memory>

#include "sigloc/features/observe_scans.h"
#include "sigloc/io/map_files.h"
#include "sigloc/io/RawlogReader.h"
#include "sigloc/matching/SignatureMatcher.h"

namespace
{
void localizeFirstScan(const char* map_file, const char* rawlog_file)
{
  // The map may be any file that `sigloc-map build` takes, a prepared .sigmap included. Building
  // the matcher builds its indices: do it once.
  const auto map =
      std::make_shared<const sigloc::FeatureMap>(sigloc::buildMapFromFile(map_file, {}, {}));
  const sigloc::SignatureMatcher matcher(map);

  // A scan of any laser; `sigloc::toLaserScan` turns an MRPT observation into one.
  sigloc::RawlogReader log(rawlog_file);
  const auto step = log.next();
  if (!step) return;
  const sigloc::RelocationResult result = matcher.localize(sigloc::observe(*step));

  std::printf("%s (%s), elsewhere %.3f\n", sigloc::toString(result.verdict),
              sigloc::probabilityText(result.probability).c_str(), result.elsewhere);
  for (const sigloc::Candidate& candidate : result.candidates)
  {
    const mrpt::math::TPose2D& pose = candidate.pose.mean;
    std::printf("%6.3f: x %.2f m, y %.2f m, heading %.1f deg\n", candidate.probability, pose.x,
                pose.y, mrpt::RAD2DEG(pose.phi));
  }
}
}  // namespace

int main(int argc, char** argv)
{
  try
  {
    localizeFirstScan(argc > 1 ? argv[1] : "maps/office.simplemap",
                      argc > 2 ? argv[2] : "rawlogs/office.rawlog");
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}

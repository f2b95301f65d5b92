// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The place of MRPT's ICP taken by signatures: the same call, without a guess.
//
//     03_align [MAP] [RAWLOG]
#include <mrpt/core/bits_math.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/poses/CPosePDFGaussian.h>
#include <mrpt/poses/CPosePDFSOG.h>
#include <mrpt/slam/CICP.h>

#include <cstdio>
#include <exception>

#include "sigloc/io/map_files.h"
#include "sigloc/io/RawlogReader.h"
#include "sigloc/plugin/SignatureMap.h"
#include "sigloc/slam/SignatureAligner.h"

namespace
{
void showAlignment(const char* name, mrpt::slam::CMetricMapsAlignmentAlgorithm& algorithm,
                   const mrpt::maps::CMetricMap& map, const mrpt::maps::CMetricMap& local_view)
{
  const auto pdf = algorithm.AlignPDF(&map, &local_view, mrpt::poses::CPosePDFGaussian());
  mrpt::poses::CPose2D pose(pdf->getMeanVal());
  // Signatures tell of every pose that is possible, the heaviest first.
  const auto sum = std::dynamic_pointer_cast<mrpt::poses::CPosePDFSOG>(pdf);
  if (sum && !sum->empty()) pose = sum->begin()->mean;
  std::printf("%-10s x %.2f m, y %.2f m, heading %.1f deg (%zu poses)\n", name, pose.x(), pose.y(),
              mrpt::RAD2DEG(pose.phi()), sum ? sum->size() : 1);
}

void alignFirstScan(const char* map_file, const char* rawlog_file)
{
  const sigloc::SignatureMap map(sigloc::buildMapFromFile(map_file, {}, {}));
  sigloc::RawlogReader log(rawlog_file);
  const auto step = log.next();
  if (!step) return;
  mrpt::maps::CSimplePointsMap local_view;
  for (const auto& observation : *step->frame) local_view.insertObservation(*observation);

  mrpt::slam::CICP icp;
  sigloc::SignatureAligner signatures;
  showAlignment("ICP", icp, map, local_view);
  showAlignment("signatures", signatures, map, local_view);
}
}  // namespace

int main(int argc, char** argv)
{
  try
  {
    alignFirstScan(argc > 1 ? argv[1] : "maps/office.simplemap",
                   argc > 2 ? argv[2] : "rawlogs/office.rawlog");
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}

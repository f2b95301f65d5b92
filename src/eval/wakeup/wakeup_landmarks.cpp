// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <limits>
#include <stdexcept>

#include "eval/data/landmark_data.h"
#include "eval/wakeup/wakeup_drive.h"

namespace sigloc::detail
{
LoggedDrive readLandmarkDrive(const std::string& dataset, const std::filesystem::path& folder)
{
  const bool dlr = dataset == "dlr";
  if (!dlr && dataset != "victoria-park")
  {
    throw std::invalid_argument("unknown data set '" + dataset + "': dlr or victoria-park");
  }
  const LandmarkData data = dlr ? readDlr(folder) : readVictoriaPark(folder);
  // The DLR map is of the first half of the path: robots wake up in the second.
  const std::size_t first = dlr ? data.steps.size() / 2 : 0;
  LoggedDrive log;
  log.files = data.files;
  log.map.features = std::make_shared<const FeatureMap>(dlr ? mapFromSteps(data, first) : data.map,
                                                        std::nullopt, data.map_error);
  for (std::size_t k = 0; k < first; ++k) log.map.mapped_poses.push_back(data.steps[k].truth);
  for (std::size_t k = first; k < data.steps.size(); ++k)
  {
    const LandmarkStep& seen = data.steps[k];
    WakeupDriveStep step;
    step.step.time = std::numeric_limits<double>::quiet_NaN();  // these logs have no times
    step.step.motion = seen.motion;
    step.step.landmarks = seen.observed;
    if (seen.truth_sure) step.truth = seen.truth;
    step.mapped = isMapped(seen.truth, log.map.mapped_poses);
    step.may_start = step.mapped && seen.truth_sure;
    step.travelled =
        log.drive.steps.empty()
            ? 0
            : log.drive.steps.back().travelled + std::hypot(seen.motion.mean.x, seen.motion.mean.y);
    log.drive.steps.push_back(std::move(step));
  }
  return log;
}
}  // namespace sigloc::detail

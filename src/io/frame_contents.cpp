// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/frame_contents.h"

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationBearingRange.h>

#include <algorithm>

#include "io/archive/UnreadObservation.h"
#include "io/solid/sensor_mount.h"
#include "io/solid/SolidView.h"

namespace sigloc::detail
{
bool isRange(const mrpt::obs::CObservation& observation)
{
  return dynamic_cast<const mrpt::obs::CObservation2DRangeScan*>(&observation) != nullptr ||
         dynamic_cast<const mrpt::obs::CObservationBearingRange*>(&observation) != nullptr;
}

std::size_t countRanges(const mrpt::obs::CSensoryFrame& frame)
{
  return static_cast<std::size_t>(std::count_if(frame.begin(), frame.end(),
                                                [](const mrpt::obs::CObservation::Ptr& observation)
                                                { return isRange(*observation); }));
}

std::size_t countUsableLandmarkScans(const mrpt::obs::CSensoryFrame& frame)
{
  return static_cast<std::size_t>(std::count_if(
      frame.begin(), frame.end(),
      [](const mrpt::obs::CObservation::Ptr& observation)
      {
        const auto* const seen =
            dynamic_cast<const mrpt::obs::CObservationBearingRange*>(observation.get());
        return seen != nullptr && isSensorMount(seen->sensorLocationOnRobot);
      }));
}

std::size_t countSolids(const mrpt::obs::CSensoryFrame& frame)
{
  return static_cast<std::size_t>(std::count_if(
      frame.begin(), frame.end(),
      [](const mrpt::obs::CObservation::Ptr& observation)
      {
        const auto* const unread = dynamic_cast<const UnreadObservation*>(observation.get());
        return unread != nullptr && isSolid(*unread);
      }));
}
}  // namespace sigloc::detail

// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPose2D.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "eval/wakeup/wakeup.h"
#include "sigloc/io/RawlogReader.h"

namespace sigloc::detail
{
/// A step of a drive with its truth.
struct WakeupDriveStep
{
  RawlogStep step;
  std::optional<mrpt::math::TPose2D> truth;
  double travelled = 0;  ///< [m] since the drive began, along the truth
  bool may_start = false;
  bool mapped = true;  ///< see WakeupStep
};

struct WakeupDrive
{
  std::vector<WakeupDriveStep> steps;
  bool foreign = false;  ///< the drive is in another building than the map: every claim is wrong
  bool complete = true;  ///< false when the log was truncated
};

/// A log to wake up in, and the map.
struct LoggedDrive
{
  EvaluationMap map;
  WakeupDrive drive;
  std::vector<std::filesystem::path> files;
};

/// Reads a landmark log, "dlr" or "victoria-park", from its folder. For "dlr" the map is made from
/// the first half of the path, and the drive is the second half. Throws std::invalid_argument for
/// another name and std::runtime_error ("path: reason").
LoggedDrive readLandmarkDrive(const std::string& dataset, const std::filesystem::path& folder);

/// Reads the map and the drive that the options name. Throws std::runtime_error ("path: reason").
LoggedDrive readLoggedDrive(const WakeupOptions& options);

/// Steps [first, last) of a drive.
struct WakeupLeg
{
  const WakeupDrive* drive = nullptr;
  std::size_t first = 0;
  std::size_t last = 0;
};

/// True where the map's scans were taken within 1 m; always for a map without poses.
bool isMapped(const mrpt::math::TPose2D& truth,
              const std::vector<mrpt::math::TPose2D>& mapped_poses);

/// Clears `mapped` of the steps without truth where the ones with truth before or after them are
/// off the mapped area.
void markStepsWithoutTruth(std::vector<WakeupDriveStep>& steps);

/// Runs a method, lost at first, over one leg after another, carried from the end of each to the
/// start of the next, and judges every step.
Wakeup runLegs(const TrackingMethodFactory& factory, const std::vector<WakeupLeg>& legs,
               std::uint32_t seed, const AccuracyGates& gates);

/// Returns the step of a failed run to draw: the first wrong claim, else the step that the run was
/// judged by. `legs` are those of the run.
FailedQuery failureOf(const Wakeup& run, const std::vector<WakeupLeg>& legs,
                      const std::string& method, std::shared_ptr<const FeatureMap> map);
}  // namespace sigloc::detail

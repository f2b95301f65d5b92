// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sigloc/config/option_fields.h"
#include "sigloc/features/Feature.h"
#include "sigloc/features/LaserScan.h"
#include "sigloc/features/observe_scans.h"
#include "sigloc/geometry/GaussianPose.h"

namespace sigloc
{
/// What files do not tell by themselves, of logs and of maps. Section [sigloc.reading]; units,
/// ranges and meanings are in `visitFields`.
struct ReadingOptions
{
  double image_resolution = 0;
  double min_height = 0.2;
  double max_height = 1.5;

  template <class V>
  static void visitFields(V&& visit)
  {
    using O = ReadingOptions;
    constexpr double kHighest = 100;
    visit(
        OptionField{"image_resolution", &O::image_resolution, 0.0, 1.0,
                    "[m] a pixel of a map that is an image alone; 0: not told, such are refused"});
    visit(
        OptionField{"min_height", &O::min_height, -kHighest, kHighest,
                    "[m] above the robot's base, or the map's origin, from which 3D points count"});
    visit(OptionField{"max_height", &O::max_height, -kHighest, kHighest,
                      "[m] up to which 3D points count as walls"});
  }
};

/// One step of a log: the robot's motion since the step before, and its observations then.
struct RawlogStep
{
  double time = 0;  ///< [s] since the epoch of the log's clock
  std::optional<MotionIncrement> motion;  ///< none when the log has no odometry, or a broken one
  std::vector<LaserScan> scans;
  std::vector<Feature> landmarks;  ///< from CObservationBearingRange, without identities
  std::size_t entry = 0;  ///< index of the log's object that completed the step, from 0
  mrpt::obs::CSensoryFrame::Ptr frame;  ///< the original observations, for exporters
  /// The log's own motion, for MRPT's filter. Null unless exactly one action collection led to this
  /// step.
  mrpt::obs::CActionCollection::Ptr actions;
};

/// Returns all that the robot observed in a step, laser returns and landmarks, in the robot frame:
/// the input of SignatureMatcher and HypothesisTracker. The same errors as observeScene().
ObservedScene observe(const RawlogStep& step, const FeatureExtractorOptions& extraction = {});

/// How many entries of a log were invalid and were ignored.
struct LeftOutOfLog
{
  std::size_t observations = 0;  ///< scans that toLaserScan() refuses, landmarks of such a sensor
  std::size_t motions = 0;  ///< not finite, or farther than any robot drives between two steps
};

/// Reads a rawlog step by step. Both kinds can be read: action/sensory-frame pairs, and
/// observations only, as rawlog-grabber writes them. Of the latter, odometry is differenced between
/// scans. Steps are those that MRPT counts: in a log of pairs, a frame before the first action is
/// none. A CARMEN log (`.log`, `.clf`, `.carmen`; `.gz` or `.zst` may follow) is read as the
/// observations of its laser messages.
class RawlogReader
{
 public:
  /// Throws std::runtime_error naming the path and the reason for a missing, empty or foreign file,
  /// and std::invalid_argument where `reading` holds no band of heights.
  explicit RawlogReader(const std::filesystem::path& path, const ReadingOptions& reading = {});
  ~RawlogReader();
  RawlogReader(RawlogReader&&) noexcept;
  RawlogReader& operator=(RawlogReader&&) noexcept;

  /// Returns the next step with at least one usable scan or landmark observation, or nullopt at the
  /// end of the log.
  std::optional<RawlogStep> next();

  /// True when reading ended before the end of the file: outputs cover what was read.
  bool truncated() const;
  /// Of what was read so far.
  const LeftOutOfLog& leftOut() const;
  /// Returns the observations read so far by class, for messages: "12 CObservationGPS, 3
  /// CObservationIMU"; empty for none.
  std::string contents() const;
  /// Share of the file read so far, in [0, 1].
  double progress() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};
}  // namespace sigloc

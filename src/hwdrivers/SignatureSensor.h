// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/hwdrivers/CGenericSensor.h>

#include <string>

#include "sigloc/features/observe_scans.h"

namespace sigloc
{
/// A laser that also extracts features, for `rawlog-grabber -p libsigloc-hwdrivers.so`. It runs
/// another sensor and forwards its observations, each scan followed by its `ObservationSignatures`.
///
/// Its ini section holds, besides the keys that rawlog-grabber needs for every sensor:
///
/// * `laser_driver`: the class of the sensor, such as CHokuyoURG, which finds its own keys here
/// too;
///   `RawlogReplay` plays the log `rawlog` in place of a device
/// * `features.<key>`: the options of FeatureExtractorOptions
class SignatureSensor : public mrpt::hwdrivers::CGenericSensor
{
  DEFINE_GENERIC_SENSOR(SignatureSensor)

 public:
  void initialize() override;
  /// Runs the sensor once and takes over its observations.
  void doProcess() override;
  void setPathForExternalImages(const std::string& directory) override;

 private:
  /// Throws std::exception naming the section for an unknown driver, an unknown option or an error
  /// of the sensor itself.
  void loadConfig_sensorSpecific(const mrpt::config::CConfigFileBase& source,
                                 const std::string& section) override;

  Ptr laser_;
  FeatureExtractorOptions extraction_;
};
}  // namespace sigloc

// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/hwdrivers/CGenericSensor.h>

#include <string>

#include "sigloc/features/observe_scans.h"

namespace sigloc
{
/// A laser with an eye for features, for `rawlog-grabber -p libsigloc-hwdrivers.so`: another sensor
/// whose observations it forwards, each scan followed by its `ObservationSignatures`.
///
/// Its ini section holds, besides what rawlog-grabber asks of every sensor:
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
  /// Lets the sensor work, and takes over what it has observed.
  void doProcess() override;
  void setPathForExternalImages(const std::string& directory) override;

 private:
  /// Throws std::exception naming the section for an unknown driver, an unknown option or whatever
  /// the sensor itself does not like.
  void loadConfig_sensorSpecific(const mrpt::config::CConfigFileBase& source,
                                 const std::string& section) override;

  Ptr laser_;
  FeatureExtractorOptions extraction_;
};
}  // namespace sigloc

// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "hwdrivers/SignatureSensor.h"

#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/core/initializer.h>
#include <mrpt/obs/CObservation2DRangeScan.h>

#include <stdexcept>
#include <vector>

#include "hwdrivers/RawlogReplay.h"
#include "sigloc/plugin/ObservationSignatures.h"

IMPLEMENTS_GENERIC_SENSOR(SignatureSensor, sigloc)

// Runs when the library is linked, preloaded or opened as a plug-in.
MRPT_INITIALIZER(register_sigloc_sensors)
{
  sigloc::SignatureSensor::doRegister();
  sigloc::RawlogReplay::doRegister();
}

namespace sigloc
{
using mrpt::config::CConfigFileBase;
using mrpt::obs::CObservation2DRangeScan;

namespace
{
const std::string kPrefix = "features.";

FeatureExtractorOptions extractionOptions(const CConfigFileBase& source, const std::string& section)
{
  std::vector<std::string> keys;
  source.getAllKeys(section, keys);
  mrpt::config::CConfigFileMemory own;
  for (const std::string& key : keys)
  {
    if (key.rfind(kPrefix, 0) != 0) continue;
    own.write(section, key.substr(kPrefix.size()), source.read_string(section, key, ""));
  }
  return loadOptions(own, section, FeatureExtractorOptions());
}
}  // namespace

void SignatureSensor::loadConfig_sensorSpecific(const CConfigFileBase& source,
                                                const std::string& section)
{
  const std::string driver = source.read_string(section, "laser_driver", "", true);
  laser_ = driver == "SignatureSensor" ? nullptr : CGenericSensor::createSensorPtr(driver);
  if (!laser_)
  {
    throw std::invalid_argument("section " + section + ": laser_driver: no such sensor: " + driver);
  }
  extraction_ = extractionOptions(source, section);
  laser_->loadConfig(source, section);
  // Decimated once, by the sensor.
  m_grab_decimation = 0;
}

void SignatureSensor::initialize()
{
  laser_->initialize();
  m_state = laser_->getState();
}

void SignatureSensor::setPathForExternalImages(const std::string& directory)
{
  laser_->setPathForExternalImages(directory);
}

void SignatureSensor::doProcess()
{
  laser_->doProcess();
  m_state = laser_->getState();
  for (const auto& [time, object] : laser_->getObservations())
  {
    appendObservation(object);
    const auto scan = std::dynamic_pointer_cast<const CObservation2DRangeScan>(object);
    if (scan) appendObservation(std::make_shared<ObservationSignatures>(*scan, extraction_));
  }
}
}  // namespace sigloc

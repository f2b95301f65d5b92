// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "hwdrivers/RawlogReplay.h"

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/serialization/CArchive.h>

#include <cstdio>
#include <fstream>
#include <stdexcept>

IMPLEMENTS_GENERIC_SENSOR(RawlogReplay, sigloc)

namespace sigloc
{
using mrpt::obs::CActionCollection;
using mrpt::obs::CObservation;
using mrpt::obs::CObservationOdometry;
using mrpt::obs::CSensoryFrame;

void RawlogReplay::loadConfig_sensorSpecific(const mrpt::config::CConfigFileBase& source,
                                             const std::string& section)
{
  path_ = source.read_string(section, "rawlog", "", true);
  stop_after_end_ = source.read_double(section, "stop_after_end_s", stop_after_end_);
}

void RawlogReplay::initialize()
{
  // MRPT opens a file that is not there by asking for its size, which throws a reason of its own.
  const bool readable = std::ifstream(path_, std::ios::binary).get() != EOF;
  if (!readable || !file_.open(path_)) throw std::runtime_error(path_ + ": cannot read");
  m_state = ssWorking;
}

void RawlogReplay::doProcess()
{
  if (idle_ == 0 && playNext()) return;
  idle_ += 1 / m_process_rate;
  if (stop_after_end_ > 0 && idle_ > stop_after_end_)
  {
    // The only way in which a sensor can end rawlog-grabber, which logs it as an error.
    throw std::runtime_error(path_ + ": played to its end: all is well, the log is complete");
  }
}

/// Returns false at the end of the log.
bool RawlogReplay::playNext()
{
  auto archive = mrpt::serialization::archiveFrom(file_);
  CActionCollection::Ptr actions;
  CSensoryFrame::Ptr frame;
  CObservation::Ptr observation;
  if (!mrpt::obs::CRawlog::getActionObservationPairOrObservation(archive, actions, frame,
                                                                 observation, entry_))
  {
    return false;
  }
  const auto label = [&](const CObservation::Ptr& seen)
  {
    // Stock programs can't export or remove observations without a label.
    if (seen->sensorLabel.empty()) seen->sensorLabel = m_sensorLabel;
    return seen;
  };
  if (observation) appendObservation(label(observation));
  if (!frame || frame->empty()) return true;
  const auto movement = actions ? actions->getBestMovementEstimation() : nullptr;
  if (movement)
  {
    odometry_ = odometry_ + movement->poseChange->getMeanVal();
    auto odometry = CObservationOdometry::Create();
    odometry->timestamp = (*frame->begin())->timestamp;
    odometry->sensorLabel = "ODOMETRY";
    odometry->odometry = odometry_;
    appendObservation(odometry);
  }
  for (const CObservation::Ptr& seen : *frame) appendObservation(label(seen));
  return true;
}
}  // namespace sigloc

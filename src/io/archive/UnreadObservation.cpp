// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/archive/UnreadObservation.h"

#include <mrpt/poses/CPose3D.h>
#include <mrpt/serialization/CArchive.h>

#include <stdexcept>
#include <utility>

namespace sigloc::detail
{
UnreadObservation::UnreadObservation(std::string name, std::uint8_t version, std::string content)
    : name_(std::move(name)), version_(version), content_(std::move(content))
{
  timestamp = INVALID_TIMESTAMP;
  class_.className = name_.c_str();
  class_.getBaseClass = []() { return CLASS_ID(mrpt::obs::CObservation); };
}

UnreadObservation::UnreadObservation(const UnreadObservation& other)
    : UnreadObservation(other.name_, other.version_, other.content_)
{
  timestamp = other.timestamp;
  sensorLabel = other.sensorLabel;
  cut = other.cut;
}

void UnreadObservation::getSensorPose(mrpt::poses::CPose3D& pose) const
{
  pose = mrpt::poses::CPose3D();
}

void UnreadObservation::serializeTo(mrpt::serialization::CArchive& out) const
{
  out.WriteBuffer(content_.data(), content_.size());
}

void UnreadObservation::serializeFrom(mrpt::serialization::CArchive&, std::uint8_t)
{
  throw std::logic_error("UnreadObservation is not read from an archive");
}
}  // namespace sigloc::detail

// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation.h>

#include <cstdint>
#include <optional>
#include <string>

#include "sigloc/features/LaserScan.h"

namespace sigloc::detail
{
/// An observation of a log that MRPT does not read, kept as the bytes it is stored as. It goes by
/// its class's name, so that it is written as it was read. It has no time and no label, unless
/// cutPlanar() gives it both.
class UnreadObservation final : public mrpt::obs::CObservation
{
 public:
  /// `name` is that of the class, `content` what lies between its version and its end.
  UnreadObservation(std::string name, std::uint8_t version, std::string content);
  UnreadObservation(const UnreadObservation& other);
  UnreadObservation& operator=(const UnreadObservation&) = delete;
  ~UnreadObservation() override = default;

  const mrpt::rtti::TRuntimeClassId* GetRuntimeClass() const override { return &class_; }
  mrpt::rtti::CObject* clone() const override { return new UnreadObservation(*this); }
  const std::string& name() const { return name_; }
  std::uint8_t version() const { return version_; }
  const std::string& content() const { return content_; }

  /// What a planar laser would see in its place, of an observation of points in space.
  std::optional<LaserScan> cut;

  void getSensorPose(mrpt::poses::CPose3D& pose) const override;
  void setSensorPose(const mrpt::poses::CPose3D&) override {}

 protected:
  std::uint8_t serializeGetVersion() const override { return version_; }
  void serializeTo(mrpt::serialization::CArchive& out) const override;
  /// Throws std::logic_error: it is made by readLogEntry() alone.
  void serializeFrom(mrpt::serialization::CArchive& in, std::uint8_t version) override;

 private:
  std::string name_;
  std::uint8_t version_;
  std::string content_;
  mrpt::rtti::TRuntimeClassId class_;
};
}  // namespace sigloc::detail

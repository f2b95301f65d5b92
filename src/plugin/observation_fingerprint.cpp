// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/observation_fingerprint.h"

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationBearingRange.h>

#include <algorithm>
#include <cstring>

namespace sigloc
{
using mrpt::obs::CObservation;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::obs::CObservationBearingRange;
using mrpt::poses::CPose3D;

namespace
{
void mixIn(std::uint64_t value, std::uint64_t& hash)
{
  hash = (hash ^ value) * 0x9E3779B97F4A7C15ULL;
  hash ^= hash >> 29U;
}

void mixIn(double value, std::uint64_t& hash)
{
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof(bits));
  mixIn(bits, hash);
}

void mixIn(const CPose3D& pose, std::uint64_t& hash)
{
  for (const double value : {pose.x(), pose.y(), pose.z(), pose.yaw(), pose.pitch(), pose.roll()})
  {
    mixIn(value, hash);
  }
}

/// Only a few of the ranges are used, because this is called for every particle.
void mixIn(const CObservation2DRangeScan& scan, std::uint64_t& hash)
{
  constexpr std::size_t kSamples = 16;
  const std::size_t n = scan.getScanSize();
  mixIn(n, hash);
  mixIn(scan.sensorPose, hash);
  mixIn(static_cast<double>(scan.aperture), hash);
  mixIn(static_cast<double>(scan.maxRange), hash);
  mixIn(std::uint64_t{scan.rightToLeft}, hash);
  const std::size_t stride = std::max<std::size_t>(1, n / kSamples);
  for (std::size_t i = 0; i < n; i += stride)
  {
    mixIn(static_cast<double>(scan.getScanRange(i)), hash);
    mixIn(std::uint64_t{scan.getScanRangeValidity(i)}, hash);
  }
}

void mixIn(const CObservationBearingRange& landmarks, std::uint64_t& hash)
{
  mixIn(landmarks.sensorLocationOnRobot, hash);
  for (const auto& measured : landmarks.sensedData)
  {
    for (const float value : {measured.range, measured.yaw, measured.pitch})
    {
      mixIn(static_cast<double>(value), hash);
    }
  }
}
}  // namespace

std::uint64_t fingerprintOf(const CObservation& observation, std::size_t max_points)
{
  std::uint64_t hash = 1;
  mixIn(max_points, hash);
  mixIn(std::uint64_t{reinterpret_cast<std::uintptr_t>(&observation)}, hash);
  mixIn(static_cast<std::uint64_t>(observation.timestamp.time_since_epoch().count()), hash);
  if (const auto* scan = dynamic_cast<const CObservation2DRangeScan*>(&observation))
  {
    mixIn(*scan, hash);
  }
  if (const auto* landmarks = dynamic_cast<const CObservationBearingRange*>(&observation))
  {
    mixIn(*landmarks, hash);
  }
  return hash;
}
}  // namespace sigloc

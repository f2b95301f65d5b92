// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint2D.h>

#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "map/building/MapBuilder.h"
#include "map/NearestFeature.h"
#include "sigloc/plugin/SignatureMap.h"

namespace sigloc
{
/// The map in the form used for look-ups.
struct SignatureMap::Model
{
  std::shared_ptr<const FeatureMap> map;
  NearestFeature nearest;
};

/// The points of an observation, extracted once for all particles.
struct SignatureMap::PreparedObservation
{
  std::uint64_t fingerprint = 0;
  std::vector<mrpt::math::TPoint2D> returns;  // of a laser, robot frame
  std::vector<mrpt::math::TPoint2D> landmarks;  // robot frame
};

/// The inserted scans' data, and what is derived from them on demand, guarded by the mutex. A copy
/// of the map derives its own.
struct SignatureMap::Learnt
{
  Learnt() = default;
  Learnt(const Learnt& other);
  Learnt& operator=(const Learnt& other);
  mutable std::mutex mutex;
  std::optional<MapBuilder> builder;  // of the scans, on top of the prepared map
  std::shared_ptr<const Model> model;
  std::deque<std::shared_ptr<const PreparedObservation>> observations;
  std::size_t refused = 0;  // scans that the map cannot hold
  std::string refusal;  // why, of the first

  void refuse(const std::string& reason)
  {
    if (refused++ == 0) refusal = reason;
  }
};
}  // namespace sigloc

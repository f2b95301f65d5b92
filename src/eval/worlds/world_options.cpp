// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <map>
#include <vector>

#include "eval/worlds/world_generators.h"

namespace sigloc
{
bool usesOption(WorldKind kind, std::string_view key)
{
  using Kinds = std::vector<WorldKind>;
  const Kinds rooms = {WorldKind::office, WorldKind::corridor};
  const Kinds scanned = {WorldKind::office, WorldKind::corridor, WorldKind::hall, WorldKind::park};
  static const std::map<std::string_view, Kinds> kUsers = {
      {"width", scanned},
      {"height", scanned},
      {"wall_thickness", {WorldKind::office, WorldKind::corridor, WorldKind::hall}},
      {"door_width", rooms},
      {"furniture_per_room", rooms},
      {"closed_door_share", rooms},
      {"copies", {WorldKind::corridor}},
      {"jitter", {WorldKind::corridor}},
      {"density", {WorldKind::park, WorldKind::points}},
      {"points", {WorldKind::points}},
      {"patches", {WorldKind::points}},
      {"moved_share", rooms},
      {"move_distance", rooms},
      {"extra_items", scanned}};
  const auto users = kUsers.find(key);
  return users == kUsers.end() ||
         std::find(users->second.begin(), users->second.end(), kind) != users->second.end();
}
}  // namespace sigloc

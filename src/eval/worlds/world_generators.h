// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "eval/worlds/Random.h"
#include "eval/worlds/World.h"
#include "sigloc/config/option_fields.h"

namespace sigloc
{
enum class WorldKind : std::uint8_t
{
  office = 0,  ///< rooms with doors on both sides of a corridor, furnished, no symmetry
  corridor = 1,  ///< one room repeated along a corridor
  hall = 2,  ///< a large room with pillars
  park = 3,  ///< trunks, no walls
  points = 4,  ///< point landmarks only: the standard world of the growth study
  round = 5,  ///< round rooms with doors along a curved corridor, two pieces of furniture in each
};

/// "office", "corridor", "hall", "park", "points", "round".
const char* toString(WorldKind kind);

/// Throws std::invalid_argument naming the text when it is no kind of world.
WorldKind worldKindFrom(const std::string& text);

/// True when worlds of a kind depend on the field of that key, of WorldOptions or of
/// WorldChangeOptions; true for keys of neither.
bool usesOption(WorldKind kind, std::string_view key);

/// Sizes of a world; a kind ignores the fields that it does not use. With 0 for width or height the
/// kind's own size is taken.
struct WorldOptions
{
  double width = 0;
  double height = 0;
  double wall_thickness = 0.12;
  double door_width = 0.95;
  double furniture_per_room = 3;
  double closed_door_share = 0;
  std::uint32_t copies = 4;
  double jitter = 0;
  double density = 0;
  std::uint32_t points = 1000;
  std::uint32_t patches = 1;

  template <class V>
  static void visitFields(V&& visit)
  {
    using O = WorldOptions;
    visit(OptionField{"width", &O::width, 0.0, 10000.0, "[m] along x, 0: the kind's own"});
    visit(OptionField{"height", &O::height, 0.0, 10000.0, "[m] along y, 0: the kind's own"});
    visit(OptionField{"wall_thickness", &O::wall_thickness, 0.02, 1.0,
                      "[m] of inner and outer walls"});
    visit(OptionField{"door_width", &O::door_width, 0.7, 3.0, "[m] opening of a door"});
    visit(OptionField{"furniture_per_room", &O::furniture_per_room, 0.0, 20.0,
                      "[-] pieces in a room, on average"});
    visit(OptionField{"closed_door_share", &O::closed_door_share, 0.0, 1.0,
                      "[-] share of the doors that are closed while mapping"});
    visit(OptionField{"copies", &O::copies, 1U, 1000U, "[-] corridor: how often the room repeats"});
    visit(
        OptionField{"jitter", &O::jitter, 0.0, 1.0,
                    "[m] corridor: standard deviation of each copy's furniture, 0: exact copies"});
    visit(OptionField{"density", &O::density, 0.0, 10.0,
                      "[1/m^2] park: trunks, points: landmarks, 0: the kind's own"});
    visit(OptionField{"points", &O::points, 1U, 2000000U, "[-] points: how many landmarks"});
    visit(OptionField{"patches", &O::patches, 1U, 1000U,
                      "[-] points: how often a patch of 16 m repeats"});
  }
};

/// Returns a world of the kind; equal seeds and options give equal worlds.
/// Throws std::invalid_argument for options out of range or too small for the kind.
World makeWorld(WorldKind kind, const WorldOptions& options, std::uint64_t seed);

namespace detail
{
/// Returns a curved corridor around a round hall, with round rooms along its outside. Each of them
/// has a door and two unlike pieces of furniture. Throws std::invalid_argument for a width that is
/// too small.
World makeRound(const WorldOptions& options, Random& random);

/// Returns points that lie at random in a square. Throws std::invalid_argument where it is too
/// small for the patches.
World makePoints(const WorldOptions& options, Random& random);
}  // namespace detail
}  // namespace sigloc

// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/protocols/swept_quantities.h"

#include <cmath>
#include <set>
#include <stdexcept>

#include "eval/data/method_names.h"
#include "eval/protocols/sweep.h"

namespace sigloc
{
namespace
{
using C = SweepConditions;

/// Field of view at the same angle between beams.
void setFieldOfView(double degrees, C& conditions)
{
  const LaserOptions plain;
  const double step_deg = plain.fov_deg / (plain.beams - 1);
  conditions.laser.fov_deg = degrees;
  const bool full_circle = degrees > 360.0 - 1e-6;  // which does not repeat its first beam
  conditions.laser.beams =
      static_cast<std::uint32_t>(std::lround(degrees / step_deg)) + (full_circle ? 0U : 1U);
}
}  // namespace

const std::vector<SweptQuantity>& sweptQuantities()
{
  using Kinds = std::vector<WorldKind>;
  const Kinds all = {WorldKind::office, WorldKind::corridor, WorldKind::hall};
  const Kinds furnished = {WorldKind::office, WorldKind::corridor};
  static const std::vector<SweptQuantity> kTable = {
      {"noise",
       "sd of a range [m]",
       {0.01, 0.02, 0.03, 0.05, 0.07, 0.10},
       {0, 10, false},
       all,
       false,
       [](double value, C& c) { c.laser.range_sigma = value; }},
      {"clutter",
       "share of the beams that end early",
       {0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6},
       {0, 1, false},
       all,
       false,
       [](double value, C& c) { c.laser.clutter_share = value; }},
      {"fov",
       "field of view [deg]",
       {90, 120, 180, 240, 270, 360},
       {10, 360, false},
       all,
       false,
       setFieldOfView},
      {"range",
       "range of the laser [m]",
       {5, 8, 12, 20, 30},
       {0.5, 1000, false},
       all,
       false,
       [](double value, C& c) { c.laser.max_range = value; }},
      {"map-noise",
       "sd of a mapping scan's position [m]",
       {0, 0.02, 0.05, 0.1, 0.15},
       {0, 10, false},
       all,
       true,
       [](double value, C& c) { c.map_sigma = value; }},
      {"furniture",
       "share of the furniture that was moved",
       {0, 0.25, 0.5, 0.75, 1},
       {0, 1, false},
       furnished,
       false,
       [](double value, C& c) { c.change.moved_share = value; }},
      {"unmapped",
       "unmapped pieces in 100 m^2",
       {0, 2, 5, 10, 20},
       {0, 1000, false},
       all,
       false,
       [](double value, C& c) { c.unmapped_items = value; }},
      {"doors",
       "share of the doors shut since mapping",
       {0, 0.25, 0.5, 0.75, 1},
       {0, 1, false},
       furnished,
       false,
       [](double value, C& c) { c.change.closed_door_share = value; }},
      {"thresholds",
       "height of the door's threshold [m]",
       {0, 0.01, 0.02, 0.03, 0.05},
       {0, 0.1, false},
       furnished,
       false,
       [](double value, C& c) { c.threshold = value; }},
      {"repeats",
       "copies of the room",
       {1, 2, 4, 6, 8},
       {1, 100, true},
       {WorldKind::corridor},
       true,
       [](double value, C& c) { c.world.copies = static_cast<std::uint32_t>(std::lround(value)); }},
  };
  return kTable;
}

const SweptQuantity& sweptQuantity(const std::string& name)
{
  std::vector<std::string> known;
  known.reserve(sweptQuantities().size());
  for (const SweptQuantity& quantity : sweptQuantities())
  {
    if (quantity.name == name) return quantity;
    known.push_back(quantity.name);
  }
  throw std::invalid_argument("nothing called '" + name + "' to sweep over; known are " +
                              joined(known));
}

void checkSweptValues(const SweptQuantity& quantity, const std::vector<double>& values)
{
  std::set<double> seen;
  for (const double value : values)
  {
    const std::string text = quantity.name + " " + sweptValueText(value);
    const SweptRange& range = quantity.range;
    if (!(value >= range.least && value <= range.most))
    {
      throw std::invalid_argument(text + ": not from " + sweptValueText(range.least) + " to " +
                                  sweptValueText(range.most));
    }
    if (range.whole && value != std::round(value))
    {
      throw std::invalid_argument(text + ": not a whole number");
    }
    if (!seen.insert(value).second) throw std::invalid_argument(text + ": given twice");
  }
}
}  // namespace sigloc

// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/worlds/Random.h"

#include <cmath>

namespace sigloc
{
namespace
{
/// One step of the splitmix64 generator: spreads neighbouring seeds over all 64 bits.
std::uint64_t mixed(std::uint64_t value)
{
  value += 0x9E3779B97F4A7C15ULL;
  value = (value ^ (value >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  value = (value ^ (value >> 27U)) * 0x94D049BB133111EBULL;
  return value ^ (value >> 31U);
}
}  // namespace

Random::Random(std::uint64_t seed, std::uint64_t stream) : engine_(mixed(seed ^ mixed(stream))) {}

double Random::uniform()
{
  return static_cast<double>(engine_() >> 11U) * 0x1.0p-53;
}

double Random::normal()
{
  if (has_spare_)
  {
    has_spare_ = false;
    return spare_;
  }
  // Box and Muller; 1 - u lies in (0, 1], so that the logarithm is finite.
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
  const double angle = 2.0 * M_PI * uniform();
  spare_ = radius * std::sin(angle);
  has_spare_ = true;
  return radius * std::cos(angle);
}

std::size_t Random::index(std::size_t count)
{
  return static_cast<std::size_t>(uniform() * static_cast<double>(count));
}
}  // namespace sigloc

// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/worlds/Random.h"

#include <cmath>

#include "matching/features/SplitMix.h"

namespace sigloc
{
// SplitMix spreads neighbouring seeds over all 64 bits.
Random::Random(std::uint64_t seed, std::uint64_t stream)
    : engine_(SplitMix(seed ^ SplitMix(stream).next()).next())
{
}

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

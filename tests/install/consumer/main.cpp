// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <sigloc/features/Feature.h>

#include <cmath>

// A wall seen ahead, moved into a map frame turned by 90 degrees: exit code 0 if it lies there.
int main()
{
  sigloc::Feature wall;
  wall.type = sigloc::FeatureType::segment;
  wall.position = {2.0, 0.0};
  const sigloc::Feature mapped = sigloc::transformed({1.0, 1.0, M_PI / 2}, wall);
  return std::hypot(mapped.position.x - 1.0, mapped.position.y - 3.0) < 1e-12 ? 0 : 1;
}

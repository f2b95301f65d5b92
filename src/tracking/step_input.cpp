// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/step_input.h"

#include <cmath>
#include <stdexcept>

namespace sigloc
{
namespace
{
bool isFinite(const mrpt::math::TPoint2D& point)
{
  return std::isfinite(point.x) && std::isfinite(point.y);
}
}  // namespace

void checkMotion(const MotionIncrement& motion)
{
  bool sound = isFinite({motion.mean.x, motion.mean.y}) && std::isfinite(motion.mean.phi);
  for (int r = 0; r < motion.covariance.rows(); ++r)
  {
    for (int c = 0; c < motion.covariance.cols(); ++c)
      sound = sound && std::isfinite(motion.covariance(r, c));
    sound = sound && motion.covariance(r, r) >= 0;
  }
  if (!sound) throw std::invalid_argument("a motion is not finite or has a negative variance");
}
}  // namespace sigloc

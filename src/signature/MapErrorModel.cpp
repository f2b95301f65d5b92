// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/signature/MapErrorModel.h"

namespace sigloc
{
namespace
{
// By reference: how a pose is passed by value changed between compilers.
GaussianPose widened(const GaussianPose& pose, const MapErrorModel& error, double sign)
{
  GaussianPose out = pose;
  out.covariance(0, 0) += sign * error.common_sigma * error.common_sigma;
  out.covariance(1, 1) += sign * error.common_sigma * error.common_sigma;
  out.covariance(2, 2) += sign * error.common_turn_sigma * error.common_turn_sigma;
  return out;
}
}  // namespace

GaussianPose withCommonError(const GaussianPose& pose, const MapErrorModel& error)
{
  return widened(pose, error, +1);
}

GaussianPose withoutCommonError(const GaussianPose& pose, const MapErrorModel& error)
{
  return widened(pose, error, -1);
}
}  // namespace sigloc

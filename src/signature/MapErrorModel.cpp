// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/signature/MapErrorModel.h"

namespace sigloc
{
namespace
{
void addCommonError(const MapErrorModel& error, double sign, GaussianPose& pose)
{
  pose.covariance(0, 0) += sign * error.common_sigma * error.common_sigma;
  pose.covariance(1, 1) += sign * error.common_sigma * error.common_sigma;
  pose.covariance(2, 2) += sign * error.common_turn_sigma * error.common_turn_sigma;
}
}  // namespace

GaussianPose withCommonError(GaussianPose pose, const MapErrorModel& error)
{
  addCommonError(error, +1, pose);
  return pose;
}

GaussianPose withoutCommonError(GaussianPose pose, const MapErrorModel& error)
{
  addCommonError(error, -1, pose);
  return pose;
}
}  // namespace sigloc

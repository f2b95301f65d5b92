// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/geometry/GaussianPose.h"

#include <gtest/gtest.h>

namespace sigloc
{
namespace
{
TEST(MapErrorModel, WhatIsCommonWidensEveryPoseByTheSame)
{
  MapErrorModel error;
  error.common_sigma = 0.3;
  error.common_turn_sigma = 0.02;
  GaussianPose pose;
  pose.mean = {3, -4, 0.7};
  pose.covariance.setIdentity();
  pose.covariance(0, 1) = pose.covariance(1, 0) = 0.5;
  const GaussianPose wide = withCommonError(pose, error);
  EXPECT_EQ(wide.mean, pose.mean);
  EXPECT_DOUBLE_EQ(wide.covariance(0, 0), 1 + 0.09);
  EXPECT_DOUBLE_EQ(wide.covariance(1, 1), 1 + 0.09);
  EXPECT_DOUBLE_EQ(wide.covariance(2, 2), 1 + 0.0004);
  EXPECT_DOUBLE_EQ(wide.covariance(0, 1), 0.5);
  EXPECT_DOUBLE_EQ(wide.covariance(0, 2), 0);
}

TEST(MapErrorModel, WhatIsCommonCanBeTakenBack)
{
  GaussianPose pose;
  pose.covariance.setIdentity();
  const GaussianPose back = withoutCommonError(withCommonError(pose, {}), {});
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(back.covariance(k, k), 1, 1e-12);
}
}  // namespace
}  // namespace sigloc

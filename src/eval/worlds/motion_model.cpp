// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/worlds/motion_model.h"

namespace sigloc
{
mrpt::obs::CActionRobotMovement2D odometryAction(const mrpt::math::TPose2D& increment,
                                                 const OdometryOptions& options)
{
  mrpt::obs::CActionRobotMovement2D::TMotionModelOptions model;
  model.modelSelection = mrpt::obs::CActionRobotMovement2D::mmGaussian;
  model.gaussianModel = {options.a1, options.a2,           options.a3,
                         options.a4, options.min_sigma_xy, options.min_sigma_phi};
  mrpt::obs::CActionRobotMovement2D action;
  action.computeFromOdometry(mrpt::poses::CPose2D(increment), model);
  return action;
}

mrpt::math::CMatrixDouble33 odometryCovariance(const mrpt::math::TPose2D& increment,
                                               const OdometryOptions& options)
{
  mrpt::math::CMatrixDouble33 covariance;
  mrpt::poses::CPose2D mean;
  odometryAction(increment, options).poseChange->getCovarianceAndMean(covariance, mean);
  return covariance;
}
}  // namespace sigloc

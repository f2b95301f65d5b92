// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/tracks/SchmidtKalmanFilter.h"

#include <algorithm>
#include <cmath>

namespace sigloc
{
namespace
{
using Cross = SchmidtKalmanFilter::Cross;

/// P J', a row for each of (x, y, heading).
Cross timesJacobian(const Symmetric3& p, const PlanarMeasurement& m)
{
  Cross out;
  for (std::size_t k = 0; k < 2; ++k)
  {
    const auto& j = m.jacobian[k];
    out[0][k] = p.xx * j[0] + p.xy * j[1] + p.xt * j[2];
    out[1][k] = p.xy * j[0] + p.yy * j[1] + p.yt * j[2];
    out[2][k] = p.xt * j[0] + p.yt * j[1] + p.tt * j[2];
  }
  return out;
}

/// J C for a cross-covariance C.
std::array<std::array<double, 2>, 2> jacobianTimes(const PlanarMeasurement& m, const Cross& c)
{
  std::array<std::array<double, 2>, 2> out{};
  for (std::size_t r = 0; r < 2; ++r)
  {
    for (std::size_t k = 0; k < 2; ++k)
    {
      for (std::size_t i = 0; i < c.size(); ++i) out[r][k] += m.jacobian[r][i] * c[i][k];
    }
  }
  return out;
}

/// B S^-1.
Cross gainOf(const Cross& b, const Symmetric2& s)
{
  const double scale = 1 / determinant(s);
  Cross gain;
  for (std::size_t i = 0; i < b.size(); ++i)
  {
    gain[i] = {(b[i][0] * s.yy - b[i][1] * s.xy) * scale,
               (b[i][1] * s.xx - b[i][0] * s.xy) * scale};
  }
  return gain;
}
}  // namespace

void SchmidtKalmanFilter::predict(const mrpt::math::TPose2D& map_from_previous,
                                  const mrpt::math::TPose2D& increment)
{
  const double c = std::cos(map_from_previous.phi);
  const double s = std::sin(map_from_previous.phi);
  const double forward_x = c * increment.x - s * increment.y;
  const double forward_y = s * increment.x + c * increment.y;
  for (Known& known : known_)
  {
    for (std::size_t k = 0; k < 2; ++k)
    {
      known.cross[0][k] -= forward_y * known.cross[2][k];
      known.cross[1][k] += forward_x * known.cross[2][k];
    }
  }
}

const SchmidtKalmanFilter::Known* SchmidtKalmanFilter::find(std::uint32_t feature) const
{
  const auto at = std::find_if(known_.begin(), known_.end(),
                               [&](const Known& known) { return known.feature == feature; });
  return at == known_.end() ? nullptr : &*at;
}

Symmetric2 SchmidtKalmanFilter::innovation(const PoseEstimate& estimate, const PlanarMeasurement& m,
                                           const Known* known, const Symmetric2& map_noise) const
{
  Symmetric2 s = innovationCovariance(estimate.covariance, m);
  if (known == nullptr) return s;
  const auto jc = jacobianTimes(m, known->cross);
  s.xx += known->noise.xx - map_noise.xx - 2 * jc[0][0];
  s.xy += known->noise.xy - map_noise.xy - jc[0][1] - jc[1][0];
  s.yy += known->noise.yy - map_noise.yy - 2 * jc[1][1];
  return s;
}

Symmetric2 SchmidtKalmanFilter::innovation(const PoseEstimate& estimate, const PlanarMeasurement& m,
                                           std::uint32_t feature, const Symmetric2& map_noise) const
{
  return innovation(estimate, m, find(feature), map_noise);
}

/// x <- x + K r, P <- P - K S K', C_j <- C_j - K J C_j for all remembered features, eq. (8.13).
void SchmidtKalmanFilter::apply(PoseEstimate& estimate, const PlanarMeasurement& m,
                                const Cross& gain, const Symmetric2& innovation)
{
  const auto& [a, b, t] = gain;
  const auto& r = m.residual;
  estimate.x += a[0] * r[0] + a[1] * r[1];
  estimate.y += b[0] * r[0] + b[1] * r[1];
  estimate.setHeading(estimate.heading + t[0] * r[0] + t[1] * r[1]);
  const auto shrunk = [&](const std::array<double, 2>& u, const std::array<double, 2>& v)
  {
    return u[0] * (innovation.xx * v[0] + innovation.xy * v[1]) +
           u[1] * (innovation.xy * v[0] + innovation.yy * v[1]);
  };
  Symmetric3& p = estimate.covariance;
  p.xx -= shrunk(a, a);
  p.xy -= shrunk(a, b);
  p.xt -= shrunk(a, t);
  p.yy -= shrunk(b, b);
  p.yt -= shrunk(b, t);
  p.tt -= shrunk(t, t);
  for (Known& known : known_)
  {
    const auto jc = jacobianTimes(m, known.cross);
    for (std::size_t i = 0; i < gain.size(); ++i)
    {
      for (std::size_t k = 0; k < 2; ++k)
      {
        known.cross[i][k] -= gain[i][0] * jc[0][k] + gain[i][1] * jc[1][k];
      }
    }
  }
}

void SchmidtKalmanFilter::update(PoseEstimate& estimate, const PlanarMeasurement& m,
                                 std::uint32_t feature, const Symmetric2& map_noise,
                                 double travelled)
{
  if (!knows(feature)) known_.push_back({feature, map_noise, {}, travelled});
  const auto at = static_cast<std::size_t>(find(feature) - known_.data());
  known_[at].last_seen = travelled;
  const Symmetric2 s = innovation(estimate, m, &known_[at], map_noise);
  // The residual is J dx - dm - v. Its covariance with the pose lacks the feature's own error dm.
  Cross b = timesJacobian(estimate.covariance, m);
  for (std::size_t i = 0; i < b.size(); ++i)
  {
    for (std::size_t k = 0; k < 2; ++k) b[i][k] -= known_[at].cross[i][k];
  }
  const Cross gain = gainOf(b, s);
  apply(estimate, m, gain, s);
  const Symmetric2& own = known_[at].noise;
  for (std::size_t i = 0; i < gain.size(); ++i)
  {
    known_[at].cross[i][0] += gain[i][0] * own.xx + gain[i][1] * own.xy;
    known_[at].cross[i][1] += gain[i][0] * own.xy + gain[i][1] * own.yy;
  }
}

void SchmidtKalmanFilter::updateFreely(PoseEstimate& estimate, const PlanarMeasurement& m)
{
  const Symmetric2 s = innovationCovariance(estimate.covariance, m);
  apply(estimate, m, gainOf(timesJacobian(estimate.covariance, m), s), s);
}

void SchmidtKalmanFilter::forgetBefore(double travelled)
{
  known_.erase(std::remove_if(known_.begin(), known_.end(),
                              [&](const Known& known) { return known.last_seen < travelled; }),
               known_.end());
}
}  // namespace sigloc

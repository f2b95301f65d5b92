// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "map_errors.h"

#include <algorithm>
#include <cmath>

#include "sigloc/map/DenseField.h"

namespace sigloc
{
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

namespace
{
constexpr double kNear = 0.3;  // [m] from a wall: the return is of that wall
constexpr double kLeastReturns = 1000;

// What neighbouring scans see in free space, both know: people, and what was moved between two
// visits, are counted in a part of the returns alone. Chosen by the share of recorded returns in
// free space, in docs/lab-notes/map-check.md.
constexpr double kClutterFactor = 4;
constexpr double kMostClutter = 0.4;
constexpr double kMostSigma = 0.15;  // [m]

bool hasReturn(const PosedScans& posed)
{
  return std::any_of(posed.scans.begin(), posed.scans.end(),
                     [](const LaserScan& scan)
                     { return std::count(scan.valid.begin(), scan.valid.end(), 1) > 0; });
}

/// The returns of scans against a raster that does not hold them.
class ReturnCounts
{
 public:
  explicit ReturnCounts(const DenseField& field) : field_(field) {}

  void add(const PosedScans& posed)
  {
    for (const LaserScan& scan : posed.scans)
    {
      const TPose2D origin = posed.map_from_robot + scan.robot_from_sensor;
      forEachReturn(scan, [&](const TPoint2D& end) { add(origin.composePoint(end)); });
    }
  }

  double returns() const { return near_ + in_free_; }
  /// Share of the returns far from any wall, in free space.
  double freeShare() const { return in_free_ / returns(); }
  /// [m], root mean square distance of the returns near walls.
  double sigma() const { return std::sqrt(squares_ / std::max(1.0, near_)); }

 private:
  void add(const TPoint2D& point)
  {
    const DenseCell* at = cellAt(field_, point);
    if (at == nullptr) return;
    const double distance = at->distance() * DenseField::kDistanceUnit;
    if (distance < kNear)
    {
      near_ += 1;
      squares_ += distance * distance;
    }
    else if (at->state() == CellState::free)
    {
      in_free_ += 1;
    }
  }

  const DenseField& field_;
  double near_ = 0;
  double in_free_ = 0;
  double squares_ = 0;  // [m^2]
};
}  // namespace

SimulatedLaserOptions withErrorsOf(const std::vector<PosedScans>& scans,
                                   SimulatedLaserOptions laser)
{
  std::vector<PosedScans> mapped;
  for (std::size_t i = 0; i < scans.size(); i += 2) mapped.push_back(scans[i]);
  if (std::none_of(mapped.begin(), mapped.end(), hasReturn)) return laser;
  const DenseField field = buildDenseField(rasterFromScans(mapped));
  ReturnCounts counts(field);
  for (std::size_t i = 1; i < scans.size(); i += 2) counts.add(scans[i]);
  if (counts.returns() < kLeastReturns) return laser;
  laser.clutter_share = std::min(kClutterFactor * counts.freeShare(), kMostClutter);
  laser.map_sigma = std::min(counts.sigma(), kMostSigma);
  return laser;
}
}  // namespace sigloc

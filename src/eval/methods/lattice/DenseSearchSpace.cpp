// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/methods/lattice/DenseSearchSpace.h"

#include "geometry/same_place.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>

namespace sigloc
{
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

namespace
{
constexpr double kLongestRange = 80.0;  // [m], end points beyond it are not looked up

// Wide enough that no return can leave the bordered grid.
std::uint32_t borderOf(const RasterFrame& frame)
{
  const auto longest = static_cast<std::uint32_t>(std::ceil(kLongestRange / frame.resolution)) + 1;
  return std::min(std::max(frame.width, frame.height), longest);
}

std::vector<std::int32_t> latticeCells(std::uint32_t cells, double step_cells)
{
  std::vector<std::int32_t> out;
  for (std::size_t i = 0;; ++i)
  {
    const auto cell = static_cast<std::int64_t>(static_cast<double>(i) * step_cells);
    if (cell >= static_cast<std::int64_t>(cells)) break;
    out.push_back(static_cast<std::int32_t>(cell));
  }
  return out;
}
}  // namespace

bool ranksBefore(const LatticePose& a, const LatticePose& b)
{
  return std::tie(b.score, a.heading, a.row, a.column) <
         std::tie(a.score, b.heading, b.row, b.column);
}

std::vector<TPoint2D> endPoints(const std::vector<LaserScan>& scans)
{
  std::vector<TPoint2D> points;
  for (const LaserScan& scan : scans)
  {
    forEachReturn(scan, [&](const TPoint2D& end)
                  { points.push_back(scan.robot_from_sensor.composePoint(end)); });
  }
  return points;
}

std::vector<Candidate> distinctCandidates(const std::vector<Candidate>& ranked, std::size_t limit)
{
  std::vector<Candidate> distinct;
  for (const Candidate& candidate : ranked)
  {
    if (distinct.size() >= limit) break;
    const TPose2D& pose = candidate.pose.mean;
    const bool seen =
        std::any_of(distinct.begin(), distinct.end(),
                    [&](const Candidate& other) { return samePlace(other.pose.mean, pose); });
    if (!seen) distinct.push_back(candidate);
  }
  return distinct;
}

DenseSearchSpace::DenseSearchSpace(const OccupancyRaster& raster, const DenseSearchOptions& options)
    : options_(options),
      coarse_(buildDenseField(raster), options.coarse_sigma, borderOf(raster.frame)),
      fine_(buildDenseField(raster), options.fine_sigma, 1)
{
  layOutPlaces(raster);
  for (std::uint32_t h = 0; h < options_.headings; ++h)
  {
    const double heading = poseOf({0, h, 0, 0}).phi;
    const auto& region = options_.region;
    if (!region ||
        std::abs(mrpt::math::angDistance(heading, region->heading)) <= region->heading_tolerance)
    {
      headings_.push_back(h);
    }
  }
  const bool nowhere = headings_.empty() ||
                       std::find(free_places_.begin(), free_places_.end(), 1) == free_places_.end();
  if (nowhere) throw std::invalid_argument("the map has no free place inside the region");
}

std::vector<TPose2D> freeLatticePoses(const OccupancyRaster& raster,
                                      const DenseSearchOptions& options)
{
  const DenseSearchSpace space(raster, options);
  const auto columns = static_cast<std::uint32_t>(space.columnCells().size());
  std::vector<TPose2D> poses;
  for (std::uint32_t place = 0; place < space.freePlaces().size(); ++place)
  {
    if (!space.freePlaces()[place]) continue;
    for (const std::uint32_t heading : space.headings())
    {
      poses.push_back(space.poseOf({0, heading, place / columns, place % columns}));
    }
  }
  return poses;
}

void DenseSearchSpace::layOutPlaces(const OccupancyRaster& raster)
{
  const RasterFrame& frame = raster.frame;
  const double step_cells = options_.lattice_step / frame.resolution;
  column_cells_ = latticeCells(frame.width, std::max(1.0, step_cells));
  row_cells_ = latticeCells(frame.height, std::max(1.0, step_cells));
  free_places_.reserve(column_cells_.size() * row_cells_.size());
  for (std::uint32_t row = 0; row < row_cells_.size(); ++row)
  {
    for (std::uint32_t column = 0; column < column_cells_.size(); ++column)
    {
      const std::size_t cell = static_cast<std::size_t>(row_cells_[row]) * frame.width +
                               static_cast<std::size_t>(column_cells_[column]);
      const TPose2D place = poseOf({0, 0, row, column});
      const auto& region = options_.region;
      const bool inside = !region || (place.x >= region->x_min && place.x <= region->x_max &&
                                      place.y >= region->y_min && place.y <= region->y_max);
      free_places_.push_back(inside && raster.cells[cell] == CellState::free ? 1 : 0);
    }
  }
}

TPose2D DenseSearchSpace::poseOf(const LatticePose& pose) const
{
  const RasterFrame& frame = coarse_.frame();
  return {frame.origin.x + (column_cells_[pose.column] + 0.5) * frame.resolution,
          frame.origin.y + (row_cells_[pose.row] + 0.5) * frame.resolution,
          mrpt::math::wrapToPi(2 * M_PI * pose.heading / options_.headings)};
}

std::vector<TPoint2D> DenseSearchSpace::latticePoints(const std::vector<LaserScan>& scans) const
{
  std::vector<TPoint2D> all = endPoints(scans);
  if (all.size() <= options_.points) return all;
  std::vector<TPoint2D> chosen;
  for (std::size_t i = 0; i < options_.points; ++i)
  {
    chosen.push_back(all[i * all.size() / options_.points]);
  }
  return chosen;
}

std::vector<CellOffset> DenseSearchSpace::offsets(const std::vector<TPoint2D>& points,
                                                  std::uint32_t heading) const
{
  const double phi = 2 * M_PI * heading / options_.headings;
  const double c = std::cos(phi) / coarse_.frame().resolution;
  const double s = std::sin(phi) / coarse_.frame().resolution;
  const double border = coarse_.border();
  std::vector<CellOffset> out;
  out.reserve(points.size());
  for (const TPoint2D& p : points)
  {
    const double dx = std::round(c * p.x - s * p.y);
    const double dy = std::round(s * p.x + c * p.y);
    if (std::abs(dx) > border || std::abs(dy) > border) continue;
    out.push_back({static_cast<std::int32_t>(dx), static_cast<std::int32_t>(dy)});
  }
  return out;
}

double DenseSearchSpace::fineScore(const TPose2D& pose, const std::vector<TPoint2D>& points) const
{
  const double c = std::cos(pose.phi);
  const double s = std::sin(pose.phi);
  double sum = 0;
  for (const TPoint2D& p : points)
  {
    sum += static_cast<double>(
        fine_.interpolated(pose.x + c * p.x - s * p.y, pose.y + s * p.x + c * p.y));
  }
  return sum;
}

// Pattern search: the six neighbours of the pose, moving to the best, halving the step when none is
// better.
Candidate DenseSearchSpace::refine(const TPose2D& start, const std::vector<TPoint2D>& points) const
{
  TPose2D best = start;
  double best_score = fineScore(start, points);
  double step = 0.5 * options_.lattice_step;
  double turn = M_PI / options_.headings;
  constexpr int kHalvings = 4;
  constexpr int kMovesPerStep = 4;
  for (int halving = 0; halving < kHalvings; ++halving, step *= 0.5, turn *= 0.5)
  {
    for (int move = 0; move < kMovesPerStep; ++move)
    {
      const TPose2D centre = best;
      const std::array<TPose2D, 6> neighbours = {TPose2D(centre.x + step, centre.y, centre.phi),
                                                 TPose2D(centre.x - step, centre.y, centre.phi),
                                                 TPose2D(centre.x, centre.y + step, centre.phi),
                                                 TPose2D(centre.x, centre.y - step, centre.phi),
                                                 TPose2D(centre.x, centre.y, centre.phi + turn),
                                                 TPose2D(centre.x, centre.y, centre.phi - turn)};
      bool moved = false;
      for (const TPose2D& pose : neighbours)
      {
        const double score = fineScore(pose, points);
        if (score <= best_score) continue;
        best = pose;
        best_score = score;
        moved = true;
      }
      if (!moved) break;
    }
  }
  Candidate candidate;
  candidate.pose.mean = {best.x, best.y, mrpt::math::wrapToPi(best.phi)};
  candidate.score = points.empty() ? 0 : best_score / (255.0 * static_cast<double>(points.size()));
  return candidate;
}

std::vector<Candidate> DenseSearchSpace::refineAndRank(const std::vector<LatticePose>& poses,
                                                       const std::vector<LaserScan>& scans) const
{
  const std::vector<TPoint2D> all = endPoints(scans);
  std::vector<TPoint2D> half;
  for (std::size_t i = 0; i < all.size(); i += 2) half.push_back(all[i]);
  std::vector<Candidate> refined;
  refined.reserve(poses.size());
  for (const LatticePose& pose : poses) refined.push_back(refine(poseOf(pose), half));
  std::stable_sort(refined.begin(), refined.end(),
                   [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
  return distinctCandidates(refined, options_.max_candidates);
}
}  // namespace sigloc

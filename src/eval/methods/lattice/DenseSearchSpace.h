// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPose2D.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "eval/methods/lattice/LikelihoodGrid.h"
#include "sigloc/features/LaserScan.h"
#include "sigloc/matching/SignatureMatcher.h"

namespace sigloc
{
/// The search that every dense baseline shares: its lattice of poses, its score, its refinement.
/// The values are those fixed for the reference; they are not tuned to a data set.
struct DenseSearchOptions
{
  double lattice_step = 0.2;  ///< [m]
  std::uint32_t headings = 120;  ///< over the full turn: 3 degrees
  std::uint32_t points = 50;  ///< evenly spaced end points that the lattice is scored with
  double coarse_sigma = 0.25;  ///< [m]
  double fine_sigma = 0.12;  ///< [m]
  std::uint32_t refined = 400;  ///< best lattice poses that are refined
  std::uint32_t max_candidates = 10;
  std::optional<PoseRegion> region;  ///< only poses inside
};

/// A pose of the lattice and its score: the sum of the likelihood values under the end points.
struct LatticePose
{
  std::uint32_t score = 0;
  std::uint32_t heading = 0;  ///< index
  std::uint32_t row = 0;  ///< lattice indices of the position
  std::uint32_t column = 0;
};

/// Best score first; ties by heading, row and column, so that every search returns the same list.
bool ranksBefore(const LatticePose& a, const LatticePose& b);

/// Where one end point falls, relative to the robot's cell, at one heading.
struct CellOffset
{
  std::int32_t dx = 0;
  std::int32_t dy = 0;
};

/// The poses of a map that dense baselines search, and how these are scored. Immutable.
class DenseSearchSpace
{
 public:
  /// Throws std::invalid_argument when the raster has no free cell inside the region.
  DenseSearchSpace(const OccupancyRaster& raster, const DenseSearchOptions& options);

  const DenseSearchOptions& options() const { return options_; }
  const LikelihoodGrid& coarse() const { return coarse_; }
  /// Map cell of each lattice column and row.
  const std::vector<std::int32_t>& columnCells() const { return column_cells_; }
  const std::vector<std::int32_t>& rowCells() const { return row_cells_; }
  /// 1 where the robot can be, row by row over the lattice.
  const std::vector<std::uint8_t>& freePlaces() const { return free_places_; }
  /// Headings that the region allows (indices).
  const std::vector<std::uint32_t>& headings() const { return headings_; }

  /// Returns the end points that the lattice is scored with, robot frame [m].
  std::vector<mrpt::math::TPoint2D> latticePoints(const std::vector<LaserScan>& scans) const;

  /// Returns where the points fall at a heading. Points that fall outside the map from everywhere
  /// are left out.
  std::vector<CellOffset> offsets(const std::vector<mrpt::math::TPoint2D>& points,
                                  std::uint32_t heading) const;

  mrpt::math::TPose2D poseOf(const LatticePose& pose) const;

  /// Refines lattice poses on the fine field with every second return of the scans, and returns
  /// ranked candidates more than 0.5 m or 17 degrees apart. Scores are means in [0, 1].
  std::vector<Candidate> refineAndRank(const std::vector<LatticePose>& poses,
                                       const std::vector<LaserScan>& scans) const;

 private:
  double fineScore(const mrpt::math::TPose2D& pose,
                   const std::vector<mrpt::math::TPoint2D>& points) const;
  Candidate refine(const mrpt::math::TPose2D& start,
                   const std::vector<mrpt::math::TPoint2D>& points) const;
  void layOutPlaces(const OccupancyRaster& raster);

  DenseSearchOptions options_;
  LikelihoodGrid coarse_;
  LikelihoodGrid fine_;
  std::vector<std::int32_t> column_cells_;
  std::vector<std::int32_t> row_cells_;
  std::vector<std::uint8_t> free_places_;
  std::vector<std::uint32_t> headings_;
};

/// Returns every free pose of a raster's lattice: positions `lattice_step` apart, `headings` each.
std::vector<mrpt::math::TPose2D> freeLatticePoses(const OccupancyRaster& raster,
                                                  const DenseSearchOptions& options);

/// Returns all valid returns of the scans in the robot frame [m].
std::vector<mrpt::math::TPoint2D> endPoints(const std::vector<LaserScan>& scans);

/// Keeps the first of all candidates that lie within 0.5 m and 17 degrees of each other.
std::vector<Candidate> distinctCandidates(const std::vector<Candidate>& ranked, std::size_t limit);
}  // namespace sigloc

// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/methods/lattice/best_lattice_poses.h"

#include "eval/methods/lattice/lattice_search.h"

namespace sigloc
{

namespace
{
struct Place
{
  std::size_t index;  // into the likelihood grid
  std::uint32_t row;
  std::uint32_t column;
};

std::vector<Place> freePlaceList(const DenseSearchSpace& space)
{
  std::vector<Place> places;
  std::size_t k = 0;
  for (std::uint32_t row = 0; row < space.rowCells().size(); ++row)
  {
    for (std::uint32_t column = 0; column < space.columnCells().size(); ++column, ++k)
    {
      if (!space.freePlaces()[k]) continue;
      places.push_back({space.coarse().indexOf(space.columnCells()[column], space.rowCells()[row]),
                        row, column});
    }
  }
  return places;
}
}  // namespace

LatticeSearchResult searchExhaustively(const DenseSearchSpace& space,
                                       const std::vector<mrpt::math::TPoint2D>& points)
{
  const std::vector<Place> places = freePlaceList(space);
  const std::uint8_t* values = space.coarse().values().data();
  detail::BestLatticePoses best(space.options().refined);
  LatticeSearchResult result;
  for (const std::uint32_t heading : space.headings())
  {
    const std::vector<std::ptrdiff_t> steps =
        detail::flatOffsets(space.offsets(points, heading), space.coarse().stride());
    const std::ptrdiff_t* first = steps.data();
    const std::ptrdiff_t* last = first + steps.size();
    for (const Place& place : places)
    {
      const std::uint8_t* cell = values + place.index;
      std::uint32_t score = 0;
      for (const std::ptrdiff_t* step = first; step != last; ++step) score += cell[*step];
      if (score >= best.threshold()) best.offer({score, heading, place.row, place.column});
    }
    result.poses_scored += places.size();
  }
  result.best = best.sorted();
  return result;
}
}  // namespace sigloc

// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include "bindings/arrays.h"
#include "bindings/bindings.h"
#include "io/maps/occupancy_grid.h"
#include "sigloc/io/map_files.h"

namespace sigloc::python
{
namespace py = pybind11;

namespace
{
using SharedMap = std::shared_ptr<FeatureMap>;

constexpr int kPercentOfWall = 100;
constexpr int kPercentOfBlur = 50;
constexpr int kPercentUnknown = -1;

SharedMap loadMap(const std::filesystem::path& path, double resolution,
                  const std::pair<double, double>& heights)
{
  ReadingOptions reading;
  reading.image_resolution = resolution;
  std::tie(reading.min_height, reading.max_height) = heights;
  SharedMap map;
  withFile([&]
           { map = std::make_shared<FeatureMap>(buildMapFromFile(path, {}, {}, {}, reading)); });
  return map;
}

/// The probability of a wall by a cell's number: a percentage of ROS where the array holds
/// integers, else the probability itself.
float occupiedOf(double cell, bool in_percent)
{
  if (!in_percent) return static_cast<float>(cell);
  if (cell == kPercentUnknown) return std::numeric_limits<float>::quiet_NaN();
  if (cell >= 0 && cell <= kPercentOfWall) return static_cast<float>(cell / kPercentOfWall);
  throw std::invalid_argument(
      fmt::format("a cell of {}: integers are -1 (unknown) or 0 to 100 percent", cell));
}

mrpt::math::TPose2D originOf(const Numbers& origin)
{
  if (origin.ndim() == 1 && origin.shape(0) == 2)
  {
    const auto values = origin.unchecked<1>();
    return {values(0), values(1), 0};
  }
  return poseOf(origin, "origin");
}

SharedMap mapFromGrid(const py::array& array, double resolution, const Numbers& origin)
{
  const char kind = array.dtype().kind();
  if (kind != 'i' && kind != 'u' && kind != 'f')
  {
    throw std::invalid_argument("array must hold integers or floats");
  }
  requireShape(array, {-1, -1}, "array");
  const Numbers cells(array);
  detail::OccupancyGrid grid;
  grid.height = static_cast<std::uint32_t>(cells.shape(0));
  grid.width = static_cast<std::uint32_t>(cells.shape(1));
  grid.resolution = resolution;
  grid.origin = originOf(origin);
  grid.occupied.reserve(static_cast<std::size_t>(cells.size()));
  for (py::ssize_t i = 0; i < cells.size(); ++i)
  {
    grid.occupied.push_back(occupiedOf(cells.data()[i], kind != 'f'));
  }
  const py::gil_scoped_release unlocked;
  return std::make_shared<FeatureMap>(buildMapFromRaster(detail::rasterOfOccupancy(grid)));
}

/// Noise spreads beams over cells in front of a wall and behind it. Where more passed than ended a
/// map saver writes no wall, and a wall there would be seen from the wrong place.
std::int8_t percentOf(CellState state)
{
  int percent = kPercentUnknown;
  if (state == CellState::free) percent = 0;
  if (state == CellState::wall) percent = kPercentOfBlur;
  if (state == CellState::solid_wall) percent = kPercentOfWall;
  return static_cast<std::int8_t>(percent);
}

const RasterFrame* frameOf(const FeatureMap& map)
{
  return map.field() ? &map.field()->frame : nullptr;
}

std::optional<py::array_t<std::int8_t>> gridOf(const FeatureMap& map)
{
  if (!map.field()) return std::nullopt;
  const RasterFrame& frame = map.field()->frame;
  py::array_t<std::int8_t> grid(
      {static_cast<py::ssize_t>(frame.height), static_cast<py::ssize_t>(frame.width)});
  std::int8_t* out = grid.mutable_data();
  std::fill_n(out, grid.size(), static_cast<std::int8_t>(kPercentUnknown));
  for (const StoredCells& stored : storedCells(*map.field()))
  {
    for (std::uint32_t y = 0; y < stored.height; ++y)
    {
      std::int8_t* to = out + (std::size_t{stored.y + y} * frame.width + stored.x);
      for (std::uint32_t x = 0; x < stored.width; ++x) to[x] = percentOf(stored.row(y)[x].state());
    }
  }
  return grid;
}

Numbers wallsOf(const FeatureMap& map)
{
  std::vector<mrpt::math::TPoint2D> ends;
  for (const Feature& feature : map.features())
  {
    if (!isSegment(feature.type)) continue;
    ends.push_back(segmentStart(feature));
    ends.push_back(segmentEnd(feature));
  }
  Numbers walls({static_cast<py::ssize_t>(ends.size() / 2), py::ssize_t{4}});
  double* out = walls.mutable_data();
  for (const mrpt::math::TPoint2D& end : ends)
  {
    *out++ = end.x;
    *out++ = end.y;
  }
  return walls;
}

std::string describe(const FeatureMap& map)
{
  return fmt::format("<sigloc.Map: {} features, {:.1f} m^2>", map.features().size(), map.area());
}
}  // namespace

void bindMaps(py::module_& module)
{
  py::class_<FeatureMap, SharedMap>(
      module, "Map",
      "The known map: walls, corners, pillars and landmarks, and where "
      "there is one the grid that scans are compared with. It never "
      "changes, and threads may share it.")
      .def_static(
          "load", &loadMap, py::arg("path"), py::kw_only(), py::arg("resolution") = 0.0,
          py::arg("heights") = std::pair(ReadingOptions().min_height, ReadingOptions().max_height),
          "Reads a map of any kind that sigloc-map takes: a ROS map (.yaml), .simplemap, "
          ".gridmap, CARMEN log, landmark table (.csv) or .sigmap. All but the last are "
          "built now, which takes seconds; save() keeps the result.\n\n"
          "resolution: [m] a pixel, for a map that is an image alone (.pgm, .png).\n"
          "heights: (low, high) [m] above the map's origin: which 3D points are walls.\n\n"
          "Raises OSError for a file that is missing, damaged or no map, ValueError for numbers "
          "out "
          "of range.")
      .def_static("from_grid", &mapFromGrid, py::arg("array"), py::arg("resolution"),
                  py::arg("origin") = py::make_tuple(0.0, 0.0),
                  "Builds the map of an occupancy grid.\n\n"
                  "array: shape (height, width), the lowest row first, as in ROS's OccupancyGrid. "
                  "Integers are percent, -1 where never seen; floats are the probability of a wall "
                  "in [0, 1], NaN where never seen.\n"
                  "resolution: size of a cell [m], in [0.005, 1].\n"
                  "origin: (x, y) or (x, y, heading) of the lower left corner in the map "
                  "[m, m, rad].\n\n"
                  "Raises ValueError for a grid that makes no map: without a wall or free cell, "
                  "beyond 100 km, or with other numbers.")
      .def(
          "save",
          [](const FeatureMap& map, const std::filesystem::path& path)
          { withFile([&] { saveSigmap(map, path); }); },
          py::arg("path"),
          "Writes a .sigmap, whole or not at all. Raises OSError where it cannot be written.")
      .def_property_readonly("area", &FeatureMap::area, "Area in which the robot can be [m^2].")
      .def_property_readonly("walls", &wallsOf,
                             "Mapped walls, shape (N, 4): x and y of both ends [m].")
      .def_property_readonly("grid", &gridOf,
                             "Cells, shape (height, width), the lowest row first: 100 is wall, 0 "
                             "free, -1 unknown, 50 where beams ended but more passed. None in a "
                             "map of landmarks.")
      .def_property_readonly(
          "resolution",
          [](const FeatureMap& map)
          { return frameOf(map) ? std::optional(frameOf(map)->resolution) : std::nullopt; },
          "Size of a cell of the grid [m], or None.")
      .def_property_readonly(
          "origin",
          [](const FeatureMap& map) -> std::optional<py::tuple>
          {
            const RasterFrame* const frame = frameOf(map);
            if (frame == nullptr) return std::nullopt;
            return py::make_tuple(frame->origin.x, frame->origin.y);
          },
          "Lower left corner (x, y) of the grid [m], or None.")
      .def_property_readonly(
          "warning",
          [](const FeatureMap& map)
          {
            const std::string warning = warningOfMap(map);
            return warning.empty() ? std::nullopt : std::optional(warning);
          },
          "A line on why no robot is likely to be found in this map, or None.")
      .def(
          "__len__", [](const FeatureMap& map) { return map.features().size(); },
          "Number of features.")
      .def("__repr__", &describe);
}
}  // namespace sigloc::python

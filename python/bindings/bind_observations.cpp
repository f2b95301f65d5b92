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
#include "bindings/observations.h"
#include "io/scan_conversion.h"
#include "sigloc/io/RawlogReader.h"

namespace sigloc::python
{
namespace py = pybind11;

namespace
{
using Ranges = py::array_t<float, py::array::c_style | py::array::forcecast>;

/// A planar pose, or (x, y, z, yaw, pitch, roll).
mrpt::poses::CPose3D mountOf(const Numbers& pose)
{
  if (pose.ndim() == 1 && pose.shape(0) == 6)
  {
    const auto v = pose.unchecked<1>();
    return {v(0), v(1), v(2), v(3), v(4), v(5)};
  }
  const mrpt::math::TPose2D planar = poseOf(pose, "pose");
  return {planar.x, planar.y, 0, planar.phi, 0, 0};
}

LaserScan makeScan(const Ranges& ranges, double angle_min, double angle_increment, double range_min,
                   double range_max, const Numbers& pose, double sigma)
{
  requireShape(ranges, {-1}, "ranges");
  RangeReadings readings;
  readings.ranges.assign(ranges.data(), ranges.data() + ranges.size());
  readings.first_angle = angle_min;
  readings.angle_step = angle_increment;
  readings.min_range = range_min;
  readings.max_range = range_max;
  readings.range_sigma = sigma;
  readings.robot_from_sensor = mountOf(pose);
  return toLaserScan(readings);
}

Ranges rangesOf(const LaserScan& scan)
{
  Ranges ranges(static_cast<py::ssize_t>(scan.ranges.size()));
  for (std::size_t i = 0; i < scan.ranges.size(); ++i)
  {
    const float nothing = std::numeric_limits<float>::quiet_NaN();
    ranges.mutable_data()[i] = scan.valid[i] != 0 ? scan.ranges[i] : nothing;
  }
  return ranges;
}

Numbers pointsOf(const LaserScan& scan)
{
  const std::vector<BeamEnd> beams = observeScene({scan}).beams;
  Numbers points({static_cast<py::ssize_t>(beams.size()), py::ssize_t{2}});
  double* out = points.mutable_data();
  for (const BeamEnd& beam : beams)
  {
    *out++ = beam.point.x;
    *out++ = beam.point.y;
  }
  return points;
}

Landmarks makeLandmarks(const Numbers& positions, double sigma)
{
  requireShape(positions, {-1, 2}, "positions");
  if (!(sigma > 0 && sigma <= 100)) throw std::invalid_argument("sigma is not within (0, 100] m");
  Landmarks landmarks;
  const auto values = positions.unchecked<2>();
  for (py::ssize_t i = 0; i < values.shape(0); ++i)
  {
    Feature point;
    point.type = FeatureType::point;
    point.position = {values(i, 0), values(i, 1)};
    if (!std::isfinite(point.position.x) || !std::isfinite(point.position.y))
    {
      throw std::invalid_argument(fmt::format("the position of landmark {} is no number", i));
    }
    point.position_covariance(0, 0) = point.position_covariance(1, 1) = sigma * sigma;
    landmarks.features.push_back(point);
  }
  return landmarks;
}

Numbers positionsOf(const Landmarks& landmarks)
{
  Numbers positions({static_cast<py::ssize_t>(landmarks.features.size()), py::ssize_t{2}});
  double* out = positions.mutable_data();
  for (const Feature& feature : landmarks.features)
  {
    *out++ = feature.position.x;
    *out++ = feature.position.y;
  }
  return positions;
}

py::list observationsOf(const RawlogStep& step)
{
  py::list observations;
  for (const LaserScan& scan : step.scans) observations.append(py::cast(scan));
  if (!step.landmarks.empty()) observations.append(py::cast(Landmarks{step.landmarks}));
  return observations;
}

std::unique_ptr<RawlogReader> openLog(const std::filesystem::path& path,
                                      const std::pair<double, double>& heights)
{
  ReadingOptions reading;
  std::tie(reading.min_height, reading.max_height) = heights;
  std::unique_ptr<RawlogReader> log;
  withFile([&] { log = std::make_unique<RawlogReader>(path, reading); });
  return log;
}

void bindScans(py::module_& module)
{
  py::class_<LaserScan>(module, "Scan", "One scan of a planar laser.")
      .def(
          py::init(&makeScan), py::arg("ranges"), py::arg("angle_min"), py::arg("angle_increment"),
          py::kw_only(), py::arg("range_min") = 0.0,
          py::arg("range_max") = std::numeric_limits<double>::infinity(),
          py::arg("pose") = py::make_tuple(0.0, 0.0, 0.0), py::arg("sigma") = kDefaultRangeSigma,
          "ranges: shape (N,) [m], at least 2; NaN, infinite, below range_min or from range_max on "
          "is no return.\n"
          "angle_min: of the first beam in the sensor's frame [rad]; angle_increment: from beam to "
          "beam [rad], negative for a clockwise scan.\n"
          "pose: of the sensor on the robot, (x, y, heading) [m, m, rad], or (x, y, z, yaw, pitch, "
          "roll): a roll of pi is upside down.\n"
          "sigma: standard deviation of a range [m].\n\n"
          "Raises ValueError for other shapes, for numbers that are not usable, and for a sensor "
          "tilted by more than 10 degrees.")
      .def_property_readonly("ranges", &rangesOf,
                             "Shape (N,), float32 [m], counter-clockwise; NaN where nothing came "
                             "back.")
      .def_readonly("angle_min", &LaserScan::first_angle, "[rad], of the first beam.")
      .def_readonly("angle_increment", &LaserScan::angle_step, "[rad], positive.")
      .def_readonly("range_max", &LaserScan::max_range, "[m]")
      .def_readonly("sigma", &LaserScan::range_sigma, "[m]")
      .def_property_readonly(
          "pose", [](const LaserScan& scan) { return arrayOf(scan.robot_from_sensor); },
          "Shape (3,): x, y, heading of the sensor on the robot [m, m, rad].")
      .def_property_readonly("points", &pointsOf,
                             "Ends of the beams that came back in the robot's frame, shape (M, 2) "
                             "[m].")
      .def(
          "__len__", [](const LaserScan& scan) { return scan.ranges.size(); }, "Number of beams.")
      .def("__repr__", [](const LaserScan& scan)
           { return fmt::format("<sigloc.Scan: {} beams>", scan.ranges.size()); });
}

void bindLandmarks(py::module_& module)
{
  py::class_<Landmarks>(module, "Landmarks", "Landmarks seen in one step, without identities.")
      .def(py::init(&makeLandmarks), py::arg("positions"), py::kw_only(), py::arg("sigma") = 0.05,
           "positions: shape (N, 2), in the robot's frame [m]; sigma: standard deviation of a "
           "coordinate [m].\n\n"
           "Raises ValueError for other shapes and for numbers that are not finite.")
      .def_property_readonly("positions", &positionsOf, "Shape (N, 2) [m], in the robot's frame.")
      .def(
          "__len__", [](const Landmarks& landmarks) { return landmarks.features.size(); },
          "Number of landmarks.")
      .def("__repr__", [](const Landmarks& landmarks)
           { return fmt::format("<sigloc.Landmarks: {}>", landmarks.features.size()); });
}

void bindLogs(py::module_& module)
{
  py::class_<RawlogStep>(module, "Step", "One step of a log.")
      .def_readonly("time", &RawlogStep::time, "[s], of the log's clock.")
      .def_property_readonly(
          "motion",
          [](const RawlogStep& step)
          { return step.motion ? std::optional(arrayOf(step.motion->mean)) : std::nullopt; },
          "Motion since the step before in that step's frame, shape (3,) [m, m, rad]. None where "
          "the "
          "log has no odometry.")
      .def_property_readonly(
          "motion_covariance",
          [](const RawlogStep& step) {
            return step.motion ? std::optional(arrayOfMatrix(step.motion->covariance))
                               : std::nullopt;
          },
          "Shape (3, 3) [m^2, m rad, rad^2], or None.")
      .def_property_readonly("observations", &observationsOf,
                             "What was seen: Scan and Landmarks, for Localizer.localize() and "
                             "Tracker.step().");
  py::class_<RawlogReader>(module, "Log", "A rawlog, read step by step: `for step in Log(path)`.")
      .def(py::init(&openLog), py::arg("path"), py::kw_only(),
           py::arg("heights") = std::pair(ReadingOptions().min_height, ReadingOptions().max_height),
           "heights: (low, high) [m] above the robot's base: which points of depth cameras, "
           "Velodynes and clouds are walls.\n\n"
           "Raises OSError for a file that is missing, damaged or no rawlog.")
      .def("__iter__", [](py::object self) { return self; })
      .def("__next__",
           [](RawlogReader& log)
           {
             std::optional<RawlogStep> step;
             withFile([&] { step = log.next(); });
             if (!step) throw py::stop_iteration();
             return *step;
           })
      .def_property_readonly("truncated", &RawlogReader::truncated,
                             "True when reading ended before the end of the file.");
}
}  // namespace

ObservedScene sceneOf(const py::object& observations)
{
  std::vector<LaserScan> scans;
  std::vector<Feature> landmarks;
  const auto take = [&](const py::handle& observation)
  {
    if (py::isinstance<LaserScan>(observation))
    {
      scans.push_back(observation.cast<const LaserScan&>());
      return true;
    }
    if (!py::isinstance<Landmarks>(observation)) return false;
    const auto& seen = observation.cast<const Landmarks&>().features;
    landmarks.insert(landmarks.end(), seen.begin(), seen.end());
    return true;
  };
  if (!take(observations))
  {
    for (const py::handle& observation : observations)
    {
      if (!take(observation)) throw py::type_error("observations must be Scan or Landmarks");
    }
  }
  const py::gil_scoped_release unlocked;
  return observeScene(scans, landmarks);
}

void bindObservations(py::module_& module)
{
  bindScans(module);
  bindLandmarks(module);
  bindLogs(module);
}
}  // namespace sigloc::python

// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/serialization/CArchive.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <exception>
#include <stdexcept>
#include <string>
#include <utility>

#include "bindings/arrays.h"
#include "bindings/bindings.h"
#include "io/scan_conversion.h"
#include "sigloc/io/file_output.h"

namespace sigloc::python
{
namespace py = pybind11;

namespace
{
mrpt::obs::CObservation::Ptr observationOf(const py::handle& seen, double time)
{
  if (py::isinstance<LaserScan>(seen)) return toRangeScan(seen.cast<const LaserScan&>(), time);
  const mrpt::math::TPose2D pose = poseOf(seen.cast<Numbers>(), "odometry");
  if (!std::isfinite(pose.x) || !std::isfinite(pose.y) || !std::isfinite(pose.phi))
  {
    throw std::invalid_argument("odometry is not finite");
  }
  auto reading = mrpt::obs::CObservationOdometry::Create();
  reading->timestamp = mrpt::Clock::fromDouble(time);
  reading->odometry = mrpt::poses::CPose2D(pose);
  return reading;
}

/// Returns how many scans and how many odometry readings were written.
std::pair<std::size_t, std::size_t> writeLog(const std::filesystem::path& path,
                                             const py::iterable& entries)
{
  std::size_t scans = 0;
  std::size_t readings = 0;
  // What an entry raises must come out as it is, not as an error of the file.
  std::exception_ptr raised;
  const auto write = [&](mrpt::serialization::CArchive& archive)
  {
    try
    {
      for (const py::handle& entry : entries)
      {
        const auto [time, seen, label] = entry.cast<std::tuple<double, py::object, std::string>>();
        if (!std::isfinite(time) || time < 0 || time > 1e11)
        {
          throw std::invalid_argument(fmt::format("a time of {} s", time));
        }
        const auto observation = observationOf(seen, time);
        observation->sensorLabel = label;
        archive << *observation;
        ++(py::isinstance<LaserScan>(seen) ? scans : readings);
      }
    }
    catch (...)
    {
      raised = std::current_exception();
      throw std::runtime_error("an entry that cannot be written");
    }
  };
  try
  {
    writeObjects(path, write);
  }
  catch (const std::runtime_error& error)
  {
    if (raised) std::rethrow_exception(raised);
    PyErr_SetString(PyExc_OSError, oneLine(error.what()).c_str());
    throw py::error_already_set();
  }
  return {scans, readings};
}
}  // namespace

void bindLogWriting(py::module_& module)
{
  module.def(
      "write_log", &writeLog, py::arg("path"), py::arg("entries"),
      "Writes a rawlog of observations, whole or not at all, and returns how many scans and "
      "how many odometry readings are in it.\n\n"
      "entries: (time, seen, label) in the order of time: time in seconds since 1970; seen a "
      "Scan, or the robot's pose by odometry, (x, y, heading) [m, m, rad]; label of the "
      "sensor.\n\n"
      "Raises ValueError for values that are not usable, and OSError where the file cannot "
      "be written.");
}
}  // namespace sigloc::python

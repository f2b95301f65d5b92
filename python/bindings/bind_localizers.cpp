// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>

#include <cmath>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>

#include "bindings/arrays.h"
#include "bindings/bindings.h"
#include "bindings/observations.h"
#include "bindings/options.h"
#include "bindings/results.h"
#include "io/motion_conversion.h"
#include "sigloc/matching/SignatureMatcher.h"
#include "sigloc/tracking/HypothesisTracker.h"

namespace sigloc::python
{
namespace py = pybind11;

namespace
{
using SharedMatcher = std::shared_ptr<SignatureMatcher>;

SharedMatcher makeLocalizer(const std::shared_ptr<FeatureMap>& map, const py::kwargs& keywords)
{
  const auto options = optionsOf<MatcherOptions>(keywords);
  const py::gil_scoped_release unlocked;
  return std::make_shared<SignatureMatcher>(map, options);
}

Answer localize(const SignatureMatcher& matcher, const py::object& observations,
                const std::optional<PoseRegion>& region)
{
  const ObservedScene scene = sceneOf(observations);
  const py::gil_scoped_release unlocked;
  return answerOf(matcher.localize(scene, region));
}

PoseRegion makeRegion(double x_min, double x_max, double y_min, double y_max, double heading,
                      double heading_tolerance)
{
  if (!(x_min < x_max && y_min < y_max && heading_tolerance > 0 && std::isfinite(heading)))
  {
    throw std::invalid_argument(
        "a region needs x_min < x_max, y_min < y_max, a finite heading and "
        "a heading_tolerance above 0");
  }
  return {x_min, x_max, y_min, y_max, heading, heading_tolerance};
}

/// HypothesisTracker is not thread-safe, and Python's threads may share a Tracker.
class LockedTracker
{
 public:
  LockedTracker(const SharedMatcher& localizer, const TrackerOptions& options)
      : tracker_(localizer, options)
  {
  }

  Answer step(const std::optional<MotionIncrement>& motion, const ObservedScene& scene)
  {
    const std::lock_guard<std::mutex> alone(mutex_);
    return answerOf(tracker_.step(motion, scene));
  }

  Answer answer()
  {
    const std::lock_guard<std::mutex> alone(mutex_);
    return answerOf(tracker_.belief());
  }

  bool relocated()
  {
    const std::lock_guard<std::mutex> alone(mutex_);
    return tracker_.relocated();
  }

  void reset(const std::optional<PoseRegion>& region)
  {
    const std::lock_guard<std::mutex> alone(mutex_);
    tracker_.reset(region);
  }

 private:
  std::mutex mutex_;
  HypothesisTracker tracker_;
};

std::optional<MotionIncrement> motionOf(const std::optional<Numbers>& mean,
                                        const std::optional<Numbers>& covariance)
{
  if (!mean)
  {
    if (covariance) throw std::invalid_argument("motion_covariance without a motion");
    return std::nullopt;
  }
  const mrpt::math::TPose2D pose = poseOf(*mean, "motion");
  if (!std::isfinite(pose.x) || !std::isfinite(pose.y) || !std::isfinite(pose.phi))
  {
    throw std::invalid_argument("motion is not finite");
  }
  if (covariance) return MotionIncrement{pose, covarianceOf(*covariance, "motion_covariance")};
  return detail::toMotionIncrement(detail::motionFromOdometry(mrpt::poses::CPose2D(pose)));
}

Answer stepTracker(LockedTracker& tracker, const py::object& observations,
                   const std::optional<Numbers>& motion, const std::optional<Numbers>& covariance)
{
  const std::optional<MotionIncrement> increment = motionOf(motion, covariance);
  const ObservedScene scene = sceneOf(observations);
  const py::gil_scoped_release unlocked;
  return tracker.step(increment, scene);
}

void bindRegion(py::module_& module)
{
  py::class_<PoseRegion>(module, "Region", "Where the robot may be: a box and a range of headings.")
      .def(py::init(&makeRegion), py::arg("x_min"), py::arg("x_max"), py::arg("y_min"),
           py::arg("y_max"), py::arg("heading") = 0.0, py::arg("heading_tolerance") = M_PI,
           "In the map's frame [m, rad]. Raises ValueError for an empty one.")
      .def_readonly("x_min", &PoseRegion::x_min, "[m]")
      .def_readonly("x_max", &PoseRegion::x_max, "[m]")
      .def_readonly("y_min", &PoseRegion::y_min, "[m]")
      .def_readonly("y_max", &PoseRegion::y_max, "[m]")
      .def_readonly("heading", &PoseRegion::heading, "[rad]")
      .def_readonly("heading_tolerance", &PoseRegion::heading_tolerance, "[rad]");
}

void bindLocalizer(py::module_& module)
{
  const std::string options = describeOptions<MatcherOptions>(
      "Builds the indices of a map, once. Keywords are options; ValueError for one outside its "
      "range:\n");
  py::class_<SignatureMatcher, SharedMatcher>(
      module, "Localizer", "Finds the poses in a map that explain one scan. Threads may share it.")
      .def(py::init(&makeLocalizer), py::arg("map").none(false), options.c_str())
      .def("localize", &localize, py::arg("observations"), py::arg("region") = py::none(),
           "Returns the Answer to what is seen from one place.\n\n"
           "observations: a Scan, a Landmarks, or a sequence of these.\n"
           "region: a Region that the robot is in, if that is known.");
}

void bindTracker(py::module_& module)
{
  const std::string options = describeOptions<TrackerOptions>(
      "Starts anywhere in the localizer's map. Keywords are options; ValueError for one outside "
      "its "
      "range:\n");
  py::class_<LockedTracker>(module, "Tracker",
                            "Follows every possible pose until one is left, and notices when the "
                            "robot is lost.")
      .def(py::init(
               [](const SharedMatcher& localizer, const py::kwargs& keywords) {
                 return std::make_unique<LockedTracker>(localizer,
                                                        optionsOf<TrackerOptions>(keywords));
               }),
           py::arg("localizer").none(false), options.c_str())
      .def(
          "step", &stepTracker, py::arg("observations"), py::arg("motion") = py::none(),
          py::arg("motion_covariance") = py::none(),
          "Advances by one step and returns the Answer after it.\n\n"
          "observations: a Scan, a Landmarks, or a sequence of these.\n"
          "motion: since the step before, in the frame of the robot then, shape (3,) [m, m, rad]. "
          "None where odometry is unknown; a wide prior is used.\n"
          "motion_covariance: shape (3, 3) [m^2, m rad, rad^2]; None: by MRPT's odometry model.\n\n"
          "Raises ValueError for other shapes, numbers that are not finite, or a matrix that is no "
          "covariance; all stays as it was.")
      .def_property_readonly("answer", &LockedTracker::answer, "After the latest step.")
      .def_property_readonly("relocated", &LockedTracker::relocated,
                             "True when the last step ran a relocation.")
      .def("reset", &LockedTracker::reset, py::arg("region") = py::none(),
           py::call_guard<py::gil_scoped_release>(),
           "Forgets everything: the robot may be anywhere, or in a Region.");
}
}  // namespace

void bindLocalizers(py::module_& module)
{
  bindRegion(module);
  bindLocalizer(module);
  bindTracker(module);
}
}  // namespace sigloc::python

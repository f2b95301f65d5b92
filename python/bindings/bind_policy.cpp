// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "bindings/arrays.h"
#include "bindings/bindings.h"
#include "bindings/options.h"
#include "bindings/results.h"
#include "localize/RelocalizationPolicy.h"

namespace sigloc::python
{
namespace py = pybind11;

namespace
{
/// What the policy reads of a belief.
Belief beliefOf(const Answer& answer)
{
  Belief belief;
  belief.verdict = answer.verdict;
  belief.probability = answer.probability;
  belief.elsewhere = answer.elsewhere;
  belief.reason = answer.reason;
  for (const Hypothesis& hypothesis : answer.hypotheses)
  {
    belief.hypotheses.push_back({hypothesis.pose, hypothesis.probability, hypothesis.id.value_or(0),
                                 hypothesis.age.value_or(0)});
  }
  return belief;
}

/// What the policy reads of the answer to one scan.
RelocationResult resultOf(const Answer& answer)
{
  RelocationResult result;
  for (const Hypothesis& hypothesis : answer.hypotheses)
  {
    Candidate candidate;
    candidate.pose = hypothesis.pose;
    candidate.probability = hypothesis.probability;
    result.candidates.push_back(candidate);
  }
  return result;
}

std::optional<mrpt::math::TPose2D> optionalPose(const std::optional<Numbers>& pose,
                                                const char* what)
{
  return pose ? std::optional(poseOf(*pose, what)) : std::nullopt;
}

PolicyDecision update(RelocalizationPolicy& policy, double time, const Answer& answer,
                      const std::optional<Numbers>& motion,
                      const std::optional<Numbers>& filter_pose,
                      const std::function<Answer()>& localize_alone)
{
  PolicyStep step;
  step.time = time;
  step.belief = beliefOf(answer);
  step.motion = optionalPose(motion, "motion");
  step.filter_pose = optionalPose(filter_pose, "filter_pose");
  if (localize_alone) step.localize_alone = [&] { return resultOf(localize_alone()); };
  return policy.update(step);
}

void bindDecision(py::module_& module)
{
  py::class_<PolicyDecision>(module, "Decision", "What is to be done after a step.")
      .def_property_readonly(
          "state", [](const PolicyDecision& decision) { return toString(decision.state); },
          "\"searching\", \"confirming\" (localized, but not for long enough), \"known\", or "
          "\"holding\" (known a moment ago).")
      .def_property_readonly(
          "pose",
          [](const PolicyDecision& decision) -> std::optional<Numbers>
          {
            if (!decision.pose) return std::nullopt;
            return arrayOf(decision.pose->mean);
          },
          "Shape (3,): of the robot in the map [m, m, rad]; it may be used. None unless the state "
          "is \"known\".")
      .def_property_readonly(
          "covariance",
          [](const PolicyDecision& decision) -> std::optional<Numbers>
          {
            if (!decision.pose) return std::nullopt;
            return arrayOfMatrix(decision.pose->covariance);
          },
          "Shape (3, 3), of the pose [m^2, m rad, rad^2], or None.")
      .def_readonly("announce", &PolicyDecision::announce, "Give the pose to the filter now.")
      .def_readonly("restart", &PolicyDecision::restart, "Search from nothing: Tracker.reset().")
      .def_readonly("alarm", &PolicyDecision::alarm, "Given up: a person must look.")
      .def_readonly("message", &PolicyDecision::message, "One line for people.");
}
}  // namespace

void bindPolicy(py::module_& module)
{
  bindDecision(module);
  const std::string options = describeOptions<RelocalizationPolicyOptions>(
      "Keywords are options; ValueError for one outside its range:\n");
  py::class_<RelocalizationPolicy>(
      module, "Policy",
      "Decides which of a Tracker's answers a robot may use: when the pose is known, when it is "
      "given to another filter, when a search starts again, and when it is given up. For one "
      "thread.")
      .def(py::init(
               [](const py::kwargs& keywords)
               {
                 return std::make_unique<RelocalizationPolicy>(
                     optionsOf<RelocalizationPolicyOptions>(keywords));
               }),
           options.c_str())
      .def("update", &update, py::arg("time"), py::arg("answer"), py::arg("motion") = py::none(),
           py::arg("filter_pose") = py::none(), py::arg("localize_alone") = py::none(),
           "Returns the Decision after a step.\n\n"
           "time: [s], not before that of the last step.\n"
           "answer: of the Tracker.\n"
           "motion: as the Tracker got it, shape (3,) [m, m, rad]; None where it is unknown.\n"
           "filter_pose: of the robot in the map, by the filter that poses are given to, shape "
           "(3,) [m, m, rad]; None without one.\n"
           "localize_alone: returns the Localizer's Answer to the step's observations. It is "
           "called where a pose must be cross-checked, at most once.\n\n"
           "Raises ValueError for a time that is no number or goes back.")
      .def("request_restart", &RelocalizationPolicy::requestRestart,
           "A person asks for a search from nothing. The next Decision says so.");
}
}  // namespace sigloc::python

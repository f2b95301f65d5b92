// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "bindings/results.h"

#include <fmt/format.h>
#include <mrpt/core/bits_math.h>
#include <pybind11/stl.h>

#include "bindings/arrays.h"
#include "bindings/bindings.h"

namespace sigloc::python
{
namespace py = pybind11;

namespace
{
std::string describeHypothesis(const Hypothesis& hypothesis)
{
  const mrpt::math::TPose2D& mean = hypothesis.pose.mean;
  return fmt::format("<sigloc.Hypothesis: ({:.2f} m, {:.2f} m, {:.1f} deg), {}>", mean.x, mean.y,
                     mrpt::RAD2DEG(mean.phi), probabilityText(hypothesis.probability));
}

Numbers posesOf(const Answer& answer)
{
  Numbers poses({static_cast<py::ssize_t>(answer.hypotheses.size()), py::ssize_t{3}});
  double* out = poses.mutable_data();
  for (const Hypothesis& hypothesis : answer.hypotheses)
  {
    *out++ = hypothesis.pose.mean.x;
    *out++ = hypothesis.pose.mean.y;
    *out++ = hypothesis.pose.mean.phi;
  }
  return poses;
}

Numbers covariancesOf(const Answer& answer)
{
  const auto count = static_cast<py::ssize_t>(answer.hypotheses.size());
  Numbers covariances({count, py::ssize_t{3}, py::ssize_t{3}});
  double* out = covariances.mutable_data();
  for (const Hypothesis& hypothesis : answer.hypotheses)
  {
    for (int r = 0; r < 3; ++r)
    {
      for (int c = 0; c < 3; ++c) *out++ = hypothesis.pose.covariance(r, c);
    }
  }
  return covariances;
}

Numbers probabilitiesOf(const Answer& answer)
{
  Numbers probabilities(static_cast<py::ssize_t>(answer.hypotheses.size()));
  double* out = probabilities.mutable_data();
  for (const Hypothesis& hypothesis : answer.hypotheses) *out++ = hypothesis.probability;
  return probabilities;
}

void bindVerdict(py::module_& module)
{
  py::enum_<Verdict> verdict(module, "Verdict", "What is claimed about the robot's pose.");
  verdict
      .value("LOCALIZED", Verdict::localized, "one pose holds, with a probability of 0.99 or more")
      .value("AMBIGUOUS", Verdict::ambiguous, "several poses are possible: do not use the first")
      .value("NOT_HERE", Verdict::not_here, "nothing in this map explains what is seen")
      .value("TOO_LITTLE_SEEN", Verdict::too_little_seen, "the laser returns too little");
  // The one that enum_ has is "Verdict.LOCALIZED".
  verdict.attr("__str__") = py::cpp_function([](Verdict value) { return toString(value); },
                                             py::name("__str__"), py::is_method(verdict));
}

void bindHypothesis(py::module_& module)
{
  py::class_<Hypothesis>(module, "Hypothesis", "A pose that the robot may be at.")
      .def_property_readonly(
          "pose", [](const Hypothesis& hypothesis) { return arrayOf(hypothesis.pose.mean); },
          "Shape (3,): x, y and heading of the robot in the map [m, m, rad], heading in "
          "(-pi, pi].")
      .def_property_readonly(
          "covariance",
          [](const Hypothesis& hypothesis) { return arrayOfMatrix(hypothesis.pose.covariance); },
          "Shape (3, 3), of x, y and heading in the map [m^2, m rad, rad^2].")
      .def_readonly("probability", &Hypothesis::probability, "In [0, 1].")
      .def_readonly("id", &Hypothesis::id,
                    "The same from step to step of a tracker; None in the answer to one scan.")
      .def_readonly("age", &Hypothesis::age,
                    "Steps since a tracker has it; None in the answer to one scan.")
      .def("__repr__", &describeHypothesis);
}

void bindAnswer(py::module_& module)
{
  py::class_<Answer>(module, "Answer",
                     "Where the robot may be: hypotheses, the most probable first, and a verdict.")
      .def_readonly("verdict", &Answer::verdict, "A Verdict.")
      .def_readonly("probability", &Answer::probability, "Of the verdict's claim, in [0, 1].")
      .def_readonly("elsewhere", &Answer::elsewhere,
                    "Probability that the robot is at none of the hypotheses, in [0, 1].")
      .def_readonly("reason", &Answer::reason,
                    "A tracker's line on why it is not sure; empty in the answer to one scan.")
      .def_readonly("hypotheses", &Answer::hypotheses, "List of Hypothesis.")
      .def_property_readonly("poses", &posesOf, "Shape (N, 3), of all hypotheses [m, m, rad].")
      .def_property_readonly("covariances", &covariancesOf, "Shape (N, 3, 3) [m^2, m rad, rad^2].")
      .def_property_readonly("probabilities", &probabilitiesOf, "Shape (N,), each in [0, 1].")
      .def("__repr__",
           [](const Answer& answer)
           {
             return fmt::format("<sigloc.Answer: {} ({}), {} hypotheses>", toString(answer.verdict),
                                probabilityText(answer.probability), answer.hypotheses.size());
           });
}
}  // namespace

Answer answerOf(const RelocationResult& result)
{
  Answer answer{result.verdict, result.probability, result.elsewhere, {}, {}};
  for (const Candidate& candidate : result.candidates)
  {
    answer.hypotheses.push_back({candidate.pose, candidate.probability, {}, {}});
  }
  return answer;
}

Answer answerOf(const Belief& belief)
{
  Answer answer{belief.verdict, belief.probability, belief.elsewhere, belief.reason, {}};
  for (const TrackedHypothesis& tracked : belief.hypotheses)
  {
    answer.hypotheses.push_back({tracked.pose, tracked.weight, tracked.id, tracked.age});
  }
  return answer;
}

void bindResults(py::module_& module)
{
  bindVerdict(module);
  module.def("probability_text", &probabilityText, py::arg("probability"), py::arg("digits") = 3,
             "A probability for people, never rounded up: 0.9896 is no 0.99.");
  bindHypothesis(module);
  bindAnswer(module);
}
}  // namespace sigloc::python

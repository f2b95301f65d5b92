// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/core/bits_math.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/serialization/CArchive.h>

#include <nlohmann/json.hpp>

#include "io/LogObjects.h"
#include "sigloc/io/file_output.h"
#include "sigloc/localize/RunWriter.h"
#include "sigloc/plugin/pose_pdf.h"

namespace sigloc
{
namespace
{
using mrpt::serialization::CArchive;

nlohmann::ordered_json toJson(const TrackedHypothesis& hypothesis)
{
  const GaussianPose& pose = hypothesis.pose;
  nlohmann::ordered_json json = {{"probability", hypothesis.weight},
                                 {"x", pose.mean.x},
                                 {"y", pose.mean.y},
                                 {"phi_deg", mrpt::RAD2DEG(pose.mean.phi)}};
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      json["covariance"].push_back(pose.covariance(row, column));
    }
  }
  return json;
}

nlohmann::ordered_json toJson(const Feature& feature)
{
  nlohmann::ordered_json json = {
      {"type", traitsOf(feature.type).name}, {"x", feature.position.x}, {"y", feature.position.y}};
  if (hasDirection(feature.type)) json["direction_deg"] = mrpt::RAD2DEG(feature.direction);
  if (hasSize(feature.type)) json[traitsOf(feature.type).size_name] = feature.size;
  return json;
}

/// What is believed at a step, as text that people and programs read without our plug-in.
mrpt::obs::CObservationComment::Ptr beliefComment(const StepRecord& step)
{
  const Belief& belief = step.belief;
  nlohmann::ordered_json json = {{"source", "sigloc"},
                                 {"verdict", toString(belief.verdict)},
                                 {"first_pose_probability", nullptr},
                                 {"elsewhere", belief.elsewhere},
                                 {"reason", belief.reason},
                                 {"hypotheses", nlohmann::ordered_json::array()},
                                 {"features", nlohmann::ordered_json::array()}};
  if (!belief.hypotheses.empty()) json["first_pose_probability"] = belief.probabilityOfFirst();
  for (const auto& hypothesis : belief.hypotheses) json["hypotheses"].push_back(toJson(hypothesis));
  for (const Feature& feature : step.features) json["features"].push_back(toJson(feature));
  auto comment = mrpt::obs::CObservationComment::Create();
  comment->timestamp = mrpt::Clock::fromDouble(step.time);
  comment->text = json.dump(1);
  return comment;
}

/// What is added to the log at a step.
std::vector<mrpt::obs::CObservation::Ptr> observationsOf(const StepRecord& step,
                                                         const GaussianPose& anywhere)
{
  std::vector<mrpt::obs::CObservation::Ptr> all;
  if (!step.belief.hypotheses.empty())
  {
    all.push_back(toRobotPoseObservation(step.belief, anywhere, step.time));
  }
  all.push_back(beliefComment(step));
  return all;
}

void annotate(detail::LogObjects& log, const LocalizationRun& run, CArchive& archive)
{
  const std::vector<StepRecord>& steps = run.steps();
  auto step = steps.begin();
  std::size_t entry = 0;
  while (const auto object = log.next())
  {
    std::vector<mrpt::obs::CObservation::Ptr> added;
    if (step != steps.end() && step->entry == entry)
    {
      added = observationsOf(*step, run.anywhere());
      ++step;
    }
    const auto frame = std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(object);
    if (frame)
    {
      for (const auto& observation : added) frame->insert(observation);
      added.clear();
    }
    archive << *object;
    for (const auto& observation : added) archive << *observation;
    ++entry;
  }
}
}  // namespace

void writeAnnotatedRawlog(const LocalizationRun& run, const std::filesystem::path& output,
                          Durability durability)
{
  detail::LogObjects log(run.setup().rawlog_file);
  writeObjects(
      output, [&](CArchive& archive) { annotate(log, run, archive); }, Packing::quick_gzip,
      durability);
}
}  // namespace sigloc

// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/serialization/CArchive.h>

#include <exception>

#include "io/gzip_input.h"
#include "sigloc/io/file_output.h"
#include "sigloc/localize/RunWriter.h"
#include "sigloc/plugin/pose_pdf.h"

namespace sigloc
{
namespace
{
using mrpt::serialization::CArchive;

/// Returns the log's next object, or null at its end or where it cannot be read any further.
mrpt::serialization::CSerializable::Ptr nextObject(detail::GzipInput& input)
{
  try
  {
    if (input.atEnd()) return nullptr;
    return mrpt::serialization::archiveFrom(input).ReadObject();
  }
  catch (const std::exception&)
  {
    return nullptr;
  }
}

void annotate(detail::GzipInput& input, const std::vector<StepRecord>& steps, CArchive& archive)
{
  auto step = steps.begin();
  std::size_t entry = 0;
  while (const auto object = nextObject(input))
  {
    mrpt::obs::CObservationRobotPose::Ptr pose;
    if (step != steps.end() && step->entry == entry)
    {
      if (!step->belief.hypotheses.empty())
      {
        pose = toRobotPoseObservation(step->belief, step->time);
      }
      ++step;
    }
    const auto frame = std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(object);
    if (frame && pose) frame->insert(pose);
    archive << *object;
    if (!frame && pose) archive << *pose;
    ++entry;
  }
}
}  // namespace

void writeAnnotatedRawlog(const std::filesystem::path& rawlog, const std::vector<StepRecord>& steps,
                          const std::filesystem::path& output)
{
  detail::GzipInput input(rawlog);
  writeObjects(output, [&](CArchive& archive) { annotate(input, steps, archive); });
}
}  // namespace sigloc

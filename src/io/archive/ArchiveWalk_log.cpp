// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause

// Logs: actions and observations.
#include "io/archive/ArchiveWalk.h"

namespace sigloc::detail
{
namespace
{
constexpr std::uint32_t kMostDrawn = 100000;  // particles that are drawn when an action is read
}  // namespace

void ArchiveWalk::actionCollection(int)
{
  for (std::size_t left = count(1); left > 0; --left) object(only(ArchivePart::action));
}

void ArchiveWalk::sensoryFrame(int version)
{
  if (version < 2) skip(sizeof(std::uint32_t));
  if (version == 0) skip(sizeof(std::uint64_t));
  for (std::size_t left = count(1); left > 0; --left) object(only(ArchivePart::observation));
}

void ArchiveWalk::movement2D(int version)
{
  constexpr std::size_t kOldOptions = 44;
  if (version < 2) object(only(ArchivePart::distribution_2d));
  const auto method = value<std::int32_t>();
  if (version == 0) return;
  const bool told = version > 1;  // else the distribution came first
  if (told && method == 0)  // from odometry
  {
    object(only(ArchivePart::pose_2d));
    if (version == 2)
    {
      skip(kOldOptions);
    }
    else
    {
      const bool drawn = value<std::int32_t>() != 0;
      floats(version == 3 ? 5 : 6);
      const auto particles = value<std::uint32_t>();
      if (drawn && particles > kMostDrawn) throw Unsound();
      floats(version >= 5 ? 6 : 4);
    }
  }
  else if (told && method == 1)  // from matched scans
  {
    object(only(ArchivePart::distribution_2d));
  }
  else if (told)
  {
    throw Unsound();
  }
  const bool velocities = flag();
  if (version < 7) floats(2);
  if (version >= 7 && velocities) doubles(3);
  const bool encoders = flag();
  if (version < 7 || encoders) skip(2 * sizeof(std::int32_t));
  if (version >= 6) skip(sizeof(std::uint64_t));
}

void ArchiveWalk::movement3D(int version)
{
  constexpr std::size_t kAxes = 6;
  skip(sizeof(std::uint32_t));
  object(only(ArchivePart::distribution_3d));
  if (count(1) != kAxes) throw Unsound();
  skip(kAxes);
  if (count(sizeof(float)) != kAxes) throw Unsound();
  floats(kAxes);
  if (version >= 1) skip(sizeof(std::uint64_t));
}

void ArchiveWalk::rangeScan(int version)
{
  floats(1);
  if (value<std::uint8_t>() > 1) throw Unsound();  // a bool, which MRPT reads as any byte
  floats(1);
  object(only(ArchivePart::pose_3d));
  if (version < 6) object(only(ArchivePart::matrix));
  const std::size_t beams = count(sizeof(float));
  floats(beams);
  if (version >= 1) skip(beams);
  if (version >= 2) floats(1);
  if (version >= 3) skip(sizeof(std::uint64_t));
  if (version >= 4) floats(1);
  if (version >= 5)
  {
    text();
    doubles(1);
  }
  if (version >= 7 && flag()) skip(beams * sizeof(std::int32_t));
  if (version >= 8) skipNewer(sizeof(float));  // how long the sweep took
}

void ArchiveWalk::odometry(int version)
{
  object(only(ArchivePart::pose_2d));
  text();
  skip(sizeof(std::uint64_t));
  if (version == 0) return;
  const bool encoders = flag();
  if (encoders || version < 2) skip(2 * sizeof(std::int32_t));
  const bool velocities = flag();
  if (version < 2) floats(2);
  if (version >= 2 && velocities) doubles(3);
}

void ArchiveWalk::bearingRange(int version)
{
  floats(version >= 3 ? 4 : 3);
  object(only(ArchivePart::pose_3d));
  if (version >= 2) skip(sizeof(std::uint64_t));
  const bool covariances = version >= 3 && flag();
  if (version >= 3 && !covariances) floats(3);
  constexpr std::size_t kMeasured = 3 * sizeof(float) + sizeof(std::int32_t);
  for (std::size_t left = count(kMeasured); left > 0; --left)
  {
    skip(kMeasured);
    if (covariances) object(only(ArchivePart::matrix));
  }
  if (version >= 1) text();
}

void ArchiveWalk::robotPose(int version)
{
  object(only(ArchivePart::distribution_3d));
  text();
  skip(sizeof(std::uint64_t));
  if (version >= 1) object(only(ArchivePart::pose_3d));
}

void ArchiveWalk::comment(int version)
{
  text();
  skip(sizeof(std::uint64_t));
  if (version == 0) return;
  const std::size_t label = at_;
  text();
  const bool newer = version > layoutOf("CObservationComment")->newest;
  if (newer && use_ == Input::kept) edits_.push_back({label, at_ - label, '\0'});
}

void ArchiveWalk::signatures(int version)
{
  constexpr std::size_t kFeature = 4 + 10 * sizeof(double) + 3 * sizeof(std::int32_t);
  skip(sizeof(std::uint64_t));
  text();
  text();
  object(only(ArchivePart::pose_3d));
  skip(count(kFeature) * kFeature);
  if (version < 1) return;
  constexpr std::size_t kReturn = 2 * sizeof(float);
  skip(count(kReturn) * kReturn);
}
}  // namespace sigloc::detail

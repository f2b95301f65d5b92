// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/archive/ArchiveWalk.h"

#include <mrpt/version.h>

#include <algorithm>
#include <array>

namespace sigloc::detail
{
namespace
{
constexpr std::size_t kMostItems = 4000000;  // of a list: beams, particles, observations
constexpr std::uint8_t kEndFlag = 0x88;  // after an object
constexpr std::size_t kMostKept = 128000000;  // bytes of an object that is read afterwards
constexpr bool kMrptKnowsLabels = MRPT_VERSION >= 0x20E07;  // of comments; earlier ones may, too
constexpr std::size_t kAtOnce = 1U << 18U;  // bytes of a file that is consumed
}  // namespace

const ArchiveWalk::Layout* ArchiveWalk::layoutOf(std::string_view name)
{
  using P = ArchivePart;
  using W = ArchiveWalk;
  static constexpr std::array<Layout, 26> kLayouts = {{
      {"CActionCollection", P::entry, 0, &W::actionCollection},
      {"CSensoryFrame", P::entry, 2, &W::sensoryFrame},
      {"CSensorialFrame", P::entry, 2, &W::sensoryFrame},  // its name before 2008
      {"CActionRobotMovement2D", P::action, 7, &W::movement2D},
      {"CActionRobotMovement3D", P::action, 1, &W::movement3D},
      {"CObservation2DRangeScan", P::observation, 7, &W::rangeScan},
      {"CObservationOdometry", P::observation, 2, &W::odometry},
      {"CObservationBearingRange", P::observation, 3, &W::bearingRange},
      {"CObservationRobotPose", P::observation, 1, &W::robotPose},
      {"CObservationComment", P::observation, kMrptKnowsLabels ? 1 : 0, &W::comment},
      {"ObservationSignatures", P::observation, 1, &W::signatures},
      {"CPose2D", P::pose_2d, 1, &W::pose2D},
      {"CPose3D", P::pose_3d, 3, &W::pose3D},
      {"CMatrixF", P::matrix, 1, &W::matrix},
      {"CMatrix", P::matrix, 0, &W::matrix},
      {"CMatrixD", P::matrix, 1, &W::doubleMatrix},
      {"CPosePDFGaussian", P::distribution_2d, 2, &W::gaussian2D},
      {"CPose3DPDFGaussian", P::distribution_3d, 1, &W::gaussian3D},
      {"CPosePDFGaussianInf", P::distribution_2d, 0, &W::informed2D},
      {"CPosePDFSOG", P::distribution_2d, 2, &W::sumOfGaussians2D},
      {"CPosePDFParticles", P::distribution_2d, 1, &W::particles2D},
      {"CPose3DPDFParticles", P::distribution_3d, 1, &W::particles3D},
      {"CSimpleMap", P::simplemap, 1, &W::simplemap},
      {"CSensFrameProbSequence", P::simplemap, 1, &W::simplemap},  // its name before 2008
      {"COccupancyGridMap2D", P::grid_map, 6, &W::gridMap},
      {"TMapGenericParams", P::map_parameters, 0, &W::mapParameters},
  }};
  const std::size_t colon = name.rfind(':');
  if (colon != std::string_view::npos) name.remove_prefix(colon + 1);
  const auto* const found = std::find_if(kLayouts.begin(), kLayouts.end(),
                                         [&](const Layout& layout) { return layout.name == name; });
  return found == kLayouts.end() ? nullptr : found;
}

/// Later versions of MRPT wrote four classes with something more, or nothing more.
bool ArchiveWalk::isKnown(const Layout& layout, int version)
{
  const bool grew = layout.name == "CObservation2DRangeScan" ||  // 8, by MRPT 2.15
                    layout.name == "CSimpleMap" ||  // 2, by MRPT 2.11.5
                    layout.name == "COccupancyGridMap2D";  // 7, by MRPT 3
  const bool labelled = layout.name == "CObservationComment" && !kMrptKnowsLabels;  // 1, by 2.14
  return version >= 0 && version <= layout.newest + (grew || labelled ? 1 : 0);
}

void ArchiveWalk::skipNewer(std::size_t bytes)
{
  if (use_ == Input::kept) edits_.push_back({at_, bytes, '\0'});
  skip(bytes);
}

void ArchiveWalk::makeOlder()
{
  // From behind, so that what is to come keeps its place.
  for (auto edit = edits_.rbegin(); edit != edits_.rend(); ++edit)
  {
    edit->left_out > 0 ? input_.leaveOut(edit->at, edit->left_out)
                       : input_.change(edit->at, edit->value);
  }
  edits_.clear();
}

void ArchiveWalk::need(std::size_t bytes)
{
  constexpr std::size_t kAtFirst = 4096;
  if (at_ + bytes <= ahead_.size()) return;
  if (use_ == Input::kept && at_ + bytes > kMostKept) throw Unsound("an object of over 128 MB");
  drop();
  ahead_ = input_.peek(std::max(at_ + bytes, 2 * ahead_.size() + kAtFirst));
  if (at_ + bytes > ahead_.size()) throw Unsound();
}

/// Lets go of what was walked over, where nobody reads it afterwards.
void ArchiveWalk::drop()
{
  if (use_ == Input::kept) return;
  input_.drop(at_);
  at_ = 0;
  ahead_ = {};
}

void ArchiveWalk::skip(std::size_t bytes)
{
  while (use_ == Input::consumed && bytes > kAtOnce)
  {
    need(kAtOnce);
    at_ += kAtOnce;
    bytes -= kAtOnce;
  }
  need(bytes);
  at_ += bytes;
}

std::size_t ArchiveWalk::count(std::size_t bytes)
{
  const std::size_t n = value<std::uint32_t>();
  if (n > kMostItems) throw Unsound();
  need(n * bytes);
  return n;
}

void ArchiveWalk::object(unsigned parts)
{
  constexpr std::size_t kLongestName = 120;
  const auto first = value<std::uint8_t>();
  // The oldest files have numbers of four bytes here, and no flag at an object's end.
  const bool old = first < 0x80U;
  if (old && (flag() || flag() || flag())) throw Unsound();
  const std::size_t length = first & 0x7FU;
  if (length == 0 || length > kLongestName) throw Unsound();
  need(length);
  const std::string name(ahead_.substr(at_, length));
  at_ += length;
  const int version = old ? value<std::int32_t>() : value<std::uint8_t>();
  if (name == "nullptr") throw Unsound();
  const Layout* const layout = layoutOf(name);
  if (layout == nullptr) throw Unknown{};
  if ((parts & only(layout->part)) == 0) throw Unsound();
  if (!isKnown(*layout, version) || (old && version > layout->newest))
  {
    throw Unsound("holds a '" + name + "' of version " + std::to_string(version) +
                  ", which is not known");
  }
  if (version > layout->newest)
  {
    newer_ = true;
    const Edit edit{at_ - 1, 0, static_cast<char>(layout->newest)};
    if (use_ == Input::kept) edits_.push_back(edit);
  }
  (this->*layout->walk)(version);
  if (!old && value<std::uint8_t>() != kEndFlag) throw Unsound();
}

void ArchiveWalk::pose2D(int version)
{
  version == 0 ? floats(3) : doubles(3);
}

void ArchiveWalk::pose3D(int version)
{
  if (version < 2) return object(only(ArchivePart::matrix));
  doubles(version == 2 ? 7 : 12);
}

void ArchiveWalk::cells(int, std::size_t bytes)
{
  constexpr std::size_t kMostRows = 100;
  const std::size_t rows = value<std::uint32_t>();
  const std::size_t columns = value<std::uint32_t>();
  if (rows > kMostRows || columns > kMostRows) throw Unsound();
  skip(rows * columns * bytes);
}

void ArchiveWalk::gaussian2D(int version)
{
  object(only(ArchivePart::pose_2d));
  if (version == 0) return object(only(ArchivePart::matrix));
  version == 1 ? floats(6) : doubles(6);
}

void ArchiveWalk::gaussian3D(int version)
{
  if (version == 0) throw Unsound();  // MRPT does not read it either
  object(only(ArchivePart::pose_3d));
  doubles(21);
}

void ArchiveWalk::sumOfGaussians2D(int version)
{
  for (std::size_t left = count(1); left > 0; --left)
  {
    doubles(1);
    object(only(ArchivePart::pose_2d));
    version == 1 ? floats(6) : doubles(6);
  }
}

void ArchiveWalk::particles2D(int version)
{
  for (std::size_t left = count(sizeof(double)); left > 0; --left)
  {
    doubles(1);
    version == 0 ? object(only(ArchivePart::pose_2d)) : doubles(3);
  }
}

void ArchiveWalk::particles3D(int version)
{
  for (std::size_t left = count(sizeof(double)); left > 0; --left)
  {
    doubles(1);
    version == 0 ? object(only(ArchivePart::pose_3d)) : doubles(6);
  }
}
}  // namespace sigloc::detail

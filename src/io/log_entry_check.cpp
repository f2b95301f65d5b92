// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/log_entry_check.h"

#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <string>
#include <string_view>

namespace sigloc::detail
{
namespace
{
constexpr std::size_t kMostItems = 4000000;  // of a list: beams, particles, observations
constexpr std::uint8_t kEndFlag = 0x88;  // after an object
constexpr std::uint32_t kMostDrawn = 100000;  // particles that are drawn when an action is read

struct Unsound
{
};
struct Unknown
{
};

/// The part that a class plays in a log. An object is refused where another part is wanted.
enum class Part : std::uint8_t
{
  entry = 1,  ///< of a log
  action = 2,
  observation = 4,  ///< a log's entry too
  pose_2d = 8,
  pose_3d = 16,
  matrix = 32,
  distribution_2d = 64,
  distribution_3d = 128,
};

/// Walks over an object that an input holds next.
class Walk
{
 public:
  explicit Walk(GzipInput& input) : input_(input) {}

  /// An object that plays one of these parts.
  void object(unsigned parts);

 private:
  void skip(std::size_t bytes)
  {
    need(bytes);
    at_ += bytes;
  }

  template <class T>
  T value()
  {
    need(sizeof(T));
    T value;
    std::memcpy(&value, ahead_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    return value;
  }

  /// A truth value as MRPT writes it.
  bool flag() { return value<std::uint8_t>() != 0; }

  /// The number of items that follow, of at least `bytes` each.
  std::size_t count(std::size_t bytes)
  {
    const std::size_t n = value<std::uint32_t>();
    if (n > kMostItems) throw Unsound{};
    need(n * bytes);
    return n;
  }

  void text() { skip(count(1)); }
  void doubles(std::size_t n) { skip(n * sizeof(double)); }
  void floats(std::size_t n) { skip(n * sizeof(float)); }

  void need(std::size_t bytes);

  void actionCollection(int version);
  void sensoryFrame(int version);
  void movement2D(int version);
  void movement3D(int version);
  void rangeScan(int version);
  void odometry(int version);
  void bearingRange(int version);
  void robotPose(int version);
  void comment(int version);
  void signatures(int version);
  void pose2D(int version);
  void pose3D(int version);
  void matrix(int version) { cells(version, sizeof(float)); }
  void doubleMatrix(int version) { cells(version, sizeof(double)); }
  void cells(int version, std::size_t bytes);
  void gaussian2D(int version);
  void gaussian3D(int version);
  void sumOfGaussians2D(int version);
  void particles2D(int version);

  struct Layout
  {
    std::string_view name;  // without its namespace, which old files lack
    Part part;
    int newest;  // version
    void (Walk::*walk)(int version);
  };
  static const Layout* layoutOf(std::string_view name);

  GzipInput& input_;
  std::string_view ahead_;
  std::size_t at_ = 0;
};

constexpr unsigned only(Part part)
{
  return static_cast<unsigned>(part);
}

const Walk::Layout* Walk::layoutOf(std::string_view name)
{
  using P = Part;
  using W = Walk;
  static constexpr std::array<Layout, 19> kLayouts = {{
      {"CActionCollection", P::entry, 0, &W::actionCollection},
      {"CSensoryFrame", P::entry, 2, &W::sensoryFrame},
      {"CActionRobotMovement2D", P::action, 7, &W::movement2D},
      {"CActionRobotMovement3D", P::action, 1, &W::movement3D},
      {"CObservation2DRangeScan", P::observation, 7, &W::rangeScan},
      {"CObservationOdometry", P::observation, 2, &W::odometry},
      {"CObservationBearingRange", P::observation, 3, &W::bearingRange},
      {"CObservationRobotPose", P::observation, 1, &W::robotPose},
      {"CObservationComment", P::observation, 0, &W::comment},
      {"ObservationSignatures", P::observation, 0, &W::signatures},
      {"CPose2D", P::pose_2d, 1, &W::pose2D},
      {"CPose3D", P::pose_3d, 3, &W::pose3D},
      {"CMatrixF", P::matrix, 1, &W::matrix},
      {"CMatrix", P::matrix, 0, &W::matrix},
      {"CMatrixD", P::matrix, 1, &W::doubleMatrix},
      {"CPosePDFGaussian", P::distribution_2d, 2, &W::gaussian2D},
      {"CPose3DPDFGaussian", P::distribution_3d, 1, &W::gaussian3D},
      {"CPosePDFSOG", P::distribution_2d, 2, &W::sumOfGaussians2D},
      {"CPosePDFParticles", P::distribution_2d, 1, &W::particles2D},
  }};
  const std::size_t colon = name.rfind(':');
  if (colon != std::string_view::npos) name.remove_prefix(colon + 1);
  const auto* const found = std::find_if(kLayouts.begin(), kLayouts.end(),
                                         [&](const Layout& layout) { return layout.name == name; });
  return found == kLayouts.end() ? nullptr : found;
}

void Walk::need(std::size_t bytes)
{
  constexpr std::size_t kAtOnce = 4096;
  if (at_ + bytes <= ahead_.size()) return;
  ahead_ = input_.peek(std::max(at_ + bytes, 2 * ahead_.size() + kAtOnce));
  if (at_ + bytes > ahead_.size()) throw Unsound{};
}

void Walk::object(unsigned parts)
{
  constexpr std::size_t kLongestName = 120;
  const auto first = value<std::uint8_t>();
  // The oldest files have numbers of four bytes here, and no flag at an object's end.
  const bool old = first < 0x80U;
  if (old && (flag() || flag() || flag())) throw Unsound{};
  const std::size_t length = first & 0x7FU;
  if (length == 0 || length > kLongestName) throw Unsound{};
  need(length);
  const std::string name(ahead_.substr(at_, length));
  at_ += length;
  const int version = old ? value<std::int32_t>() : value<std::int8_t>();
  if (name == "nullptr") throw Unsound{};
  const Layout* const layout = layoutOf(name);
  if (layout == nullptr) throw Unknown{};
  if ((parts & only(layout->part)) == 0) throw Unsound{};
  if (version < 0 || version > layout->newest) throw Unknown{};  // MRPT refuses these itself
  (this->*layout->walk)(version);
  if (!old && value<std::uint8_t>() != kEndFlag) throw Unsound{};
}

void Walk::actionCollection(int)
{
  for (std::size_t left = count(1); left > 0; --left) object(only(Part::action));
}

void Walk::sensoryFrame(int version)
{
  if (version < 2) skip(sizeof(std::uint32_t));
  if (version == 0) skip(sizeof(std::uint64_t));
  for (std::size_t left = count(1); left > 0; --left) object(only(Part::observation));
}

void Walk::movement2D(int version)
{
  constexpr std::size_t kOldOptions = 44;
  if (version < 2) object(only(Part::distribution_2d));
  const auto method = value<std::int32_t>();
  if (version == 0) return;
  const bool told = version > 1;  // else the distribution came first
  if (told && method == 0)  // from odometry
  {
    object(only(Part::pose_2d));
    if (version == 2)
    {
      skip(kOldOptions);
    }
    else
    {
      const bool drawn = value<std::int32_t>() != 0;
      floats(version == 3 ? 5 : 6);
      const auto particles = value<std::uint32_t>();
      if (drawn && particles > kMostDrawn) throw Unsound{};
      floats(version >= 5 ? 6 : 4);
    }
  }
  else if (told && method == 1)  // from matched scans
  {
    object(only(Part::distribution_2d));
  }
  else if (told)
  {
    throw Unsound{};
  }
  const bool velocities = flag();
  if (version < 7) floats(2);
  if (version >= 7 && velocities) doubles(3);
  const bool encoders = flag();
  if (version < 7 || encoders) skip(2 * sizeof(std::int32_t));
  if (version >= 6) skip(sizeof(std::uint64_t));
}

void Walk::movement3D(int version)
{
  constexpr std::size_t kAxes = 6;
  skip(sizeof(std::uint32_t));
  object(only(Part::distribution_3d));
  if (count(1) != kAxes) throw Unsound{};
  skip(kAxes);
  if (count(sizeof(float)) != kAxes) throw Unsound{};
  floats(kAxes);
  if (version >= 1) skip(sizeof(std::uint64_t));
}

void Walk::rangeScan(int version)
{
  floats(1);
  skip(1);
  floats(1);
  object(only(Part::pose_3d));
  if (version < 6) object(only(Part::matrix));
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
}

void Walk::odometry(int version)
{
  object(only(Part::pose_2d));
  text();
  skip(sizeof(std::uint64_t));
  if (version == 0) return;
  const bool encoders = flag();
  if (encoders || version < 2) skip(2 * sizeof(std::int32_t));
  const bool velocities = flag();
  if (version < 2) floats(2);
  if (version >= 2 && velocities) doubles(3);
}

void Walk::bearingRange(int version)
{
  floats(version >= 3 ? 4 : 3);
  object(only(Part::pose_3d));
  if (version >= 2) skip(sizeof(std::uint64_t));
  const bool covariances = version >= 3 && flag();
  if (version >= 3 && !covariances) floats(3);
  constexpr std::size_t kMeasured = 3 * sizeof(float) + sizeof(std::int32_t);
  for (std::size_t left = count(kMeasured); left > 0; --left)
  {
    skip(kMeasured);
    if (covariances) object(only(Part::matrix));
  }
  if (version >= 1) text();
}

void Walk::robotPose(int version)
{
  object(only(Part::distribution_3d));
  text();
  skip(sizeof(std::uint64_t));
  if (version >= 1) object(only(Part::pose_3d));
}

void Walk::comment(int)
{
  text();
  skip(sizeof(std::uint64_t));
}

void Walk::signatures(int)
{
  constexpr std::size_t kFeature = 4 + 10 * sizeof(double) + 3 * sizeof(std::int32_t);
  skip(sizeof(std::uint64_t));
  text();
  text();
  object(only(Part::pose_3d));
  skip(count(kFeature) * kFeature);
}

void Walk::pose2D(int version)
{
  version == 0 ? floats(3) : doubles(3);
}

void Walk::pose3D(int version)
{
  if (version < 2) return object(only(Part::matrix));
  doubles(version == 2 ? 7 : 12);
}

void Walk::cells(int, std::size_t bytes)
{
  constexpr std::size_t kMostRows = 100;
  const std::size_t rows = value<std::uint32_t>();
  const std::size_t columns = value<std::uint32_t>();
  if (rows > kMostRows || columns > kMostRows) throw Unsound{};
  skip(rows * columns * bytes);
}

void Walk::gaussian2D(int version)
{
  object(only(Part::pose_2d));
  if (version == 0) return object(only(Part::matrix));
  version == 1 ? floats(6) : doubles(6);
}

void Walk::gaussian3D(int version)
{
  if (version == 0) throw Unsound{};  // MRPT does not read it either
  object(only(Part::pose_3d));
  doubles(21);
}

void Walk::sumOfGaussians2D(int version)
{
  for (std::size_t left = count(1); left > 0; --left)
  {
    doubles(1);
    object(only(Part::pose_2d));
    version == 1 ? floats(6) : doubles(6);
  }
}

void Walk::particles2D(int version)
{
  for (std::size_t left = count(sizeof(double)); left > 0; --left)
  {
    doubles(1);
    version == 0 ? object(only(Part::pose_2d)) : doubles(3);
  }
}
}  // namespace

Soundness soundnessOfNext(GzipInput& input)
{
  try
  {
    Walk(input).object(only(Part::entry) | only(Part::observation));
  }
  catch (const Unsound&)
  {
    return Soundness::unsound;
  }
  catch (const Unknown&)
  {
    return Soundness::unknown;
  }
  return Soundness::sound;
}

mrpt::serialization::CSerializable::Ptr readLogEntry(GzipInput& input)
{
  if (soundnessOfNext(input) == Soundness::unsound) return nullptr;
  return mrpt::serialization::archiveFrom(input).ReadObject();
}
}  // namespace sigloc::detail

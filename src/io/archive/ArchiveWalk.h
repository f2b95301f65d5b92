// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "io/archive/gzip_input.h"

namespace sigloc::detail
{
/// The part that a class plays in a file. An object is refused where another part is wanted.
enum class ArchivePart : std::uint16_t
{
  entry = 1,  ///< of a log
  action = 2,
  observation = 4,  ///< a log's entry too
  pose_2d = 8,
  pose_3d = 16,
  matrix = 32,
  distribution_2d = 64,
  distribution_3d = 128,
  simplemap = 256,
  grid_map = 512,
  map_parameters = 1024,
};

constexpr unsigned only(ArchivePart part)
{
  return static_cast<unsigned>(part);
}

constexpr unsigned kLogEntry = only(ArchivePart::entry) | only(ArchivePart::observation);

/// Walks over MRPT's objects in a file without making them. MRPT's readers believe every count and
/// every class name; the walk compares each count with the bytes that are there. It knows the
/// classes that sigloc uses, in all versions that MRPT 2.5 reads, and in later ones that differ by
/// what can be left out.
class ArchiveWalk
{
 public:
  /// Cut off, or with a value that MRPT would crash, hang or take all memory for.
  struct Unsound : std::runtime_error
  {
    explicit Unsound(const std::string& reason = "truncated or damaged")
        : std::runtime_error(reason)
    {
    }
  };

  /// Of a class, or with one inside, whose layout is not known here.
  struct Unknown
  {
  };

  enum class Input
  {
    kept,  ///< what is walked over can be read afterwards
    consumed,  ///< less memory, for a whole file
  };

  ArchiveWalk(GzipInput& input, Input use) : input_(input), use_(use) {}

  /// Walks over an object that plays one of these parts. Throws Unsound or Unknown.
  void object(unsigned parts);

  /// True where an object was of a version that MRPT 2.5 does not read.
  bool isNewer() const { return newer_; }

  /// Gives what was walked over, and kept, the form that MRPT 2.5 reads.
  void makeOlder();

 private:
  void skip(std::size_t bytes);

  template <class T>
  T value()
  {
    need(sizeof(T));
    T value;
    std::memcpy(&value, ahead_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    return value;
  }

  /// Bytes that come next, and are not skipped.
  std::string_view peeked(std::size_t bytes)
  {
    need(bytes);
    return ahead_.substr(at_, bytes);
  }

  /// A truth value as MRPT writes it.
  bool flag() { return value<std::uint8_t>() != 0; }

  /// The number of items that follow, of at least `bytes` each.
  std::size_t count(std::size_t bytes);

  void text() { skip(count(1)); }
  void doubles(std::size_t n) { skip(n * sizeof(double)); }
  void floats(std::size_t n) { skip(n * sizeof(float)); }

  /// What MRPT 2.5 does not know: the older form lacks it.
  void skipNewer(std::size_t bytes);

  void need(std::size_t bytes);
  void drop();

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
  void informed2D(int) { doubles(9); }
  void sumOfGaussians2D(int version);
  void particles2D(int version);
  void particles3D(int version);
  void simplemap(int version);
  void optionalTwist();
  void gridMap(int version);
  void gridCells(std::size_t count, std::size_t bytes);
  void mapParameters(int version);

  /// A change that makes an object older, in bytes from where the walk began.
  struct Edit
  {
    std::size_t at;
    std::size_t left_out;  // 0: the byte gets the value
    char value;
  };

  struct Layout
  {
    std::string_view name;  // without its namespace, which old files lack
    ArchivePart part;
    int newest;  // version that MRPT 2.5 reads
    void (ArchiveWalk::*walk)(int version);
  };
  static const Layout* layoutOf(std::string_view name);
  static bool isKnown(const Layout& layout, int version);

  GzipInput& input_;
  Input use_;
  std::string_view ahead_;
  std::size_t at_ = 0;
  std::vector<Edit> edits_;  // where the input is kept
  bool newer_ = false;
};
}  // namespace sigloc::detail

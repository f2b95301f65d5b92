// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/CMatrixFixed.h>
#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sigloc
{
/// The type of a feature. The numeric values are stored in `.sigmap` files. A new type is entered
/// before `count` and gets a row in kFeatureTraits.
enum class FeatureType : std::uint8_t
{
  point = 0,  ///< landmark or reflector: a place without direction and size
  segment = 1,  ///< directed piece of wall; the normal points into the free space
  circle = 2,  ///< pillar or trunk
  corner = 3,  ///< two walls that meet: vertex, bisector, opening
  wall_end = 4,  ///< a wall that stops at a jump edge: end point, direction of the wall, side
  count  ///< the number of types; it stays last, and no feature has it
};

/// The geometry of a feature. Code that is not about one type uses this.
enum class FeatureGeometry : std::uint8_t
{
  place,  ///< a point of the plane without direction
  viewed,  ///< a place whose direction is only that from which it was seen
  directed,  ///< a place with a direction of its own, so that one feature fixes a pose
  wall,  ///< a directed piece of wall, which may be seen in several parts
};

/// The meaning of `Feature::size`.
enum class FeatureSize : std::uint8_t
{
  none,
  length,  ///< [m]; an observed length may be less than the mapped one
  radius,  ///< [m], of a round outline about the position
  opening,  ///< [rad]
};

/// The properties of a feature type.
struct FeatureTraits
{
  FeatureType type = FeatureType::count;
  const char* name = "";
  const char* plural = "";  ///< a key of `sigloc-map info`
  FeatureGeometry geometry = FeatureGeometry::place;
  FeatureSize size = FeatureSize::none;
  const char* size_name = "";
  std::array<std::uint8_t, 3> color{};  ///< red, green and blue in drawn maps
  bool has_side = false;  ///< `Feature::side` is used
};

/// Index of a type in kFeatureTraits and in every array of kFeatureTypes.
constexpr std::size_t typeIndex(FeatureType type)
{
  return static_cast<std::size_t>(type);
}

constexpr std::size_t kFeatureTypes = typeIndex(FeatureType::count);

/// The traits of each type, in the order of the enum.
inline constexpr auto kFeatureTraits = []
{
  using T = FeatureType;
  using G = FeatureGeometry;
  using S = FeatureSize;
  return std::array<FeatureTraits, kFeatureTypes>{{
      {T::point, "point", "points", G::place, S::none, "", {20, 20, 20}},
      {T::segment, "segment", "segments", G::wall, S::length, "length", {31, 78, 160}},
      {T::circle, "circle", "circles", G::viewed, S::radius, "radius", {110, 120, 0}},
      {T::corner, "corner", "corners", G::directed, S::opening, "opening", {0, 140, 130}},
      {T::wall_end, "wall_end", "wall_ends", G::directed, S::length, "length", {150, 90, 20}, true},
  }};
}();

constexpr bool everyTypeHasItsRow()
{
  for (std::size_t k = 0; k < kFeatureTypes; ++k)
  {
    if (typeIndex(kFeatureTraits[k].type) != k) return false;
  }
  return true;
}
static_assert(everyTypeHasItsRow(), "kFeatureTraits needs a row a type, in the order of the enum");
static_assert(kFeatureTypes <= 32, "hasTrait has a bit for each type");

constexpr const FeatureTraits& traitsOf(FeatureType type)
{
  return kFeatureTraits[typeIndex(type)];
}

/// Returns whether a trait of a type has a value. It tests a bit of a constant, which is fast in
/// inner loops.
template <auto trait, auto value>
constexpr bool hasTrait(FeatureType type)
{
  constexpr std::uint32_t kTypes = []
  {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < kFeatureTypes; ++k)
    {
      if (kFeatureTraits[k].*trait == value) bits |= 1U << k;
    }
    return bits;
  }();
  return (kTypes >> typeIndex(type) & 1U) != 0;
}

constexpr bool isSegment(FeatureType type)
{
  return hasTrait<&FeatureTraits::geometry, FeatureGeometry::wall>(type);
}
/// True for every type but the segment: the feature has a place in the plane.
constexpr bool isPointLike(FeatureType type)
{
  return !isSegment(type);
}
constexpr bool hasDirection(FeatureType type)
{
  return !hasTrait<&FeatureTraits::geometry, FeatureGeometry::place>(type);
}
/// True for a corner or wall end, which has a direction of its own besides its place. The direction
/// of a circle is only that from which it was seen.
constexpr bool hasBearing(FeatureType type)
{
  return hasTrait<&FeatureTraits::geometry, FeatureGeometry::directed>(type);
}
constexpr bool hasSize(FeatureType type)
{
  return !hasTrait<&FeatureTraits::size, FeatureSize::none>(type);
}
/// True where the size is a length, and an observed one may be less than the mapped one.
constexpr bool isSeenInPart(FeatureType type)
{
  return hasTrait<&FeatureTraits::size, FeatureSize::length>(type);
}
constexpr bool isRound(FeatureType type)
{
  return hasTrait<&FeatureTraits::size, FeatureSize::radius>(type);
}

/// The end of a directed segment that a wall end is. A mirror image swaps the two.
enum class WallSide : std::uint8_t
{
  start = 0,
  end = 1,
};

/// One geometric feature, observed (robot frame) or mapped (map frame).
///
/// All types share one layout, an oriented place with covariance, so that one code handles the
/// constraints between any two of them.
///
/// What position [m], direction [rad] and size mean for each type:
///
/// * point: the point; direction and size are unused (0)
/// * segment: its mid-point; the normal, into the free space; the length [m]
/// * circle: the centre; from there towards the middle of the seen arc; the radius [m]
/// * corner: the vertex; the bisector, into the free space; the opening of the free space [rad],
///   in (0, 2 pi)
/// * wall end: the end; from the end along the wall; the length of the wall [m]
///
/// A segment runs along its tangent = normal - pi/2 from `start` to `end`. The free space is on its
/// left. A scanner in that free space with counter-clockwise beams sees `start` first.
struct Feature
{
  FeatureType type = FeatureType::point;
  WallSide side = WallSide::start;  ///< wall end only
  bool start_seen = false;  ///< segment: the start is a real end, not an occlusion
  bool end_seen = false;  ///< segment: the end is a real end, not an occlusion
  mrpt::math::TPoint2D position;
  double direction = 0;
  double size = 0;
  /// Covariance of the position [m^2]. For a segment only the part along the normal is
  /// meaningful (the mid-point of the *line*); along the tangent it is the end points' variance.
  mrpt::math::CMatrixDouble22 position_covariance;
  /// [rad^2]; for a segment it is uncorrelated with the offset at the mid-point.
  double direction_variance = 0;
  double size_variance = 0;  ///< [m^2] or, for a corner, [rad^2]
  std::int32_t label = -1;  ///< class, colour or intensity bin where given, else -1
  std::uint32_t sightings = 1;  ///< in how many scans a map feature was seen
  std::int32_t parent = -1;  ///< corner, wall end: index of a segment it is derived from, else -1
};

/// Returns the unit vector along `direction`.
mrpt::math::TPoint2D directionVector(const Feature& feature);

/// Returns the unit vector from start to end of a segment (direction - pi/2).
mrpt::math::TPoint2D tangentVector(const Feature& segment);

/// Return the end points of a segment [m], in the frame of the feature.
mrpt::math::TPoint2D segmentStart(const Feature& segment);
mrpt::math::TPoint2D segmentEnd(const Feature& segment);

/// Returns d [m] of a segment's line n . p = d, with n = (cos direction, sin direction).
double lineDistance(const Feature& segment);

/// Returns a feature of frame a in frame b, by `b_from_a`. Covariances are rotated; the pose is
/// taken as exact.
Feature transformed(const mrpt::math::TPose2D& b_from_a, const Feature& feature_in_a);
}  // namespace sigloc

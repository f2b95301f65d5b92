// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/plugin/ObservationSignatures.h"

#include <fmt/core.h>
#include <mrpt/core/bits_math.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/poses/CPose2D.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>
#include <utility>

#include "io/archive_values.h"
#include "io/maps/feature_archive.h"
#include "io/scan_conversion.h"
#include "io/solid/sensor_mount.h"
#include "sigloc/plugin/map_drawing.h"

IMPLEMENTS_SERIALIZABLE(ObservationSignatures, mrpt::obs::CObservation, sigloc)

namespace sigloc
{
using mrpt::math::TPoint2D;
using mrpt::math::TPoint2Df;
using mrpt::math::TPose2D;
using mrpt::poses::CPose2D;
using mrpt::poses::CPose3D;
using mrpt::serialization::CArchive;

namespace
{
// Made when the library is linked, preloaded or opened as a plug-in. It comes after the class's
// identity, which clang, unlike g++, sets up no earlier; so MRPT_INITIALIZER would not do.
[[maybe_unused]] const bool kSignaturesRegistered =
    (mrpt::rtti::registerClass(CLASS_ID(ObservationSignatures)), true);

std::string textOf(const Feature& feature)
{
  const FeatureTraits& traits = traitsOf(feature.type);
  std::string name = traits.name;
  std::replace(name.begin(), name.end(), '_', ' ');
  const auto& p = feature.position_covariance;
  std::string text = fmt::format("{} at ({:.3f}, {:.3f}) m +- {:.3f} m", name, feature.position.x,
                                 feature.position.y, std::sqrt(p(0, 0) + p(1, 1)));
  if (hasDirection(feature.type))
  {
    text += fmt::format(", direction {:.3f} deg", mrpt::RAD2DEG(feature.direction));
  }
  if (hasSize(feature.type))
  {
    const bool is_angle = traits.size == FeatureSize::opening;
    text +=
        fmt::format(", {} {:.3f} {}", traits.size_name,
                    is_angle ? mrpt::RAD2DEG(feature.size) : feature.size, is_angle ? "deg" : "m");
  }
  if (feature.label >= 0) text += fmt::format(", label {}", feature.label);
  return text;
}

std::string textOf(const Relation& relation)
{
  const auto& key = relation.key;
  const double sigma = std::sqrt(key.variance);
  return fmt::format("  {}: {:.3f} +- {:.3f} {}", relation.other,
                     key.is_angle ? mrpt::RAD2DEG(key.value) : key.value,
                     key.is_angle ? mrpt::RAD2DEG(sigma) : sigma, key.is_angle ? "deg" : "m");
}

std::vector<TPoint2Df> readReturns(CArchive& in)
{
  constexpr float kFarthest = 2 * kFarthestReturn;  // the laser sits up to that far from the robot
  std::uint32_t count = 0;
  in >> count;
  std::vector<TPoint2Df> points;
  // Grown as they come: a hostile count must not allocate memory that the file has no data for.
  for (std::uint32_t k = 0; k < count; ++k)
  {
    TPoint2Df point;
    in >> point.x >> point.y;
    if (!(std::abs(point.x) <= kFarthest && std::abs(point.y) <= kFarthest))
    {
      throw detail::BadContent("return " + std::to_string(k) + " has no place near the robot");
    }
    points.push_back(point);
  }
  return points;
}
}  // namespace

ObservationSignatures::ObservationSignatures(const mrpt::obs::CObservation2DRangeScan& scan,
                                             const FeatureExtractorOptions& options)
    : source_label(scan.sensorLabel), robot_from_sensor_(scan.sensorPose)
{
  timestamp = scan.timestamp;
  sensorLabel = source_label + "_SIGNATURES";
  const auto laser = toLaserScan(scan);
  if (!laser) return;
  ObservedScene seen = observeScene({*laser}, options);
  features = std::move(seen.features);
  for (const BeamEnd& beam : seen.beams) returns.emplace_back(TPoint2Df(beam.point));
}

void ObservationSignatures::getSensorPose(CPose3D& pose) const
{
  pose = robot_from_sensor_;
}

void ObservationSignatures::setSensorPose(const CPose3D& pose)
{
  const TPose2D was = CPose2D(robot_from_sensor_).asTPose();
  const TPose2D is = CPose2D(pose).asTPose();
  const TPose2D now_from_before = is + (TPose2D(0, 0, 0) - was);
  for (Feature& feature : features) feature = transformed(now_from_before, feature);
  for (TPoint2Df& point : returns)
  {
    point = TPoint2Df(now_from_before.composePoint(TPoint2D(point)));
  }
  robot_from_sensor_ = pose;
}

void ObservationSignatures::getDescriptionAsText(std::ostream& out) const
{
  CObservation::getDescriptionAsText(out);
  out << fmt::format("Features of the scan '{}': {} (robot frame)\n", source_label,
                     features.size());
  for (std::size_t i = 0; i < features.size(); ++i)
  {
    out << fmt::format("  {}: {}\n", i, textOf(features[i]));
  }
  out << "Signatures: for each feature, how the others stand to it\n";
  for (const Signature& signature : signatures())
  {
    out << fmt::format("  {} |", signature.feature);
    for (const Relation& relation : signature.relations) out << textOf(relation);
    out << '\n';
  }
}

std::string ObservationSignatures::exportTxtHeader() const
{
  std::string types;
  for (const FeatureTraits& traits : kFeatureTraits)
  {
    if (!types.empty()) types += ',';
    types += std::to_string(typeIndex(traits.type)) + '=' + traits.name;
  }
  return "COUNT then for each feature: TYPE(" + types + ") X Y DIRECTION SIZE";
}

std::string ObservationSignatures::exportTxtDataRow() const
{
  std::string row = fmt::format("{}", features.size());
  for (const Feature& feature : features)
  {
    row += fmt::format(" {} {:f} {:f} {:f} {:f}", static_cast<int>(feature.type),
                       feature.position.x, feature.position.y, feature.direction, feature.size);
  }
  return row;
}

void ObservationSignatures::getVisualizationInto(mrpt::opengl::CSetOfObjects& scene) const
{
  ObservedScene seen;
  seen.features = features;
  for (const TPoint2Df& point : returns) seen.beams.push_back({TPoint2D(point)});
  auto objects = drawObservation(seen);
  objects->setLocation(0, 0, robot_from_sensor_.z());
  scene.insert(objects);
}

std::uint8_t ObservationSignatures::serializeGetVersion() const
{
  return 1;  // 0: no returns
}

void ObservationSignatures::serializeTo(CArchive& out) const
{
  out << timestamp << sensorLabel << source_label << robot_from_sensor_
      << static_cast<std::uint32_t>(features.size());
  for (const Feature& feature : features) detail::writeFeature(feature, out);
  out << static_cast<std::uint32_t>(returns.size());
  for (const TPoint2Df& point : returns) out << point.x << point.y;
}

void ObservationSignatures::serializeFrom(CArchive& in, std::uint8_t version)
{
  if (version > 1) MRPT_THROW_UNKNOWN_SERIALIZATION_VERSION(version);
  constexpr std::uint32_t kLongestLabel = 1U << 12U;
  in >> timestamp;
  std::string label = detail::readText(in, kLongestLabel);
  std::string source = detail::readText(in, kLongestLabel);
  CPose3D robot_from_sensor;
  in >> robot_from_sensor;
  if (!detail::isSensorMount(robot_from_sensor))
  {
    throw detail::BadContent("ObservationSignatures of a sensor that is not on the robot");
  }
  std::vector<Feature> read_features = detail::readFeatures(in);
  returns = version >= 1 ? readReturns(in) : std::vector<TPoint2Df>();
  features = std::move(read_features);
  sensorLabel = std::move(label);
  source_label = std::move(source);
  robot_from_sensor_ = robot_from_sensor;
}
}  // namespace sigloc

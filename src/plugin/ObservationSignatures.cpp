// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/plugin/ObservationSignatures.h"

#include <mrpt/core/bits_math.h>
#include <mrpt/core/initializer.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/poses/CPose2D.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <ostream>

#include "config/TextStream.h"
#include "io/maps/feature_archive.h"
#include "io/scan_conversion.h"
#include "sigloc/plugin/map_drawing.h"

IMPLEMENTS_SERIALIZABLE(ObservationSignatures, mrpt::obs::CObservation, sigloc)

// Runs when the library is linked, preloaded or opened as a plug-in.
MRPT_INITIALIZER(register_sigloc_observations)
{
  mrpt::rtti::registerClass(CLASS_ID(sigloc::ObservationSignatures));
}

namespace sigloc
{
using mrpt::math::TPose2D;
using mrpt::poses::CPose2D;
using mrpt::poses::CPose3D;
using mrpt::serialization::CArchive;

namespace
{
void describe(const Feature& feature, std::ostream& out)
{
  const FeatureTraits& traits = traitsOf(feature.type);
  std::string name = traits.name;
  std::replace(name.begin(), name.end(), '_', ' ');
  const auto& p = feature.position_covariance;
  out << name << " at (" << feature.position.x << ", " << feature.position.y << ") m +- "
      << std::sqrt(p(0, 0) + p(1, 1)) << " m";
  if (hasDirection(feature.type))
  {
    out << ", direction " << mrpt::RAD2DEG(feature.direction) << " deg";
  }
  if (hasSize(feature.type))
  {
    const bool is_angle = traits.size == FeatureSize::opening;
    out << ", " << traits.size_name << ' '
        << (is_angle ? mrpt::RAD2DEG(feature.size) : feature.size) << (is_angle ? " deg" : " m");
  }
  if (feature.label >= 0) out << ", label " << feature.label;
}

void describe(const Relation& relation, std::ostream& out)
{
  const double sigma = std::sqrt(relation.key.variance);
  out << "  " << relation.other << ": ";
  if (relation.key.is_angle)
  {
    out << mrpt::RAD2DEG(relation.key.value) << " +- " << mrpt::RAD2DEG(sigma) << " deg";
  }
  else
  {
    out << relation.key.value << " +- " << sigma << " m";
  }
}
}  // namespace

ObservationSignatures::ObservationSignatures(const mrpt::obs::CObservation2DRangeScan& scan,
                                             const FeatureExtractorOptions& options)
    : source_label(scan.sensorLabel), robot_from_sensor_(scan.sensorPose)
{
  timestamp = scan.timestamp;
  sensorLabel = source_label + "_SIGNATURES";
  if (const auto laser = toLaserScan(scan)) features = observeScene({*laser}, options).features;
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
  robot_from_sensor_ = pose;
}

void ObservationSignatures::getDescriptionAsText(std::ostream& out) const
{
  CObservation::getDescriptionAsText(out);
  TextStream text;
  text << std::fixed << std::setprecision(3);
  text << "Features of the scan '" << source_label << "': " << features.size()
       << " (robot frame)\n";
  for (std::size_t i = 0; i < features.size(); ++i)
  {
    text << "  " << i << ": ";
    describe(features[i], text);
    text << '\n';
  }
  text << "Signatures: for each feature, how the others stand to it\n";
  for (const Signature& signature : signatures())
  {
    text << "  " << signature.feature << " |";
    for (const Relation& relation : signature.relations) describe(relation, text);
    text << '\n';
  }
  out << text.str();
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
  TextStream row;
  row << std::fixed << std::setprecision(6) << features.size();
  for (const Feature& feature : features)
  {
    row << ' ' << static_cast<int>(feature.type) << ' ' << feature.position.x << ' '
        << feature.position.y << ' ' << feature.direction << ' ' << feature.size;
  }
  return row.str();
}

void ObservationSignatures::getVisualizationInto(mrpt::opengl::CSetOfObjects& scene) const
{
  ObservedScene observed;
  observed.features = features;
  StepDrawing drawing;
  drawing.observed = &observed;
  drawing.observed_at = TPose2D(0, 0, 0);
  drawing.line_width = 0.04;
  auto objects = drawStep(drawing);
  objects->setLocation(0, 0, robot_from_sensor_.z());
  scene.insert(objects);
}

std::uint8_t ObservationSignatures::serializeGetVersion() const
{
  return 0;
}

void ObservationSignatures::serializeTo(CArchive& out) const
{
  out << timestamp << sensorLabel << source_label << robot_from_sensor_
      << static_cast<std::uint32_t>(features.size());
  for (const Feature& feature : features) detail::writeFeature(feature, out);
}

void ObservationSignatures::serializeFrom(CArchive& in, std::uint8_t version)
{
  if (version != 0) MRPT_THROW_UNKNOWN_SERIALIZATION_VERSION(version);
  std::uint32_t count = 0;
  in >> timestamp >> sensorLabel >> source_label >> robot_from_sensor_ >> count;
  features.clear();
  for (std::uint32_t i = 0; i < count; ++i) features.push_back(detail::readFeature(in));
}
}  // namespace sigloc

// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint2D.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/opengl/Visualizable.h>

#include <string>
#include <vector>

#include "sigloc/features/observe_scans.h"
#include "sigloc/signature/Signature.h"

namespace sigloc
{
/// The features and returns of a scan as one of MRPT's observations. Stock programs with the
/// plug-in loaded keep, show and export them: RawLogViewer in its tree, text and 3D views,
/// rawlog-edit through `--describe` and `--export-txt`.
///
/// A program without the plug-in can't read a log beyond the first of these: take them out again
/// with `rawlog-edit -p libsigloc-mrpt.so --remove-label LABEL`.
class ObservationSignatures : public mrpt::obs::CObservation, public mrpt::opengl::Visualizable
{
  DEFINE_SERIALIZABLE(ObservationSignatures, sigloc)

 public:
  ObservationSignatures() = default;

  /// Of one scan: its time, its label with "_SIGNATURES" appended, its laser's pose. Without
  /// features and returns for a scan that `toLaserScan` can't use.
  explicit ObservationSignatures(const mrpt::obs::CObservation2DRangeScan& scan,
                                 const FeatureExtractorOptions& options = {});

  std::vector<Feature> features;  ///< robot frame
  std::vector<mrpt::math::TPoint2Df> returns;  ///< robot frame [m]; none in logs of before
  std::string source_label;  ///< of the scan

  std::vector<Signature> signatures() const { return signaturesOf(features); }

  // Overrides of mrpt::obs::CObservation.
  void getSensorPose(mrpt::poses::CPose3D& pose) const override;
  /// Moves features and returns with the sensor, in the plane.
  void setSensorPose(const mrpt::poses::CPose3D& pose) override;
  void getDescriptionAsText(std::ostream& out) const override;
  bool exportTxtSupported() const override { return true; }
  std::string exportTxtHeader() const override;
  /// The number of features, then for each: type, x [m], y [m], direction [rad], size [m or rad].
  std::string exportTxtDataRow() const override;

  // Overrides of mrpt::opengl::Visualizable.
  /// Adds robot, returns and features, each type in the colour that it has in a map.
  void getVisualizationInto(mrpt::opengl::CSetOfObjects& scene) const override;

 private:
  mrpt::poses::CPose3D robot_from_sensor_;
};
}  // namespace sigloc

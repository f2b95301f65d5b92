// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPosePDFGaussian.h>
#include <mrpt/serialization/CArchive.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace sigloc::test
{
inline const std::filesystem::path kDatasets = "/usr/share/mrpt/datasets";
inline const std::filesystem::path kLabMap = kDatasets / "localization_demo.simplemap.gz";
inline const std::filesystem::path kLabLog = kDatasets / "localization_demo.rawlog";

/// A fresh folder of its own for the running test, removed with the object.
class TemporaryFolder
{
 public:
  TemporaryFolder()
  {
    std::string pattern = (std::filesystem::temp_directory_path() / "sigloc-XXXXXX").string();
    path_ = mkdtemp(pattern.data());
  }
  ~TemporaryFolder()
  {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline void writeText(const std::filesystem::path& path, const std::string& text)
{
  std::ofstream(path, std::ios::binary) << text;
}

inline std::string readBytes(const std::filesystem::path& path)
{
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline void writeObjects(const std::filesystem::path& path,
                         const std::vector<mrpt::serialization::CSerializable::Ptr>& objects)
{
  mrpt::io::CFileGZOutputStream file(path.string());
  auto archive = mrpt::serialization::archiveFrom(file);
  for (const auto& object : objects) archive << *object;
}

/// A scan of 181 beams that all read `range`.
inline mrpt::obs::CObservation2DRangeScan::Ptr makeScan(double time, float range = 3.0F,
                                                        const std::string& label = "LASER")
{
  auto scan = mrpt::obs::CObservation2DRangeScan::Create();
  scan->timestamp = mrpt::Clock::fromDouble(time);
  scan->sensorLabel = label;
  scan->aperture = static_cast<float>(M_PI);
  scan->maxRange = 20.0F;
  scan->resizeScanAndAssign(181, range, true);
  return scan;
}

inline mrpt::obs::CObservationOdometry::Ptr makeOdometry(double time,
                                                         const mrpt::poses::CPose2D& pose)
{
  auto odometry = mrpt::obs::CObservationOdometry::Create();
  odometry->timestamp = mrpt::Clock::fromDouble(time);
  odometry->sensorLabel = "ODOMETRY";
  odometry->odometry = pose;
  return odometry;
}

inline mrpt::obs::CActionCollection::Ptr makeAction(const mrpt::poses::CPose2D& increment,
                                                    const mrpt::math::CMatrixDouble33& covariance)
{
  mrpt::obs::CActionRobotMovement2D movement;
  // Of odometry MRPT stores only the reading, of other estimates the distribution.
  movement.estimationMethod = mrpt::obs::CActionRobotMovement2D::emScan2DMatching;
  movement.poseChange = mrpt::poses::CPosePDFGaussian::Create(increment, covariance);
  auto actions = mrpt::obs::CActionCollection::Create();
  actions->insert(movement);
  return actions;
}

inline mrpt::obs::CSensoryFrame::Ptr makeFrame(const mrpt::obs::CObservation::Ptr& observation)
{
  auto frame = mrpt::obs::CSensoryFrame::Create();
  frame->insert(observation);
  return frame;
}

/// Returns the message of the exception that `call` throws, "" when it throws none.
template <class Exception, class Call>
std::string messageOf(Call&& call)
{
  try
  {
    call();
  }
  catch (const Exception& error)
  {
    return error.what();
  }
  return {};
}
}  // namespace sigloc::test

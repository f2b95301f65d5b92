// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>
#include <mrpt/core/bits_math.h>
#include <mrpt/poses/CPosePDFSOG.h>
#include <mrpt/serialization/CArchive.h>

#include <cmath>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <system_error>

#include "alignment_picture.h"
#include "arguments.h"
#include "picture_file.h"
#include "progress_line.h"
#include "sigloc/io/file_output.h"
#include "sigloc/io/map_files.h"
#include "sigloc/plugin/pose_pdf.h"
#include "warn.h"

namespace
{
namespace fs = std::filesystem;

constexpr const char* kProgram = "sigloc-align";
constexpr int kNoPose = 3;

std::shared_ptr<const sigloc::FeatureMap> readMap(const fs::path& path,
                                                  const sigloc::ReadingOptions& reading)
{
  sigloc::ProgressLine progress;
  auto map = std::make_shared<const sigloc::FeatureMap>(sigloc::buildMapFromFile(
      path, {}, {}, [&](double share) { progress.showBar("building the map", share); }, reading));
  progress.finish();
  sigloc::warn(kProgram, path, sigloc::warningOfMapSource(path));
  sigloc::warn(kProgram, path, sigloc::warningOfMap(*map));
  return map;
}

/// Throws std::runtime_error where an output would replace an input, has a wrong name, or cannot be
/// written.
void checkOutputs(const sigloc::AlignArguments& arguments)
{
  std::vector<fs::path> inputs = sigloc::filesOfMapSource(arguments.a);
  const std::vector<fs::path> more = sigloc::filesOfMapSource(arguments.b);
  inputs.insert(inputs.end(), more.begin(), more.end());
  const auto check = [&](const fs::path& output, const char* ending, const fs::path& other)
  {
    if (output.empty()) return;
    if (output.extension() != ending)
      throw std::runtime_error(output.string() + ": the name must end in " + ending);
    sigloc::refuseToReplaceInputs(output, inputs);
    if (output == other) throw std::runtime_error(output.string() + ": named twice");
    const auto folder = [](const fs::path& path) { return (path / "").lexically_normal(); };
    std::error_code unnameable;
    const bool in_new_folder = !arguments.output.empty() &&
                               !fs::exists(arguments.output, unnameable) &&
                               folder(output.parent_path()) == folder(arguments.output);
    if (!in_new_folder) sigloc::checkWritableFile(output);
  };
  if (!arguments.output.empty()) sigloc::checkWritableFolder(arguments.output);
  check(arguments.poses, ".CPosePDFSOG", arguments.picture);
  check(arguments.picture, ".png", arguments.poses);
}

void writePoses(const std::vector<sigloc::MapPose>& poses, const fs::path& path)
{
  sigloc::Belief belief;
  for (const sigloc::MapPose& pose : poses)
  {
    sigloc::TrackedHypothesis hypothesis;
    hypothesis.pose = pose.a_from_b;
    hypothesis.weight = pose.weight;
    belief.hypotheses.push_back(hypothesis);
  }
  mrpt::poses::CPosePDFSOG sum = sigloc::toSumOfGaussians(belief);
  // As printed, not scaled to a sum of one: what is left is no pose at all.
  for (std::size_t i = 0; i < poses.size(); ++i) sum.get(i).log_w = std::log(poses[i].weight);
  sigloc::writeObjects(path, [&](mrpt::serialization::CArchive& archive) { archive << sum; });
}

/// What to warn of where most places of the second map agree with none of the poses; else empty.
std::string warningOfPoses(const std::vector<sigloc::MapPose>& poses)
{
  double sum = 0;
  for (const sigloc::MapPose& pose : poses) sum += pose.weight;
  if (poses.empty() || sum >= 0.5) return {};
  return fmt::format("only {:.0f} % of its places agree with a pose: it may show another place",
                     100 * sum);
}

void print(const std::vector<sigloc::MapPose>& poses)
{
  if (poses.empty()) std::cout << "no pose of the second map in the first is possible\n";
  for (const sigloc::MapPose& pose : poses)
  {
    const mrpt::math::TPose2D& mean = pose.a_from_b.mean;
    const auto sd = [&](int i) { return std::sqrt(pose.a_from_b.covariance(i, i)); };
    std::cout << fmt::format(
        "x {:.3f} m, y {:.3f} m, {:.2f} deg (sd {:.3f} m, {:.3f} m, {:.2f} deg): seen so from "
        "{:.0f} "
        "% of its places; {:.0f} % of its walls over mapped space fit\n",
        mean.x, mean.y, mrpt::RAD2DEG(mean.phi), sd(0), sd(1), mrpt::RAD2DEG(sd(2)),
        100 * pose.weight, 100 * pose.explained);
  }
}
}  // namespace

int siglocAlign(const sigloc::AlignArguments& given)
{
  sigloc::AlignArguments arguments = given;
  if (!given.output.empty())
  {
    if (given.poses.empty()) arguments.poses = given.output / "poses.CPosePDFSOG";
    if (given.picture.empty()) arguments.picture = given.output / "align.png";
  }
  checkOutputs(arguments);
  const sigloc::ReadingOptions reading = arguments.reading.in({arguments.a, arguments.b});
  const auto a = readMap(arguments.a, reading);
  const auto b = readMap(arguments.b, reading);
  std::vector<sigloc::MapPose> poses;
  try
  {
    sigloc::ProgressLine progress;
    poses = sigloc::alignMaps(a, *b, arguments.options,
                              [&](double share) { progress.showBar("looking for it", share); });
  }
  catch (const std::invalid_argument& error)
  {
    const fs::path& named = a->field() ? arguments.b : arguments.a;
    throw std::runtime_error(named.string() + ": " + error.what());
  }
  print(poses);
  sigloc::warn(kProgram, arguments.b, warningOfPoses(poses));
  if (poses.empty()) return kNoPose;
  if (!given.output.empty()) fs::create_directories(given.output);
  if (!arguments.poses.empty()) writePoses(poses, arguments.poses);
  if (!arguments.picture.empty())
  {
    const std::string title = fmt::format("{} (red) in {}", arguments.b.filename().string(),
                                          arguments.a.filename().string());
    sigloc::savePicture(sigloc::alignmentPicture(*a->field(), *b->field(), poses, title),
                        arguments.picture);
  }
  return 0;
}

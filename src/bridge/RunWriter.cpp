// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/bridge/RunWriter.h"

#include <mrpt/core/bits_math.h>
#include <mrpt/io/CFileOutputStream.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/serialization/CArchive.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "run_folder.h"
#include "sigloc/bridge/output_guard.h"
#include "sigloc/bridge/pf_localization_files.h"
#include "sigloc/bridge/pose_pdf.h"

namespace sigloc
{
namespace
{
namespace fs = std::filesystem;
using nlohmann::ordered_json;

[[noreturn]] void failToWrite(const fs::path& path)
{
  throw std::runtime_error(path.string() + ": cannot write");
}

std::ofstream openText(const fs::path& path)
{
  std::ofstream file(path);
  if (!file) failToWrite(path);
  return file;
}

void closeText(std::ofstream& file, const fs::path& path)
{
  file.close();
  if (!file) failToWrite(path);
}

void writePath(const std::vector<StepRecord>& steps, const fs::path& path)
{
  std::ofstream file = openText(path);
  file << "# time x y z qx qy qz qw: first hypothesis of each step, map frame\n" << std::fixed;
  for (const StepRecord& step : steps)
  {
    if (step.belief.hypotheses.empty()) continue;
    const mrpt::math::TPose2D& pose = step.belief.hypotheses.front().pose.mean;
    file << std::setprecision(6) << step.time << ' ' << pose.x << ' ' << pose.y << " 0 0 0 "
         << std::setprecision(9) << std::sin(0.5 * pose.phi) << ' ' << std::cos(0.5 * pose.phi)
         << '\n';
  }
  closeText(file, path);
}

/// Writes `,a,b,c` of the first pose's fields, empty where there is none.
void writePoseColumns(std::ofstream& file, const Belief& belief)
{
  if (belief.hypotheses.empty())
  {
    file << ",,,,,,";
    return;
  }
  const GaussianPose& pose = belief.hypotheses.front().pose;
  const auto sd = [&](int i) { return std::sqrt(std::max(0.0, pose.covariance(i, i))); };
  file << ',' << pose.mean.x << ',' << pose.mean.y << ',' << mrpt::RAD2DEG(pose.mean.phi) << ','
       << sd(0) << ',' << sd(1) << ',' << mrpt::RAD2DEG(sd(2));
}

void writeSteps(const std::vector<StepRecord>& steps, const fs::path& path)
{
  std::ofstream file = openText(path);
  file << "step,time,travelled_m,verdict,probability,reliability,hypotheses,elsewhere,relocated,"
          "x,y,phi_deg,sd_x,sd_y,sd_phi_deg,error_m,error_deg,any_right,confidently_wrong,"
          "extraction_ms,tracking_ms,reason\n"
       << std::fixed << std::setprecision(6);
  for (const StepRecord& step : steps)
  {
    const Belief& belief = step.belief;
    file << step.number << ',' << step.time << ',' << step.travelled << ','
         << toString(belief.verdict) << ',' << belief.probability << ',' << belief.reliability
         << ',' << belief.hypotheses.size() << ',' << belief.elsewhere << ',' << step.relocated;
    writePoseColumns(file, belief);
    if (step.error)
    {
      file << ',' << step.error->distance << ',' << mrpt::RAD2DEG(step.error->angle) << ','
           << step.any_right << ',' << step.confidently_wrong;
    }
    else
    {
      file << ",,,,";
    }
    file << ',' << step.extraction_ms << ',' << step.tracking_ms << ','
         << ordered_json(belief.reason).dump() << '\n';
  }
  closeText(file, path);
}

template <class T>
ordered_json orNull(const std::optional<T>& value)
{
  return value ? ordered_json(*value) : ordered_json(nullptr);
}

/// The folder of a run's results as a whole path, without a slash at its end: "out/" is "out".
fs::path resultsFolder(const fs::path& folder)
{
  fs::path whole = fs::absolute(folder).lexically_normal();
  if (!whole.has_filename()) whole = whole.parent_path();
  // Results belong where a link points.
  return fs::is_symlink(whole) && fs::exists(whole) ? fs::canonical(whole) : whole;
}

fs::path workFolderBeside(const fs::path& results)
{
  return results.string() + ".partial";
}
}  // namespace

void checkRunFolder(const fs::path& folder, const std::vector<fs::path>& inputs)
{
  const fs::path results = resultsFolder(folder);
  refuseToReplaceInputs(results, inputs);
  refuseToReplaceInputs(workFolderBeside(results), inputs);
  detail::requireFinishedRun(results);
  detail::requireUnfinishedRun(workFolderBeside(results));
}

RunWriter::RunWriter(const fs::path& folder, const std::vector<fs::path>& inputs)
    : folder_(resultsFolder(folder)), work_(workFolderBeside(folder_))
{
  checkRunFolder(folder, inputs);
  std::error_code error = makeWorkFolder();
  if (error && fs::exists(folder_))
  {
    work_ = folder_ / detail::kInnerWork;
    error = makeWorkFolder();
  }
  if (error) throw std::runtime_error(folder.string() + ": " + error.message());
}

/// Makes an empty work folder with the parts that every run has.
std::error_code RunWriter::makeWorkFolder()
{
  std::error_code error;
  fs::remove_all(work_, error);
  created_ = work_;
  std::error_code ignored;
  while (!fs::exists(created_.parent_path(), ignored)) created_ = created_.parent_path();
  for (const char* const part : {"belief", "3D"})
  {
    if (!error) fs::create_directories(work_ / part, error);
  }
  return error;
}

/// Puts what was written in the place of an earlier run.
void RunWriter::replaceFolder()
{
  if (work_.parent_path() != folder_)
  {
    fs::remove_all(folder_);  // an earlier run, or empty: checked at the start
    fs::rename(work_, folder_);
    return;
  }
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_))
  {
    if (entry.path() != work_) fs::remove_all(entry.path());
  }
  for (const fs::directory_entry& entry : fs::directory_iterator(work_))
  {
    fs::rename(entry.path(), folder_ / entry.path().filename());
  }
  fs::remove(work_);
}

RunWriter::~RunWriter()
{
  std::error_code ignored;
  if (!finished_) fs::remove_all(created_, ignored);
}

fs::path RunWriter::mapCache(const fs::path& map_file) const
{
  if (work_.parent_path() == folder_) return {};  // nothing can be written beside the folder
  return folder_.parent_path() / (map_file.filename().string() + ".cache.sigmap");
}

void RunWriter::writeBelief(const StepRecord& step) const
{
  const mrpt::poses::CPosePDFSOG sum = toSumOfGaussians(step.belief);
  const fs::path stem = work_ / "belief" / stepName(step);
  const fs::path object_path = stem.string() + ".CPosePDFSOG";
  const fs::path text_path = stem.string() + ".txt";
  mrpt::io::CFileOutputStream file;
  if (!file.open(object_path.string())) failToWrite(object_path);
  mrpt::serialization::archiveFrom(file) << sum;
  if (!sum.saveToTextFile(text_path.string())) failToWrite(text_path);
}

void RunWriter::writeScene(const FeatureMap& map, const StepRecord& step,
                           const StepDrawing& drawing) const
{
  mrpt::opengl::COpenGLScene scene;
  scene.insert(drawMap(map));
  scene.insert(drawStep(drawing));
  const fs::path path = work_ / "3D" / (stepName(step) + ".3Dscene");
  if (!scene.saveToFile(path.string())) failToWrite(path);
}

void RunWriter::finish(const LocalizationRun& run)
{
  writePath(run.steps(), work_ / "path.tum");
  writeSteps(run.steps(), work_ / "steps.csv");
  writeAnnotatedRawlog(run.setup().rawlog_file, run.steps(), work_ / "annotated.rawlog");
  writePfLocalizationFiles(run, work_);
  std::ofstream file = openText(work_ / detail::kRunSummaryFile);
  file << toJson(run.summary()) << '\n';
  closeText(file, work_ / detail::kRunSummaryFile);
  replaceFolder();
  finished_ = true;
}

std::string stepName(const StepRecord& step)
{
  std::string number = std::to_string(step.number);
  constexpr std::size_t kDigits = 5;
  if (number.size() < kDigits) number.insert(0, kDigits - number.size(), '0');
  return "step_" + number;
}

std::string toJson(const RunSummary& summary)
{
  ordered_json json;
  json["steps"] = summary.steps;
  json["distance_m"] = summary.distance;
  json["steps_to_first_right"] = orNull(summary.steps_to_first_right);
  json["meters_to_first_right"] = orNull(summary.metres_to_first_right);
  json["steps_to_localized"] = orNull(summary.steps_to_localized);
  json["meters_to_localized"] = orNull(summary.metres_to_localized);
  json["final_error_m"] = nullptr;
  json["final_error_deg"] = nullptr;
  if (summary.final_error)
  {
    json["final_error_m"] = summary.final_error->distance;
    json["final_error_deg"] = mrpt::RAD2DEG(summary.final_error->angle);
  }
  json["final_verdict"] = toString(summary.final_verdict);
  json["final_pose"] = nullptr;
  if (const auto& pose = summary.final_pose) json["final_pose"] = {pose->x, pose->y, pose->phi};
  json["confidently_wrong_steps"] = summary.confidently_wrong_steps;
  json["relocation_ms_median"] = summary.relocation_ms_median;
  json["relocation_ms_p95"] = summary.relocation_ms_p95;
  json["step_ms_median"] = summary.step_ms_median;
  json["step_ms_p95"] = summary.step_ms_p95;
  json["relocations"] = summary.relocations;
  json["map_features"] = summary.map_features;
  json["map_reused"] = summary.map_reused;
  json["map_seconds"] = summary.map_seconds;
  json["seed"] = summary.seed;
  json["truncated"] = summary.truncated;
  json["converged"] = orNull(summary.converged);
  return json.dump(2);
}
}  // namespace sigloc

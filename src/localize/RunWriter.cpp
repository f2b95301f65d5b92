// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/localize/RunWriter.h"

#include <mrpt/core/bits_math.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/serialization/CArchive.h>

#include <cmath>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "config/TextStream.h"
#include "localize/pf_localization_files.h"
#include "localize/run_folder.h"
#include "sigloc/io/file_output.h"
#include "sigloc/plugin/pose_pdf.h"

namespace sigloc
{
namespace
{
namespace fs = std::filesystem;
using nlohmann::ordered_json;

std::string pathRows(const std::vector<StepRecord>& steps)
{
  TextStream file;
  file << "# time x y z qx qy qz qw: first hypothesis of each step, map frame\n" << std::fixed;
  for (const StepRecord& step : steps)
  {
    if (step.belief.hypotheses.empty()) continue;
    const mrpt::math::TPose2D& pose = step.belief.hypotheses.front().pose.mean;
    file << std::setprecision(6) << step.time << ' ' << pose.x << ' ' << pose.y << " 0 0 0 "
         << std::setprecision(9) << std::sin(0.5 * pose.phi) << ' ' << std::cos(0.5 * pose.phi)
         << '\n';
  }
  return file.str();
}

/// Writes `,a,b,c` of the first pose's fields, empty where there is none.
void writePoseColumns(std::ostream& file, const Belief& belief)
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

std::string stepRows(const std::vector<StepRecord>& steps)
{
  TextStream file;
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
  return file.str();
}

/// Rows `weight x y phi C11 C22 C33 C12 C13 C23`, as MRPT writes them.
std::string modeRows(const mrpt::poses::CPosePDFSOG& sum)
{
  TextStream rows;
  rows << std::scientific;
  for (const auto& mode : sum)
  {
    const auto& c = mode.cov;
    rows << std::exp(mode.log_w) << ' ' << mode.mean.x() << ' ' << mode.mean.y() << ' '
         << mode.mean.phi() << ' ' << c(0, 0) << ' ' << c(1, 1) << ' ' << c(2, 2) << ' ' << c(0, 1)
         << ' ' << c(0, 2) << ' ' << c(1, 2) << '\n';
  }
  return rows.str();
}

/// An object as MRPT stores it in a file that is not compressed.
std::string bytesOf(const mrpt::serialization::CSerializable& object)
{
  mrpt::io::CMemoryStream memory;
  mrpt::serialization::archiveFrom(memory) << object;
  return {static_cast<const char*>(memory.getRawBufferData()), memory.getTotalBytesCount()};
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
  writeFile(stem.string() + ".CPosePDFSOG", bytesOf(sum));
  writeFile(stem.string() + ".txt", modeRows(sum));
}

void RunWriter::writeScene(const FeatureMap& map, const StepRecord& step,
                           const StepDrawing& drawing) const
{
  mrpt::opengl::COpenGLScene scene;
  scene.insert(drawMap(map));
  scene.insert(drawStep(drawing));
  writeObjects(work_ / "3D" / (stepName(step) + ".3Dscene"),
               [&](mrpt::serialization::CArchive& archive) { archive << scene; });
}

void RunWriter::finish(const LocalizationRun& run)
{
  writeFile(work_ / "path.tum", pathRows(run.steps()));
  writeFile(work_ / "steps.csv", stepRows(run.steps()));
  writeAnnotatedRawlog(run.setup().rawlog_file, run.steps(), work_ / "annotated.rawlog");
  writePfLocalizationFiles(run, work_);
  writeFile(work_ / detail::kRunSummaryFile, toJson(run.summary()) + "\n");
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

// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/localize/RunWriter.h"

#include <fmt/core.h>
#include <mrpt/core/bits_math.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/opengl/CText3D.h>
#include <mrpt/serialization/CArchive.h>

#include <cmath>
#include <stdexcept>

#include "config/columns.h"
#include "localize/pf_localization_files.h"
#include "localize/run_folder.h"
#include "localize/run_page.h"
#include "sigloc/io/file_output.h"
#include "sigloc/plugin/pose_pdf.h"

namespace sigloc
{
namespace
{
namespace fs = std::filesystem;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// The first hypotheses of the steps that are localized, or of the others.
std::string pathRows(const std::vector<StepRecord>& steps, bool localized)
{
  std::string rows = fmt::format(
      "# time x y z qx qy qz qw, map frame: first hypothesis of {}\n",
      localized ? "each step that is localized" : "each step that is NOT LOCALIZED, perhaps wrong");
  for (const StepRecord& step : steps)
  {
    if (step.belief.hypotheses.empty()) continue;
    if ((step.belief.verdict == Verdict::localized) != localized) continue;
    const mrpt::math::TPose2D& pose = step.belief.hypotheses.front().pose.mean;
    rows += fmt::format("{:.6f} {:.6f} {:.6f} 0 0 0 {:.9f} {:.9f}\n", step.time, pose.x, pose.y,
                        std::sin(0.5 * pose.phi), std::cos(0.5 * pose.phi));
  }
  return rows;
}

/// The first hypothesis and its standard deviations.
Written firstPose(const StepRecord& step)
{
  if (step.belief.hypotheses.empty()) return {{}, Cells(6)};
  const GaussianPose& pose = step.belief.hypotheses.front().pose;
  const auto sd = [&](int i) { return std::sqrt(std::max(0.0, pose.covariance(i, i))); };
  Written row;
  for (const double value :
       {pose.mean.x, pose.mean.y, mrpt::RAD2DEG(pose.mean.phi), sd(0), sd(1), mrpt::RAD2DEG(sd(2))})
  {
    row.cells.push_back(fixedNumber(value, 6));
  }
  return row;
}

/// None where there is no pose.
std::optional<double> probabilityOfFirst(const StepRecord& step)
{
  if (step.belief.hypotheses.empty()) return std::nullopt;
  return step.belief.probabilityOfFirst();
}

/// How it compares with the truth, where there is one.
Written judgement(const StepRecord& step)
{
  if (!step.error) return {{}, Cells(4)};
  return {{},
          {fixedNumber(step.error->distance, 6), fixedNumber(mrpt::RAD2DEG(step.error->angle), 6),
           std::to_string(step.any_right), std::to_string(step.confidently_wrong)}};
}

/// What steps.csv holds of a step.
Columns<StepRecord> stepColumns()
{
  using S = StepRecord;
  using C = Column<S>;
  return {
      C("step", &S::number),
      C("time", &S::time, "[s]", 6),
      C("travelled_m", &S::travelled, "", 6),
      C("verdict", [](const S& step) { return step.belief.verdict; }),
      C(
          "verdict_probability", [](const S& step) { return step.belief.probability; }, "", 6),
      C(
          "first_pose_probability", [](const S& step) { return probabilityOfFirst(step); }, "", 6),
      C(
          "reliability", [](const S& step) { return step.belief.reliability; }, "", 6),
      C("hypotheses", [](const S& step) { return step.belief.hypotheses.size(); }),
      C(
          "elsewhere", [](const S& step) { return step.belief.elsewhere; }, "", 6),
      C("relocated", &S::relocated),
      C("x,y,phi_deg,sd_x,sd_y,sd_phi_deg", firstPose),
      C("error_m,error_deg,any_right,confidently_wrong", judgement),
      C("reason", [](const S& step) { return nlohmann::ordered_json(step.belief.reason).dump(); })};
}

/// What summary.json is made of.
struct Figures : RunSummary
{
  const LocalizationRun& run;
};

Columns<Figures> summaryColumns()
{
  using F = Figures;
  using C = Column<F>;
  return {
      C("steps", &F::steps),
      C("distance_m", &F::distance),
      C("steps_to_first_right", &F::steps_to_first_right),
      C("first_right_after_m", &F::metres_to_first_right),
      C("steps_to_localized", &F::steps_to_localized),
      C("localized_after_m", &F::metres_to_localized),
      C("final_error_m",
        [](const F& f) { return f.final_error ? f.final_error->distance : kNone; }),
      C("final_error_deg",
        [](const F& f) { return f.final_error ? mrpt::RAD2DEG(f.final_error->angle) : kNone; }),
      C("final_verdict", &F::final_verdict),
      C("final_pose", &F::final_pose),
      C("final_pose_probability",
        [](const F& f) { return f.final_pose ? f.final_probability : kNone; }),
      C("final_reason", &F::final_reason),
      C("localized_steps", &F::localized_steps),
      C("localized_m", &F::localized_metres),
      C("times_lost", &F::times_lost),
      C("odometry_turn_deg",
        [](const F& f) { return f.odometry ? mrpt::RAD2DEG(f.odometry->turn) : kNone; }),
      C("odometry_stretch", [](const F& f) { return f.odometry ? f.odometry->stretch : kNone; }),
      C("confidently_wrong_steps", &F::confidently_wrong_steps),
      C("relocations", [](const F& f) { return f.relocation.steps; }),
      C("map_features", [](const F& f) { return f.run.map().features().size(); }),
      C("map_reused", &F::map_reused),
      C("seed", [](const F& f) { return f.run.setup().matcher.seed; }),
      C("truncated", &F::truncated),
      C("converged", &F::converged)};
}

/// Rows `weight x y phi C11 C22 C33 C12 C13 C23`, as MRPT writes them.
std::string modeRows(const mrpt::poses::CPosePDFSOG& sum)
{
  std::string rows;
  for (const auto& mode : sum)
  {
    const auto& c = mode.cov;
    rows += fmt::format("{:e} {:e} {:e} {:e} {:e} {:e} {:e} {:e} {:e} {:e}\n", std::exp(mode.log_w),
                        mode.mean.x(), mode.mean.y(), mode.mean.phi(), c(0, 0), c(1, 1), c(2, 2),
                        c(0, 1), c(0, 2), c(1, 2));
  }
  return rows;
}

/// An object as MRPT stores it in a file that is not compressed.
std::string bytesOf(const mrpt::serialization::CSerializable& object)
{
  mrpt::io::CMemoryStream memory;
  mrpt::serialization::archiveFrom(memory) << object;
  return {static_cast<const char*>(memory.getRawBufferData()), memory.getTotalBytesCount()};
}

/// Lets viewers start above and behind a place, with its surroundings in view.
void lookAt(const mrpt::math::TPose2D& place, mrpt::opengl::COpenGLScene& scene)
{
  constexpr float kDistance = 35;  // [m]
  mrpt::opengl::CCamera& camera = scene.getViewport()->getCamera();
  camera.setPointingAt(static_cast<float>(place.x), static_cast<float>(place.y), 0);
  camera.setZoomDistance(kDistance);
  camera.setAzimuthDegrees(-90);
  camera.setElevationDegrees(60);
  scene.enableFollowCamera(true);
}

/// A warning that lies on the floor before a pose that is not sure.
mrpt::opengl::CText3D::Ptr unsureLabel(const mrpt::math::TPose2D& pose)
{
  constexpr double kBeside = 3.0;  // [m]
  auto label = mrpt::opengl::CText3D::Create("NOT LOCALIZED");
  label->setColor_u8(Palette::kNotLocalized);
  label->setPose(mrpt::math::TPose3D(pose.x - kBeside, pose.y - kBeside, 1, 0, 0, 0));
  return label;
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
  detail::requireNoOtherRun(workFolderBeside(results));
  detail::requireNoOtherRun(results / detail::kInnerWork);
  detail::requireFinishedRun(results);
  detail::requireUnfinishedRun(workFolderBeside(results));
}

RunWriter::RunWriter(const fs::path& folder, const std::vector<fs::path>& inputs)
    : folder_(resultsFolder(folder)), work_(workFolderBeside(folder_))
{
  checkRunFolder(folder, inputs);
  // The folder of another user stays that user's, and a mount point stays where it is: they are
  // filled, not replaced.
  const bool stays = detail::isOfAnotherUser(folder_) || detail::isMountPoint(folder_);
  if (!stays) detail::recoverRun(work_, folder_);
  std::error_code error =
      stays ? std::make_error_code(std::errc::operation_not_permitted) : makeWorkFolder();
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
  created_ = work_;
  std::error_code error;
  while (!fs::exists(created_.parent_path(), error)) created_ = created_.parent_path();
  try
  {
    lock_ = std::make_unique<detail::FolderLock>(work_);
  }
  catch (const fs::filesystem_error& failed)
  {
    return failed.code();
  }
  // What another run has finished since the folders were checked is replaced, or refused.
  try
  {
    detail::requireFinishedRun(folder_);
  }
  catch (const std::runtime_error&)
  {
    fs::remove_all(created_, error);
    throw;
  }
  error.clear();
  for (const fs::directory_entry& entry : fs::directory_iterator(work_, error))
  {
    if (!error) fs::remove_all(entry.path(), error);
  }
  for (const char* const part : {"belief", "3D"})
  {
    if (!error) fs::create_directories(work_ / part, error);
  }
  return error;
}

RunWriter::~RunWriter()
{
  std::error_code ignored;
  if (!finished_) fs::remove_all(created_, ignored);
}

void RunWriter::writeBelief(const StepRecord& step, const GaussianPose& anywhere) const
{
  const mrpt::poses::CPosePDFSOG sum = toSumOfGaussians(withElsewhere(step.belief, anywhere));
  const fs::path stem = work_ / "belief" / stepName(step);
  writeFile(stem.string() + ".CPosePDFSOG", bytesOf(sum), Durability::with_folder);
  writeFile(stem.string() + ".txt", modeRows(sum), Durability::with_folder);
}

void RunWriter::writeScene(const FeatureMap& map, const StepRecord& step,
                           const StepDrawing& drawing) const
{
  mrpt::opengl::COpenGLScene scene;
  scene.insert(drawMap(map));
  scene.insert(drawStep(drawing));
  const auto& hypotheses = step.belief.hypotheses;
  if (!hypotheses.empty())
  {
    const mrpt::math::TPose2D& first = hypotheses.front().pose.mean;
    if (step.belief.verdict != Verdict::localized) scene.insert(unsureLabel(first));
    lookAt(first, scene);
  }
  writeObjects(
      work_ / "3D" / (stepName(step) + ".3Dscene"),
      [&](mrpt::serialization::CArchive& archive) { archive << scene; }, Packing::quick_gzip,
      Durability::with_folder);
}

void RunWriter::finish(const LocalizationRun& run)
{
  const auto write = [&](const char* name, const std::string& bytes)
  { writeFile(work_ / name, bytes, Durability::with_folder); };
  write("path.tum", pathRows(run.steps(), true));
  write("path_unsure.tum", pathRows(run.steps(), false));
  write("steps.csv", csvFile(stepColumns(), run.steps()));
  writeAnnotatedRawlog(run, work_ / "annotated.rawlog", Durability::with_folder);
  writePfLocalizationFiles(run, work_);
  if (!run.setup().stats_only) write(detail::kRunPageFile, detail::runPage(run));
  write(detail::kRunSummaryFile,
        toJson(summaryColumns(), Figures{run.summary(), run}).dump(2) + "\n");
  syncFolder(work_);
  finished_ = true;
  detail::replaceRun(work_, folder_);
  syncFolder(folder_);
}

std::string stepName(const StepRecord& step)
{
  std::string number = std::to_string(step.number);
  constexpr std::size_t kDigits = 5;
  if (number.size() < kDigits) number.insert(0, kDigits - number.size(), '0');
  return "step_" + number;
}
}  // namespace sigloc

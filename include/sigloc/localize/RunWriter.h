// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "sigloc/io/file_output.h"
#include "sigloc/localize/LocalizationRun.h"
#include "sigloc/plugin/map_drawing.h"

namespace sigloc
{
namespace detail
{
class FolderLock;
}

/// Throws std::runtime_error ("folder: reason") when a run that writes into `folder` would replace
/// one of `inputs`, or anything but an earlier run of sigloc-localize. Such a run has a
/// summary.json. Throws the same while another run writes into `folder`.
void checkRunFolder(const std::filesystem::path& folder,
                    const std::vector<std::filesystem::path>& inputs);

/// Writes the output folder of a run, all or nothing: into `<folder>.partial` first, which takes
/// the folder's name in finish(). Where nothing can be made beside an existing folder, it is
/// `<folder>/.partial`.
///
/// * `belief/step_00001.CPosePDFSOG`: the belief after step 1 as an MRPT object; `.txt`: as rows
///   `weight x y phi C11 C22 C33 C12 C13 C23`. Unless localized, "somewhere else" is the last row
/// * `3D/step_00001.3Dscene`: map and step, for SceneViewer3D
/// * `path.tum`: first hypothesis of each step that is localized, `time x y z qx qy qz qw`;
///   `path_unsure.tum`: of each other step
/// * `steps.csv`: one row a step
/// * `annotated.rawlog`: the log with the pose and the belief of each step, see
///   writeAnnotatedRawlog()
/// * `summary.json`: the figures of RunSummary
/// * `report.html`: every step on a page for a browser; not with LocalizationSetup::stats_only
/// * what pf-localization's log folder holds, see writePfLocalizationFiles()
class RunWriter
{
 public:
  /// Throws as checkRunFolder() does, and when `folder` cannot be written.
  RunWriter(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& inputs);
  /// Removes what an unfinished run has written.
  ~RunWriter();
  RunWriter(const RunWriter&) = delete;
  RunWriter& operator=(const RunWriter&) = delete;

  /// Where files belong until finish(), pictures of an app included.
  const std::filesystem::path& workFolder() const { return work_; }

  /// Writes `belief/step_00012.CPosePDFSOG` and `.txt`. `anywhere`: LocalizationRun::anywhere().
  /// Throws std::runtime_error for a file that cannot be written, as the next two do.
  void writeBelief(const StepRecord& step, const GaussianPose& anywhere) const;
  /// Writes `3D/step_00012.3Dscene`.
  void writeScene(const FeatureMap& map, const StepRecord& step, const StepDrawing& drawing) const;
  /// Writes everything that covers the whole run and gives the folder its name.
  void finish(const LocalizationRun& run);

 private:
  std::error_code makeWorkFolder();

  std::filesystem::path folder_;
  std::filesystem::path work_;
  std::unique_ptr<detail::FolderLock> lock_;  // of the work folder
  std::filesystem::path created_;  // the topmost folder that did not exist before
  bool finished_ = false;
};

/// "step_00012", the common stem of a step's files.
std::string stepName(const StepRecord& step);

/// Copies the run's rawlog and adds two observations a step: into the sensory frame, or after the
/// step's last scan. The copy ends where reading the log ends. Any MRPT program reads it.
///
/// * toRobotPoseObservation(): the first pose, labelled "sigloc" or "sigloc_unsure"; none without
///   hypotheses
/// * a CObservationComment, of which MRPT stores no label; its text is a JSON object
///
/// The object has `source`, "sigloc", `verdict`, `first_pose_probability`, `elsewhere`, `reason`,
/// `hypotheses` and, in the robot frame, `features`. A hypothesis has `probability`, `x`, `y`,
/// `phi_deg` and `covariance`, row by row [m^2, m rad, rad^2].
void writeAnnotatedRawlog(const LocalizationRun& run, const std::filesystem::path& output,
                          Durability durability = Durability::at_once);

/// What one run adds to `<prefix>_SUMMARY.txt`.
struct ExperimentOutcome
{
  std::optional<bool> converged;
  std::size_t particles = 0;  ///< 0: no particles
  double seconds = 0;  ///< spent on its steps
  std::vector<double> errors;  ///< [m], of the steps with truth
};
/// Returns what a finished run adds.
ExperimentOutcome outcomeOf(const LocalizationRun& run);

/// Returns pf-localization's summary of one experiment's repetitions: a comment with the columns
/// and one row. The ratio of convergence is `nan` when no run was tested, the errors are `nan`
/// without truth; the interval reaches from quantile `confidence_share` to one minus it.
std::string experimentSummary(const std::vector<ExperimentOutcome>& repetitions,
                              double confidence_share);

/// Returns the file of that summary: `_SUMMARY.txt` in the folder of the only run, or, where
/// several runs have a folder each, `<folder>_SUMMARY.txt` beside them. Throws std::runtime_error
/// when a file of that name is something else than the summary of earlier runs.
std::filesystem::path experimentSummaryFile(const std::filesystem::path& folder, bool several_runs);
}  // namespace sigloc

// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPose2D.h>

#include <memory>
#include <string>
#include <vector>

#include "OffscreenRenderer.h"
#include "sigloc/plugin/map_drawing.h"

namespace sigloc
{
/// Makes the pictures of a run: the whole map and, right of it or below it, the surroundings of the
/// first hypothesis, with text and legend. The map is uploaded once.
class PictureMaker
{
 public:
  /// Throws std::runtime_error when off-screen rendering is impossible.
  explicit PictureMaker(const FeatureMap& map);
  ~PictureMaker();

  /// Returns the whole map alone.
  mrpt::img::CImage mapPicture(const std::vector<std::string>& title);

  /// Returns overview and close-up in one picture. A close-up of a step that is not localized has a
  /// red frame and says NOT LOCALIZED. Line widths and mark sizes of `step` are set
  /// here.
  mrpt::img::CImage stepPicture(const StepDrawing& step, const std::vector<std::string>& title);

  /// A pose to draw a close-up of.
  struct CloseUp
  {
    mrpt::math::TPose2D scan_at;  ///< where the step's scan is drawn
    std::string title;
  };

  /// Returns the overview without the scan, and a close-up of each pose with the scan drawn there.
  mrpt::img::CImage comparison(const StepDrawing& step, const std::vector<std::string>& title,
                               const std::vector<CloseUp>& places);

 private:
  struct Panel;
  mrpt::img::CImage picture(Panel& panel);
  mrpt::img::CImage join(const std::vector<mrpt::img::CImage>& pictures) const;

  OffscreenRenderer renderer_;  // first: its context outlives the scenes below
  std::unique_ptr<Panel> overview_;
  std::unique_ptr<Panel> close_up_;
};
}  // namespace sigloc

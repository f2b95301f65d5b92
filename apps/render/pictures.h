// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "OffscreenRenderer.h"
#include "sigloc/bridge/scene_building.h"

namespace sigloc
{
/// Makes the pictures of a run: on the left the whole map, on the right the surroundings of the
/// first hypothesis, each panel with text and legend. The map is uploaded once.
class PictureMaker
{
 public:
  /// Size of one panel [pixels]. Throws std::runtime_error when off-screen rendering is impossible.
  explicit PictureMaker(const FeatureMap& map, unsigned panel_width = 960,
                        unsigned panel_height = 1080);
  ~PictureMaker();

  /// Returns the whole map alone, one panel.
  mrpt::img::CImage mapPicture(const std::vector<std::string>& title);

  /// Returns the two panels side by side. Line widths and mark sizes of `step` are set here.
  mrpt::img::CImage stepPicture(const StepDrawing& step, const std::vector<std::string>& title);

 private:
  struct Panel;
  OffscreenRenderer renderer_;  // first: its context outlives the scenes below
  std::unique_ptr<Panel> overview_;
  std::unique_ptr<Panel> close_up_;
};
}  // namespace sigloc

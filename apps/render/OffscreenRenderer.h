// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/img/CImage.h>
#include <mrpt/opengl/COpenGLScene.h>

#include <memory>

namespace sigloc
{
/// What a top-down picture shows.
struct View
{
  double x = 0;  ///< [m], centre in the map frame
  double y = 0;  ///< [m]
  double height = 10;  ///< [m] from the lower to the upper edge
};

/// Size of a picture [pixels].
struct PictureSize
{
  unsigned width = 0;
  unsigned height = 0;
};

/// Renders scenes from straight above without a display, through OSMesa. Linked or loaded by
/// executables only: a plug-in must not bring a second GL into a viewer.
///
/// Use one object in a process, from one thread. It must outlive every scene it has rendered,
/// because scenes keep GL buffers of its context.
class OffscreenRenderer
{
 public:
  /// Throws std::runtime_error when no GL context can be made.
  OffscreenRenderer();
  ~OffscreenRenderer();
  OffscreenRenderer(const OffscreenRenderer&) = delete;
  OffscreenRenderer& operator=(const OffscreenRenderer&) = delete;

  /// Returns a picture of the given size [pixels].
  mrpt::img::CImage render(const mrpt::opengl::COpenGLScene& scene, const View& view,
                           const PictureSize& size);

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};
}  // namespace sigloc

// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "OffscreenRenderer.h"

#include <GL/osmesa.h>
#include <mrpt/opengl/CFBORender.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <vector>

namespace sigloc
{
namespace
{
constexpr unsigned kSuperSampling = 2;  // the renderer itself does not smooth edges
constexpr int kDummySide = 16;

OSMesaContext makeContext()
{
  const std::array<int, 13> attributes = {OSMESA_FORMAT,
                                          OSMESA_RGBA,
                                          OSMESA_DEPTH_BITS,
                                          24,
                                          OSMESA_STENCIL_BITS,
                                          8,
                                          OSMESA_PROFILE,
                                          OSMESA_CORE_PROFILE,
                                          OSMESA_CONTEXT_MAJOR_VERSION,
                                          3,
                                          OSMESA_CONTEXT_MINOR_VERSION,
                                          3,
                                          0};
  return OSMesaCreateContextAttribs(attributes.data(), nullptr);
}
}  // namespace

struct OffscreenRenderer::Context
{
  OSMesaContext handle = makeContext();
  // OSMesa wants a colour buffer to make a context current; the pictures are drawn elsewhere.
  std::vector<unsigned char> dummy = std::vector<unsigned char>(4 * kDummySide * kDummySide);
  std::unique_ptr<mrpt::opengl::CFBORender> target;

  Context(unsigned width, unsigned height)
  {
    const bool current =
        handle != nullptr && OSMesaMakeCurrent(handle, dummy.data(), GL_UNSIGNED_BYTE, kDummySide,
                                               kDummySide) != GL_FALSE;
    if (!current || glGetString(GL_VERSION) == nullptr)
    {
      if (handle != nullptr) OSMesaDestroyContext(handle);
      throw std::runtime_error(
          "OSMesa: no off-screen GL context (another libGL answered first? "
          "LD_PRELOAD=libOSMesa.so.8 repairs that)");
    }
    mrpt::opengl::CFBORender::Parameters parameters(width, height);
    parameters.create_EGL_context = false;
    target = std::make_unique<mrpt::opengl::CFBORender>(parameters);
  }
  ~Context()
  {
    target.reset();
    OSMesaDestroyContext(handle);
  }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
};

OffscreenRenderer::OffscreenRenderer(unsigned width, unsigned height)
    : width_(width),
      height_(height),
      context_(std::make_unique<Context>(kSuperSampling * width, kSuperSampling * height))
{
}

OffscreenRenderer::~OffscreenRenderer() = default;

mrpt::img::CImage OffscreenRenderer::render(const mrpt::opengl::COpenGLScene& scene,
                                            const View& view)
{
  auto& camera = context_->target->getCamera(scene);
  camera.setOrthogonal();
  camera.setAzimuthDegrees(-90);
  camera.setElevationDegrees(90);
  camera.setPointingAt(static_cast<float>(view.x), static_cast<float>(view.y), 0);
  // MRPT's orthogonal camera shows half of its "distance" along the shorter side of the picture.
  const double shorter_to_height = std::min(1.0, static_cast<double>(width_) / height_);
  camera.setZoomDistance(static_cast<float>(2 * view.height * shorter_to_height));
  mrpt::img::CImage large;
  context_->target->render_RGB(scene, large);
  mrpt::img::CImage small;
  large.scaleImage(small, width_, height_, mrpt::img::IMG_INTERP_AREA);
  return small;
}
}  // namespace sigloc

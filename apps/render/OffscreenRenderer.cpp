// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "OffscreenRenderer.h"

#include <GL/osmesa.h>
#include <mrpt/opengl/CFBORender.h>

#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

// Missing where the program did not expect pictures: OSMesa takes long to load.
#pragma weak OSMesaCreateContextAttribs
#pragma weak OSMesaMakeCurrent
#pragma weak OSMesaDestroyContext

namespace sigloc
{
namespace
{
constexpr unsigned kSuperSampling = 2;  // the renderer itself does not smooth edges
constexpr int kDummySide = 16;

OSMesaContext makeContext()
{
  if (&OSMesaCreateContextAttribs == nullptr) return nullptr;
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
  // OSMesa needs a colour buffer to make a context current. The pictures are drawn into other
  // buffers.
  std::vector<unsigned char> dummy = std::vector<unsigned char>(4 * kDummySide * kDummySide);
  // One for each picture size.
  std::map<std::pair<unsigned, unsigned>, std::unique_ptr<mrpt::opengl::CFBORender>> targets;

  Context()
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
  }
  ~Context()
  {
    targets.clear();
    OSMesaDestroyContext(handle);
  }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  mrpt::opengl::CFBORender& target(const PictureSize& size)
  {
    auto& target = targets[{size.width, size.height}];
    if (!target)
    {
      mrpt::opengl::CFBORender::Parameters parameters(kSuperSampling * size.width,
                                                      kSuperSampling * size.height);
      parameters.create_EGL_context = false;
      target = std::make_unique<mrpt::opengl::CFBORender>(parameters);
    }
    return *target;
  }
};

OffscreenRenderer::OffscreenRenderer() : context_(std::make_unique<Context>()) {}

OffscreenRenderer::~OffscreenRenderer() = default;

mrpt::img::CImage OffscreenRenderer::render(const mrpt::opengl::COpenGLScene& scene,
                                            const View& view, const PictureSize& size)
{
  auto& target = context_->target(size);
  auto& camera = target.getCamera(scene);
  camera.setOrthogonal();
  camera.setAzimuthDegrees(-90);
  camera.setElevationDegrees(90);
  camera.setPointingAt(static_cast<float>(view.x), static_cast<float>(view.y), 0);
  // MRPT's orthogonal camera shows half of its "distance" along the shorter side of the picture.
  const double shorter_to_height = std::min(1.0, static_cast<double>(size.width) / size.height);
  camera.setZoomDistance(static_cast<float>(2 * view.height * shorter_to_height));
  mrpt::img::CImage large;
  target.render_RGB(scene, large);
  mrpt::img::CImage small;
  large.scaleImage(small, size.width, size.height, mrpt::img::IMG_INTERP_AREA);
  return small;
}
}  // namespace sigloc

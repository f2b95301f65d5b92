// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "localize/page_map.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "map/field_tiles.h"
#include "sigloc/plugin/map_drawing.h"

namespace sigloc::detail
{
using nlohmann::ordered_json;

namespace
{
constexpr std::uint32_t kMostPixels = 1200;  // of the map's longer side

/// The raster, shrunk: "runs" has how many pixels are unknown, free, wall, unknown, ... in turn,
/// row by row from below.
ordered_json shrunkRaster(const DenseField& field)
{
  const RasterFrame& frame = field.frame;
  const std::uint32_t block =
      std::max(1U, (std::max(frame.width, frame.height) + kMostPixels - 1) / kMostPixels);
  const ShrunkField shrunk = shrunkField(field, block);
  std::vector<std::uint32_t> runs(1);
  const auto add = [&](std::uint32_t shade)
  {
    while ((runs.size() - 1) % 3 != shade) runs.push_back(0);
    ++runs.back();
  };
  for (const CellState state : shrunk.states)
  {
    add(isWall(state) ? 2 : static_cast<std::uint32_t>(state));
  }
  return {{"width", shrunk.width},
          {"height", shrunk.height},
          {"x", frame.origin.x},
          {"y", frame.origin.y},
          {"pixel", frame.resolution * block},
          {"shades", {Palette::kUnknownShade, Palette::kFreeShade, Palette::kWallShade}},
          {"runs", runs}};
}

std::string webColor(const mrpt::img::TColor& color)
{
  return fmt::format("#{:02x}{:02x}{:02x}", color.R, color.G, color.B);
}

ordered_json pageColors()
{
  const auto& [red, green, blue] = traitsOf(FeatureType::segment).color;
  return {{"mapped", webColor({red, green, blue})},
          {"returns", webColor(Palette::kReturns)},
          {"observed", webColor(Palette::kObserved)},
          {"unlikely", webColor(Palette::kUnlikely)},
          {"likely", webColor(Palette::kLikely)},
          {"sure", webColor(Palette::kSurePose)},
          {"unsure", webColor(Palette::kUnsurePose)},
          {"path", webColor(Palette::kPath)},
          {"truth", webColor(Palette::kTruth)},
          {"not_localized", webColor(Palette::kNotLocalized)}};
}

}  // namespace

double rounded(double value, int digits)
{
  const double unit = std::pow(10, digits);
  return std::round(value * unit) / unit;
}

ordered_json pagePose(const mrpt::math::TPose2D& pose)
{
  return {rounded(pose.x, 3), rounded(pose.y, 3), rounded(pose.phi, 4)};
}

ordered_json pageMarks(const std::vector<Feature>& features)
{
  ordered_json marks = ordered_json::array();
  for (const Feature& feature : features)
  {
    ordered_json mark = ordered_json::array();
    const auto add = [&](const mrpt::math::TPoint2D& p)
    {
      mark.push_back(rounded(p.x, 2));
      mark.push_back(rounded(p.y, 2));
    };
    if (isSegment(feature.type))
    {
      add(segmentStart(feature));
      add(segmentEnd(feature));
    }
    else
    {
      add(feature.position);
    }
    marks.push_back(std::move(mark));
  }
  return marks;
}

ordered_json pageMap(const FeatureMap& map)
{
  const PlanarBox box = boundsOf(map);
  ordered_json json;
  json["colors"] = pageColors();
  json["box"] = {box.x_min, box.x_max, box.y_min, box.y_max};
  json["raster"] = map.field() ? shrunkRaster(*map.field()) : ordered_json(nullptr);
  json["marks"] = map.field() ? ordered_json::array() : pageMarks(map.features());
  return json;
}

std::string textForScript(const ordered_json& json)
{
  std::string text = json.dump(-1, ' ', true, ordered_json::error_handler_t::replace);
  for (std::size_t at = text.find("</"); at != std::string::npos; at = text.find("</", at + 3))
    text.insert(at + 1, "\\");
  return text;
}
const char* const kPageMapScript = R"page(</script>
<script>
"use strict";
const data = JSON.parse(document.getElementById("data").textContent);
const get = id => document.getElementById(id);
const view = {x: 0, y: 0, scale: 1};

function element(tag, text) {
  const made = document.createElement(tag);
  made.textContent = text;
  return made;
}
function rasterImage(raster) {
  const image = document.createElement("canvas");
  image.width = raster.width;
  image.height = raster.height;
  const context = image.getContext("2d");
  const pixels = context.createImageData(raster.width, raster.height);
  let at = 0;
  raster.runs.forEach((count, k) => {
    for (const end = at + count; at < end; ++at) {
      const row = raster.height - 1 - Math.floor(at / raster.width);
      const to = 4 * (row * raster.width + at % raster.width);
      pixels.data.fill(raster.shades[k % 3], to, to + 3);
      pixels.data[to + 3] = 255;
    }
  });
  context.putImageData(pixels, 0, 0);
  return image;
}
const raster = data.map && data.map.raster;
const image = raster ? rasterImage(raster) : null;

function fit(canvas) {
  const ratio = window.devicePixelRatio || 1;
  canvas.width = Math.round(canvas.clientWidth * ratio);
  canvas.height = Math.round(canvas.clientHeight * ratio);
  return canvas.getContext("2d");
}
function wholeMap() {
  const [x0, x1, y0, y1] = data.map.box;
  const canvas = get("map");
  view.x = (x0 + x1) / 2;
  view.y = (y0 + y1) / 2;
  view.scale = 0.95 * Math.min(canvas.clientWidth / Math.max(1, x1 - x0),
                               canvas.clientHeight / Math.max(1, y1 - y0));
}
function drawMarks(context, marks) {
  const size = 3 / view.scale;
  for (const m of marks) {
    context.beginPath();
    if (m.length === 4) { context.moveTo(m[0], m[1]); context.lineTo(m[2], m[3]); context.stroke(); }
    else { context.arc(m[0], m[1], size, 0, 7); context.fill(); }
  }
}
function drawArrow(context, pose, length, color, width) {
  context.save();
  context.translate(pose[0], pose[1]);
  context.rotate(pose[2]);
  context.strokeStyle = color;
  context.lineWidth = width / view.scale;
  context.beginPath();
  context.moveTo(-0.4 * length, 0); context.lineTo(0.6 * length, 0);
  context.moveTo(0.25 * length, 0.25 * length); context.lineTo(0.6 * length, 0);
  context.lineTo(0.25 * length, -0.25 * length);
  context.stroke();
  context.restore();
}
// Clears the canvas, draws the map and leaves the context in its frame.
function drawBackground(canvas) {
  const context = fit(canvas);
  const ratio = canvas.width / canvas.clientWidth;
  context.setTransform(ratio * view.scale, 0, 0, -ratio * view.scale,
                       canvas.width / 2 - ratio * view.scale * view.x,
                       canvas.height / 2 + ratio * view.scale * view.y);
  if (image) {
    context.save();
    context.imageSmoothingEnabled = false;
    context.translate(raster.x, raster.y + raster.height * raster.pixel);
    context.scale(raster.pixel, -raster.pixel);
    context.drawImage(image, 0, 0);
    context.restore();
  }
  context.fillStyle = context.strokeStyle = data.map.colors.mapped;
  context.lineWidth = 2 / view.scale;
  drawMarks(context, data.map.marks);
  return {context, ratio};
}
// Leaves the context in the frame of the canvas.
function drawScaleBar(context, canvas, ratio) {
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  const most = 160 / view.scale;
  const power = Math.pow(10, Math.floor(Math.log10(most)));
  const bar = [5, 2, 1].find(f => f * power <= most) * power;
  context.fillStyle = "#444";
  context.fillRect(14, canvas.clientHeight - 16, bar * view.scale, 4);
  context.font = "13px sans-serif";
  context.fillText(`${bar} m`, 14, canvas.clientHeight - 22);
}
function zoom(event) {
  event.preventDefault();
  const box = get("map").getBoundingClientRect();
  const right = event.clientX - box.left - box.width / 2;
  const up = box.height / 2 - (event.clientY - box.top);
  const factor = event.deltaY < 0 ? 1.25 : 0.8;
  view.x += right / view.scale * (1 - 1 / factor);
  view.y += up / view.scale * (1 - 1 / factor);
  view.scale *= factor;
  drawMap();
}
function drag(event) {
  if (event.buttons !== 1) return;
  view.x -= event.movementX / view.scale;
  view.y += event.movementY / view.scale;
  drawMap();
}
get("map").addEventListener("wheel", zoom, {passive: false});
get("map").addEventListener("pointermove", drag);
)page";
}  // namespace sigloc::detail

// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "localize/run_page.h"

namespace sigloc::detail
{
const char* const kRunPageHead = R"page(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>sigloc: a run, step by step</title>
<style>
body { font: 15px/1.4 sans-serif; margin: 0; color: #222; background: #f4f4f2; }
header { padding: 8px 14px; background: #fff; border-bottom: 1px solid #ccc; }
main { display: grid; grid-template-columns: minmax(0, 1fr) 360px; gap: 12px; padding: 12px; }
canvas { display: block; width: 100%; background: #fff; border: 1px solid #bbb; }
#map { height: 68vh; cursor: grab; touch-action: none; }
#strip { height: 34px; cursor: pointer; margin-top: 8px; }
#times { height: 90px; cursor: pointer; margin-top: 8px; }
#verdict { font-size: 22px; font-weight: bold; padding: 6px 10px; color: #fff; }
#controls { display: flex; flex-wrap: wrap; gap: 6px; align-items: center; margin: 8px 0; }
#slider { flex: 1 1 160px; min-width: 0; }
aside { overflow-wrap: anywhere; }
table { border-collapse: collapse; width: 100%; background: #fff; }
td, th { border: 1px solid #ccc; padding: 3px 7px; text-align: right; }
#reason { background: #fff; border: 1px solid #ccc; padding: 6px 10px; min-height: 2.8em; }
.key { display: inline-block; width: 12px; height: 12px; margin: 0 4px 0 12px; }
.key.range { width: 48px; }
.small { color: #555; font-size: 13px; }
#scan { min-height: 2.8em; }
@media (max-width: 760px) {
  main { grid-template-columns: minmax(0, 1fr); padding: 8px; }
  #map { height: 55vh; }
}
</style>
</head>
<body>
<header><b id="title"></b> <span id="legend" class="small"></span></header>
<main>
<section>
<canvas id="map"></canvas>
<canvas id="strip" title="verdict of every step; click to go there"></canvas>
<canvas id="times" title="time of every step [ms]; click to go there"></canvas>
<div id="controls">
<button id="previous" title="left arrow">&#9664;</button>
<button id="play">play</button>
<button id="next" title="right arrow">&#9654;</button>
<input id="slider" type="range" min="1" value="1">
<span id="number"></span>
<label><input id="follow" type="checkbox"> follow</label>
<button id="whole">whole map</button>
</div>
</section>
<aside>
<div id="verdict"></div>
<p id="reason"></p>
<table id="facts"></table>
<h4 id="listed"></h4>
<table id="hypotheses"></table>
<p class="small">On the map:<span id="meanings"></span></p>
<p id="scan" class="small"><span id="drawn"></span> <button id="nearest"></button></p>
<p class="small"><span id="kept"></span>Ellipses hold 95 %.</p>
<p class="small">Wheel: zoom. Drag: move. Arrows: steps. The first strip has the verdicts, the second
the times; dark bars are relocations.</p>
</aside>
</main>
<script id="data" type="application/json">)page";

const char* const kRunPageTail = R"page(
const steps = data.steps;
const colors = data.map.colors;
const verdictColors = [colors.sure, "#a98600", "#7a3fb5", "#777777"];
let current = 0, timer = null;
function fillTable(table, rows) {
  table.replaceChildren(...rows.map((row, k) => {
    const tr = document.createElement("tr");
    tr.append(...row.map(cell => element(k === 0 && table.id === "hypotheses" ? "th" : "td", cell)));
    return tr;
  }));
}
// Small weights remain visible.
function weightColor(weight) {
  const part = (color, k) => parseInt(color.slice(1 + 2 * k, 3 + 2 * k), 16);
  const mix = k => Math.round(part(colors.unlikely, k) +
                              Math.sqrt(weight) * (part(colors.likely, k) - part(colors.unlikely, k)));
  return `rgb(${mix(0)}, ${mix(1)}, ${mix(2)})`;
}
function drawReturns(context, ends) {
  const size = 3.5 / view.scale;
  for (let k = 0; k < ends.length; k += 2)
    context.fillRect(ends[k] / 100 - size / 2, ends[k + 1] / 100 - size / 2, size, size);
}
function drawEllipse(context, h, color) {
  const [cxx, cyy, cxy] = [h[4], h[5], h[6]];
  const middle = (cxx + cyy) / 2, off = Math.hypot((cxx - cyy) / 2, cxy);
  context.strokeStyle = color;
  context.lineWidth = 1.2 / view.scale;
  context.beginPath();
  context.ellipse(h[0], h[1], 2.448 * Math.sqrt(Math.max(0, middle + off)),
                  2.448 * Math.sqrt(Math.max(0, middle - off)),
                  0.5 * Math.atan2(2 * cxy, cxx - cyy), 0, 2 * Math.PI);
  context.stroke();
}
function drawPath(context) {
  context.lineWidth = 2 / view.scale;
  context.strokeStyle = colors.path;
  context.beginPath();
  let before = false;
  for (let k = 0; k <= current; ++k) {
    const sure = steps[k].v === 0 && steps[k].h.length > 0;
    if (sure) context[before ? "lineTo" : "moveTo"](steps[k].h[0][0], steps[k].h[0][1]);
    before = sure;
  }
  context.stroke();
}
function poseColor(step) { return step.v === 0 ? colors.sure : colors.unsure; }
function drawMap() {
  const canvas = get("map");
  const {context, ratio} = drawBackground(canvas);
  drawPath(context);
  const step = steps[current];
  const length = Math.max(0.6, 26 / view.scale);
  if (step.h.length > 0 && step.f) {
    context.save();
    context.translate(step.h[0][0], step.h[0][1]);
    context.rotate(step.h[0][2]);
    context.strokeStyle = context.fillStyle = colors.observed;
    context.lineWidth = 4.5 / view.scale;  // seen below the returns
    drawMarks(context, step.f);
    context.fillStyle = colors.returns;
    drawReturns(context, step.b);
    context.restore();
  }
  for (let k = step.h.length - 1; k >= 0; --k) {
    const h = step.h[k];
    const color = weightColor(h[3]);
    drawEllipse(context, h, color);
    drawArrow(context, h, length, k > 0 ? color : poseColor(step), k > 0 ? 2 : 4);
  }
  if (step.t) drawArrow(context, step.t, length, colors.truth, 1.5);
  drawOverlay(context, canvas, ratio, step);
}
function drawOverlay(context, canvas, ratio, step) {
  drawScaleBar(context, canvas, ratio);
  if (step.v === 0) return;
  context.strokeStyle = context.fillStyle = colors.not_localized;
  context.lineWidth = 6;
  context.strokeRect(3, 3, canvas.clientWidth - 6, canvas.clientHeight - 6);
  context.font = "bold 26px sans-serif";
  context.fillText("NOT LOCALIZED", 18, 38);
}
function drawStrip(canvas, height, color) {
  const context = fit(canvas);
  const width = canvas.width / steps.length;
  steps.forEach((step, k) => {
    context.fillStyle = color(step);
    const high = height(step) * canvas.height;
    context.fillRect(k * width, canvas.height - high, Math.max(1, width), high);
  });
  context.fillStyle = "#000";
  context.fillRect((current + 0.5) * width - 1, 0, 2, canvas.height);
}
const total = step => step.ms[0] + step.ms[1];
const slowest = Math.max(0.01, ...steps.map(total));
function drawStrips() {
  drawStrip(get("strip"), () => 1, step => verdictColors[step.v]);
  drawStrip(get("times"), step => total(step) / slowest, step => step.l ? "#27406b" : "#9db4d8");
  const context = get("times").getContext("2d");
  context.fillStyle = "#444";
  context.font = `${13 * (window.devicePixelRatio || 1)}px sans-serif`;
  context.fillText(`${slowest.toFixed(1)} ms`, 6, 16 * (window.devicePixelRatio || 1));
}
function pose(p) {
  return [p[0].toFixed(2), p[1].toFixed(2), (p[2] * 180 / Math.PI).toFixed(1)];
}
// The step nearest to a step without a scan that has one: the first always has.
function nearestScan(k) {
  for (let off = 1; ; ++off)
    for (const at of [k - off, k + off]) if (steps[at] && steps[at].f) return at;
}
function tellOfScan(step) {
  get("nearest").hidden = Boolean(step.f);
  if (!step.f) get("nearest").textContent = `go to step ${nearestScan(current) + 1}`;
  get("drawn").textContent =
    !step.f ? "No scan is drawn, because the page does not have that of this step. The nearest:" :
    step.h.length === 0 ? "What the robot saw is not drawn, because there is no pose to draw it at." :
    "What the robot saw is drawn at the first hypothesis; of a scan's returns up to 100 are shown.";
}
function show(k) {
  current = Math.min(Math.max(0, k), steps.length - 1);
  const step = steps[current];
  const first = step.h.length > 0 ? step.h[0] : null;
  get("slider").value = current + 1;
  get("number").textContent = `${current + 1} / ${steps.length}`;
  const sure = first ? `(${step.p})` : "(no pose)";
  get("verdict").textContent = `${data.verdicts[step.v]} ${sure}`;
  get("verdict").style.background = verdictColors[step.v];
  get("reason").textContent = data.reasons[step.r];
  const facts = [["step", step.n], ["driven", step.m === null ? "unknown" : `${step.m} m`],
                 ["elsewhere", step.e.toFixed(4)],
                 ["finding features", `${step.ms[0].toFixed(2)} ms`],
                 [step.l ? "relocation" : "tracking", `${step.ms[1].toFixed(2)} ms`]];
  if (step.d) facts.push(["off the truth", `${step.d[0]} m, ${step.d[1]} deg`]);
  fillTable(get("facts"), facts);
  fillTable(get("hypotheses"), [["probability", "x [m]", "y [m]", "deg"],
            ...step.h.map(h => [h[3], ...pose(h)])]);
  tellOfScan(step);
  get("listed").textContent = step.a > step.h.length ?
    `The ${step.h.length === 1 ? "heaviest" : `${step.h.length} heaviest`} of ${step.a} hypotheses` : "Hypotheses";
  if (get("follow").checked && first) { view.x = first[0]; view.y = first[1]; }
  drawMap();
  drawStrips();
}
function play() {
  if (timer) { clearInterval(timer); timer = null; }
  else {
    if (current + 1 === steps.length) show(0);
    timer = setInterval(() => {
      if (current + 1 < steps.length) show(current + 1); else play();
    }, 100);
  }
  get("play").textContent = timer ? "pause" : "play";
}
for (const id of ["strip", "times"])
  get(id).addEventListener("click", event => {
    const box = get(id).getBoundingClientRect();
    show(Math.floor((event.clientX - box.left) / box.width * steps.length));
  });
get("slider").max = steps.length;
get("slider").addEventListener("input", () => show(get("slider").value - 1));
get("previous").addEventListener("click", () => show(current - 1));
get("next").addEventListener("click", () => show(current + 1));
get("play").addEventListener("click", play);
get("nearest").addEventListener("click", () => show(nearestScan(current)));
get("whole").addEventListener("click", () => { get("follow").checked = false; wholeMap(); drawMap(); });
get("follow").addEventListener("change", () => {
  if (get("follow").checked) view.scale = Math.max(view.scale, 24);
  show(current);
});
document.addEventListener("keydown", event => {
  if (event.target === get("slider")) return;
  if (event.key === "ArrowRight") show(current + 1);
  if (event.key === "ArrowLeft") show(current - 1);
});
window.addEventListener("resize", () => show(current));
if (data.scans_every > 1)
  get("kept").textContent = `So that the page stays small, it has the scans of one step in ${data.scans_every} ` +
                            "and of those where the verdict changes. ";
get("title").textContent = `${data.log_name} in ${data.map_name}`;
const likelihoods = `linear-gradient(to right, ${weightColor(0)}, ${weightColor(1)})`;
function addKey(legend, color, name) {
  const entry = element("span", ""), key = element("span", "");
  entry.style.display = "inline-block";
  key.className = color === likelihoods ? "key range" : "key";
  key.style.background = color;
  entry.append(key, name);
  get(legend).append(entry);
}
data.verdicts.forEach((name, k) => addKey("legend", verdictColors[k], name));
const meanings = [["returns", colors.returns], ["features seen", colors.observed],
                  ["hypotheses, unlikely to likely", likelihoods], ["sure pose", colors.sure],
                  ["unsure pose", colors.unsure], ["path", colors.path]];
if (steps.some(step => step.t)) meanings.push(["truth", colors.truth]);
if (data.map.marks.length > 0) meanings.unshift(["mapped", colors.mapped]);
for (const [name, color] of meanings) addKey("meanings", color, name);
wholeMap();
show(steps.length - 1);
</script>
</body>
</html>
)page";
}  // namespace sigloc::detail

// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/reports/evaluation_page.h"

namespace sigloc::detail
{
const char* const kEvaluationPageHead = R"page(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>sigloc: an evaluation</title>
<style>
body { font: 15px/1.4 sans-serif; margin: 0; color: #222; background: #f4f4f2; }
header { padding: 8px 14px; background: #fff; border-bottom: 1px solid #ccc; }
main, #plots { display: grid; gap: 12px; padding: 12px; }
main { grid-template-columns: minmax(0, 1fr) 380px; }
#plots { grid-template-columns: repeat(auto-fill, minmax(min(440px, 100%), 1fr)); }
canvas { display: block; width: 100%; background: #fff; border: 1px solid #bbb; }
#map { height: 68vh; cursor: grab; touch-action: none; }
#plots canvas { height: 300px; }
#list { max-height: 36vh; overflow-y: auto; background: #fff; border: 1px solid #ccc; }
#list div { padding: 1px 8px; cursor: pointer; }
#list .chosen { background: #dce8ff; }
#text { padding: 0 14px; overflow-x: auto; }
table { border-collapse: collapse; background: #fff; }
td, th { border: 1px solid #ccc; padding: 3px 7px; text-align: right; }
aside table { width: 100%; }
code { background: #eee; }
.key { display: inline-block; width: 12px; height: 12px; margin: 0 6px 0 2px; }
.small { color: #555; font-size: 13px; }
@media (max-width: 760px) {
  main { grid-template-columns: minmax(0, 1fr); }
  #map { height: 55vh; }
}
</style>
</head>
<body>
<header><b id="title"></b></header>
<main id="places">
<section><canvas id="map"></canvas></section>
<aside>
<label>Method <select id="method"></select></label>
<div id="outcomes"></div>
<p><b id="chosen">none chosen</b></p>
<table id="facts"></table>
<p class="small">Click a place on the map or in the list. Black: the truth. An arrow and a line lead to a
first pose that is not right. Wheel: zoom. Drag: move.</p>
<div id="list"></div>
</aside>
</main>
<div id="plots"></div>
<div id="text"></div>
<script id="data" type="application/json">)page";

const char* const kEvaluationPageTail = R"page(
const outcomes = [["claimed, right", "#1a8f4c"], ["right, not claimed", "#7cb518"],
                  ["claimed, inaccurate", "#e07b00"], ["not right, not claimed", "#8a5bd0"],
                  ["claimed, wrong", "#c22f2f"], ["saw nothing", "#777777"]];
const pathColors = ["#9a9a9a", "#1a8f4c", "#e07b00", "#c22f2f"];
const hidden = new Set();
let chosen = null;

function shownPlaces() {
  return data.places.filter(p => p.method === get("method").value && !hidden.has(p.outcome));
}
function colorOf(place) { return outcomes[place.outcome][1]; }
function placePose(place) { return place.truth || place.first; }
function drawPath(context, place) {
  for (let k = 1; k < place.path.length; ++k) {
    const [from, to] = [place.path[k - 1], place.path[k]];
    context.strokeStyle = pathColors[to[2]];
    context.lineWidth = (place === chosen ? 4 : 1.5) / view.scale;
    context.beginPath();
    context.moveTo(from[0], from[1]);
    context.lineTo(to[0], to[1]);
    context.stroke();
  }
}
function drawPlace(context, place) {
  drawPath(context, place);
  const at = placePose(place);
  if (!at) return;
  const size = (place === chosen ? 8 : 4.5) / view.scale;
  context.fillStyle = context.strokeStyle = colorOf(place);
  context.beginPath();
  context.arc(at[0], at[1], size, 0, 7);
  context.fill();
  if (place !== chosen) return;
  const length = Math.max(0.6, 26 / view.scale);
  if (place.truth) drawArrow(context, place.truth, length, "#000", 2);
  if (!place.first) return;
  context.lineWidth = 1.5 / view.scale;
  context.beginPath();
  context.moveTo(at[0], at[1]);
  context.lineTo(place.first[0], place.first[1]);
  context.stroke();
  drawArrow(context, place.first, length, colorOf(place), 3);
}
function drawMap() {
  const canvas = get("map");
  const {context, ratio} = drawBackground(canvas);
  for (const place of shownPlaces()) if (place !== chosen) drawPlace(context, place);
  if (chosen) drawPlace(context, chosen);
  drawScaleBar(context, canvas, ratio);
}
function rowsInto(table, rows) {
  table.replaceChildren(...rows.map(row => {
    const tr = document.createElement("tr");
    tr.append(...row.map(cell => element("td", cell)));
    return tr;
  }));
}
function choose(place) {
  chosen = place;
  get("chosen").textContent = place ? `${place.name}: ${outcomes[place.outcome][0]}` : "none chosen";
  rowsInto(get("facts"), place ? place.facts : []);
  for (const row of get("list").children) row.className = row.place === place ? "chosen" : "";
  drawMap();
}
function fillList() {
  get("list").replaceChildren(...shownPlaces().map(place => {
    const row = element("div", "");
    const key = element("span", "");
    key.className = "key";
    key.style.background = colorOf(place);
    row.append(key, place.name);
    row.place = place;
    row.addEventListener("click", () => choose(place));
    return row;
  }));
}
function fillOutcomes() {
  get("outcomes").replaceChildren(...outcomes.map(([name, color], k) => {
    const count = data.places.filter(p => p.method === get("method").value && p.outcome === k).length;
    const label = document.createElement("label"), box = document.createElement("input");
    box.type = "checkbox";
    box.id = `outcome-${k}`;
    box.checked = !hidden.has(k);
    box.addEventListener("change", () => {
      if (box.checked) hidden.delete(k); else hidden.add(k);
      showMethod();
    });
    const key = element("span", "");
    key.className = "key";
    key.style.background = color;
    label.append(box, key, `${name}: ${count}`, document.createElement("br"));
    return label;
  }));
}
function showMethod() {
  fillOutcomes();
  fillList();
  choose(shownPlaces().includes(chosen) ? chosen : null);
}
function pickPlace(event) {
  const box = get("map").getBoundingClientRect();
  const x = view.x + (event.clientX - box.left - box.width / 2) / view.scale;
  const y = view.y + (box.height / 2 - (event.clientY - box.top)) / view.scale;
  let best = null, least = 14 / view.scale;
  for (const place of shownPlaces()) {
    const at = placePose(place);
    const away = at ? Math.hypot(at[0] - x, at[1] - y) : Infinity;
    if (away < least) { best = place; least = away; }
  }
  if (best) choose(best);
}

// Markdown as the reports use it: headings, tables, lists, paragraphs, **bold** and `code`.
function withMarkup(tag, text) {
  const made = document.createElement(tag);
  for (const part of text.split(/(`[^`]*`|\*\*[^*]+\*\*)/)) {
    if (part.startsWith("`")) made.append(element("code", part.slice(1, -1)));
    else if (part.startsWith("**")) made.append(element("b", part.slice(2, -2)));
    else made.append(part);
  }
  return made;
}
function renderText(into, lines) {
  let open = null;
  const within = (tag, line) => {
    if (!open || open.tagName !== tag.toUpperCase()) into.append(open = document.createElement(tag));
    return open;
  };
  for (const line of lines) {
    if (/^#+ /.test(line)) {
      into.append(withMarkup(line.startsWith("## ") ? "h3" : "h2", line.replace(/^#+ /, "")));
      open = null;
    } else if (/^\|[-|: ]+\|$/.test(line)) {
      continue;
    } else if (line.startsWith("|")) {
      const tag = open && open.tagName === "TABLE" ? "td" : "th";
      const row = document.createElement("tr");
      row.append(...line.slice(1, -1).split("|").map(cell => withMarkup(tag, cell.trim())));
      within("table").append(row);
    } else if (line.startsWith("* ")) {
      within("ul").append(withMarkup("li", line.slice(2)));
    } else if (line.trim() === "") {
      open = null;
    } else if (open && open.tagName === "UL") {
      open.lastChild.append(" ", ...withMarkup("span", line).childNodes);
    } else {
      within("p").append(...withMarkup("span", line + " ").childNodes);
    }
  }
}

function scaleOf(values, log, from, to) {
  const usable = values.filter(v => Number.isFinite(v) && (!log || v > 0));
  let low = Math.min(...usable), high = Math.max(...usable);
  if (!(high > low)) { low = log ? low / 2 : low - 0.5; high = log ? high * 2 : high + 0.5; }
  const f = v => (log ? Math.log10(v) : v);
  const at = v => from + (to - from) * (f(v) - f(low)) / (f(high) - f(low));
  const ticks = [];
  if (log) {
    for (let p = Math.ceil(f(low)); p <= f(high); ++p) ticks.push(Math.pow(10, p));
  } else {
    const raw = (high - low) / 5, power = Math.pow(10, Math.floor(Math.log10(raw)));
    const step = [1, 2, 5, 10].find(s => s * power >= raw) * power;
    for (let v = Math.ceil(low / step) * step; v <= high; v += step) ticks.push(v);
  }
  return {at, ticks};
}
const curveColors = ["#1f4ea0", "#c22f2f", "#1a8f4c", "#8a5bd0", "#e07b00", "#00838f", "#6d4c41"];
function drawAxes(context, x, y, box, plot) {
  context.strokeStyle = "#ddd";
  context.fillStyle = "#444";
  for (const tick of x.ticks) {
    context.strokeRect(x.at(tick), box.top, 0, box.bottom - box.top);
    context.fillText(String(+tick.toPrecision(4)), x.at(tick) - 8, box.bottom + 15);
  }
  for (const tick of y.ticks) {
    context.strokeRect(box.left, y.at(tick), box.right - box.left, 0);
    context.fillText(String(+tick.toPrecision(4)), 4, y.at(tick) + 4);
  }
  context.fillText(plot.x, (box.left + box.right) / 2 - 40, box.bottom + 32);
  context.fillText(plot.y, box.left, box.top - 6);
  context.font = "bold 13px sans-serif";
  context.fillText(plot.title, box.left, 16);
  context.font = "12px sans-serif";
}
function drawCurve(context, curve, x, y, color, row, box) {
  context.strokeStyle = context.fillStyle = color;
  context.lineWidth = 1.6;
  context.beginPath();
  for (const point of curve.points) context.lineTo(x.at(point[0]), y.at(point[1]));
  context.stroke();
  curve.points.forEach((point, k) => {
    if (curve.markers) context.fillRect(x.at(point[0]) - 2.5, y.at(point[1]) - 2.5, 5, 5);
    const interval = curve.intervals[k];
    if (interval)
      context.strokeRect(x.at(point[0]), y.at(interval[0]), 0, y.at(interval[1]) - y.at(interval[0]));
  });
  context.fillText(curve.title, box.right - 150, box.bottom - 10 - 15 * row);
}
function drawPlot(canvas, plot) {
  const context = fit(canvas), ratio = canvas.width / canvas.clientWidth;
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.font = "12px sans-serif";
  const box = {left: 52, right: canvas.clientWidth - 14, top: 40, bottom: canvas.clientHeight - 40};
  const points = plot.series.flatMap(curve => curve.points);
  const bounds = plot.series.flatMap(curve => curve.intervals.flat());
  if (points.length === 0) { context.fillText(`${plot.title}: nothing to draw`, 20, 20); return; }
  const x = scaleOf(points.map(p => p[0]), plot.log_x, box.left, box.right);
  const y = scaleOf([...points.map(p => p[1]), ...bounds], plot.log_y, box.bottom, box.top);
  drawAxes(context, x, y, box, plot);
  plot.series.forEach((curve, k) =>
    drawCurve(context, curve, x, y, curveColors[k % curveColors.length], k, box));
}

get("title").textContent = data.title;
for (const plot of data.plots) {
  const canvas = document.createElement("canvas");
  get("plots").append(canvas);
  drawPlot(canvas, plot);
}
renderText(get("text"), data.text.split("\n"));
if (data.map) {
  for (const name of [...new Set(data.places.map(place => place.method))])
    get("method").append(element("option", name));
  get("method").addEventListener("change", showMethod);
  get("map").addEventListener("click", pickPlace);
  window.addEventListener("resize", drawMap);
  wholeMap();
  showMethod();
} else {
  get("places").hidden = true;
  get("places").style.display = "none";
}
</script>
</body>
</html>
)page";
}  // namespace sigloc::detail

// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/reports/plot.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <system_error>

#include "config/TextStream.h"
#include "eval/process/child_process.h"
#include "sigloc/io/file_output.h"

namespace sigloc
{
namespace
{
// gnuplot's double-quoted strings take backslash escapes.
std::string quoted(const std::string& text)
{
  std::string out = "\"";
  for (const char c : text)
  {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}

void writePoints(const PlotSeries& series, std::ostream& script)
{
  for (std::size_t i = 0; i < series.points.size(); ++i)
  {
    const auto& [x, y] = series.points[i];
    if (!std::isfinite(x) || !std::isfinite(y)) continue;
    script << x << " " << y;
    if (!series.intervals.empty())
    {
      script << " " << series.intervals[i].first << " " << series.intervals[i].second;
    }
    script << "\n";
  }
}

const char* styleOf(const PlotSeries& series)
{
  if (!series.intervals.empty()) return "1:2:3:4 with yerrorlines";
  return series.markers ? "1:2 with linespoints" : "1:2 with lines";
}

std::string scriptOf(const Plot& plot)
{
  TextStream script;
  script << std::setprecision(9);
  for (std::size_t i = 0; i < plot.series.size(); ++i)
  {
    script << "$series" << i << " << END_OF_DATA\n";
    writePoints(plot.series[i], script);
    script << "END_OF_DATA\n";
  }
  script << "set terminal pngcairo size 900,600 noenhanced\n"
         << "set title " << quoted(plot.title) << "\n"
         << "set xlabel " << quoted(plot.x_label) << "\n"
         << "set ylabel " << quoted(plot.y_label) << "\n"
         << "set grid\nset key outside right top\n";
  if (plot.log_x) script << "set logscale x\n";
  if (plot.log_y) script << "set logscale y\n";
  script << "plot ";
  bool first = true;
  for (std::size_t i = 0; i < plot.series.size(); ++i)
  {
    if (plot.series[i].points.empty()) continue;
    script << (first ? "" : ", ") << "$series" << i << " using " << styleOf(plot.series[i])
           << " linewidth 2 title " << quoted(plot.series[i].title);
    first = false;
  }
  script << "\n";
  return first ? std::string() : script.str();
}
}  // namespace

PlotSeries cumulativeShare(const std::string& title, std::vector<double> values, std::size_t cases)
{
  std::sort(values.begin(), values.end());
  PlotSeries series;
  series.title = title;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    series.points.emplace_back(values[i], static_cast<double>(i + 1) / static_cast<double>(cases));
  }
  return series;
}

bool drawPlot(const Plot& plot, const std::filesystem::path& png)
{
  const std::string text = scriptOf(plot);
  if (text.empty()) return false;
  // From a file: a pipe to a gnuplot that ends early, or is missing, would end this program too.
  std::filesystem::path script = png;
  script += ".gnuplot";
  writeFile(script, text);
  // Not into the file: gnuplot does not tell of a disk that takes a part of it only.
  const auto picture = detail::outputOf("gnuplot", script.string());
  std::error_code ignored;
  std::filesystem::remove(script, ignored);
  if (picture) writeFile(png, *picture);
  return picture.has_value();
}
}  // namespace sigloc

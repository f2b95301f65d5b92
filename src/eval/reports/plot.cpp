// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/reports/plot.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <system_error>

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

/// A data block of gnuplot's.
std::string blockOf(const PlotSeries& series, std::size_t number)
{
  std::string block = fmt::format("$series{} << END_OF_DATA\n", number);
  for (std::size_t i = 0; i < series.points.size(); ++i)
  {
    const auto& [x, y] = series.points[i];
    if (!std::isfinite(x) || !std::isfinite(y)) continue;
    block += fmt::format("{:.9g} {:.9g}", x, y);
    if (!series.intervals.empty())
      block += fmt::format(" {:.9g} {:.9g}", series.intervals[i].first, series.intervals[i].second);
    block += "\n";
  }
  return block + "END_OF_DATA\n";
}

const char* styleOf(const PlotSeries& series)
{
  if (!series.intervals.empty()) return "1:2:3:4 with yerrorlines";
  return series.markers ? "1:2 with linespoints" : "1:2 with lines";
}

std::string scriptOf(const Plot& plot)
{
  std::string script = fmt::format(
      "set terminal pngcairo size 900,600 noenhanced\nset title {}\nset xlabel {}\n"
      "set ylabel {}\nset grid\nset key outside right top\n{}{}",
      quoted(plot.title), quoted(plot.x_label), quoted(plot.y_label),
      plot.log_x ? "set logscale x\n" : "", plot.log_y ? "set logscale y\n" : "");
  std::string curves;
  for (std::size_t i = 0; i < plot.series.size(); ++i)
  {
    if (plot.series[i].points.empty()) continue;
    script += blockOf(plot.series[i], i);
    curves += fmt::format("{}$series{} using {} linewidth 2 title {}", curves.empty() ? "" : ", ",
                          i, styleOf(plot.series[i]), quoted(plot.series[i].title));
  }
  return curves.empty() ? std::string() : script + "plot " + curves + "\n";
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

// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace sigloc
{
struct PlotSeries
{
  std::string title;
  std::vector<std::pair<double, double>> points;
  bool markers = false;  ///< points joined by lines instead of lines alone
  std::vector<std::pair<double, double>> intervals;  ///< of y, one a point; empty: none drawn
};

/// A figure of curves.
struct Plot
{
  std::string title;
  std::string x_label;
  std::string y_label;
  bool log_x = false;
  bool log_y = false;
  std::vector<PlotSeries> series;
};

/// Returns the curve "share of the values that are at most x" of a list; `cases` at least its size.
PlotSeries cumulativeShare(const std::string& title, std::vector<double> values, std::size_t cases);

/// Draws the plot as a PNG with gnuplot. Returns false when there is nothing to draw, or gnuplot is
/// not installed or fails. Throws std::runtime_error ("path: reason") where nothing can be written.
bool drawPlot(const Plot& plot, const std::filesystem::path& png);
}  // namespace sigloc

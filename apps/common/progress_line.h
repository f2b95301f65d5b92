// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <unistd.h>

#include <fmt/format.h>
#include <iostream>
#include <string>

namespace sigloc
{
/// A progress line on a terminal, rewritten in place. Nothing is written elsewhere, or when quiet.
class ProgressLine
{
 public:
  explicit ProgressLine(bool quiet = false) : active_(!quiet && isatty(STDOUT_FILENO) != 0) {}
  ~ProgressLine() { finish(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  bool active() const { return active_; }

  void show(const std::string& text)
  {
    if (!active_) return;
    std::cout << fmt::format("\r{:<78}", text) << std::flush;
    shown_ = true;
  }

  /// A bar; `share` in [0, 1]. Written when its percentage has changed.
  void showBar(const std::string& what, double share)
  {
    constexpr int kWidth = 40;
    const int percent = static_cast<int>(100 * share);
    if (!active_ || percent == percent_) return;
    percent_ = percent;
    const auto filled = static_cast<std::size_t>(percent * kWidth / 100);
    show(fmt::format("{} [{:<{}}] {} %", what, std::string(filled, '#'), kWidth, percent));
  }

  /// Ends the line.
  void finish()
  {
    if (shown_) std::cout << '\n';
    shown_ = false;
    percent_ = -1;
  }

 private:
  bool active_;
  bool shown_ = false;
  int percent_ = -1;
};
}  // namespace sigloc

// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <locale>
#include <string>

namespace sigloc::test
{
/// 1.234,5 instead of 1234.5.
class CommaNumbers : public std::numpunct<char>
{
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

/// Sets the host's number format as long as the object exists.
class HostLocale
{
 public:
  HostLocale() : before_(std::locale::global(std::locale(std::locale::classic(), new CommaNumbers)))
  {
  }
  ~HostLocale() { std::locale::global(before_); }
  HostLocale(const HostLocale&) = delete;
  HostLocale& operator=(const HostLocale&) = delete;

 private:
  std::locale before_;
};
}  // namespace sigloc::test

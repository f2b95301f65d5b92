// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/data/method_names.h"

#include <algorithm>
#include <set>
#include <stdexcept>

namespace sigloc
{
std::string joined(const std::vector<std::string>& words)
{
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

void refuseMethod(const std::string& name, const std::vector<std::string>& known)
{
  throw std::invalid_argument("unknown method '" + name + "'; known are " + joined(known));
}

void checkMethodNames(const std::vector<std::string>& names, const std::vector<std::string>& known)
{
  if (names.empty()) throw std::invalid_argument("no method to run");
  std::set<std::string> seen;
  for (const std::string& name : names)
  {
    if (std::find(known.begin(), known.end(), name) == known.end()) refuseMethod(name, known);
    if (!seen.insert(name).second) throw std::invalid_argument(name + ": given twice");
  }
}
}  // namespace sigloc

// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cctype>
#include <numeric>

#include "config/nearest_word.h"
#include "sigloc/config/option_fields.h"

namespace sigloc
{
namespace
{
std::string lowerCase(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// The least number of letters to add, drop, replace or swap with their neighbour (optimal string
/// alignment).
std::size_t lettersBetween(const std::string& a, const std::string& b)
{
  std::vector<std::vector<std::size_t>> cost(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) cost[i][0] = i;
  std::iota(cost[0].begin(), cost[0].end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i)
  {
    for (std::size_t j = 1; j <= b.size(); ++j)
    {
      const std::size_t replaced = cost[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      cost[i][j] = std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1, replaced});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
    }
  }
  return cost[a.size()][b.size()];
}
}  // namespace

std::string detail::nearestWord(const std::string& word, const std::vector<std::string>& known)
{
  constexpr std::size_t kLongest = 255;  // of a file's name
  constexpr std::size_t kLettersPerSlip = 3;
  if (word.size() > kLongest) return {};
  std::string nearest;
  std::size_t least = std::max<std::size_t>(1, word.size() / kLettersPerSlip) + 1;
  for (const std::string& candidate : known)
  {
    if (candidate.size() > kLongest) continue;
    const std::size_t distance = lettersBetween(lowerCase(word), lowerCase(candidate));
    if (distance >= least) continue;
    least = distance;
    nearest = candidate;
  }
  return nearest;
}

std::string didYouMean(const std::string& word, const std::vector<std::string>& known)
{
  const std::string nearest = detail::nearestWord(word, known);
  return nearest.empty() ? "" : "; did you mean '" + nearest + "'?";
}
}  // namespace sigloc

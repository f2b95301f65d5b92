// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/GroundTruth.h"

#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/math/wrap2pi.h>
#include <mrpt/poses/CPose2D.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "io/archive/checked_archive.h"
#include "io/archive/file_fault.h"
#include "io/archive/gzip_input.h"
#include "io/key_frames.h"
#include "io/text_rows.h"

namespace sigloc
{
using mrpt::math::TPose2D;

namespace
{
constexpr double kMaxTurn = 0.2;  // [rad] between two rows that are interpolated
constexpr double kMaxStep = 0.75;  // [m]
constexpr double kSameTime = 1e-3;  // [s]
constexpr double kFarthest = 1.3e7;  // [m] any coordinate of a place on earth is smaller
constexpr double kLargestIndex = 1e7;  // larger whole numbers are seconds since some epoch

struct Row
{
  std::vector<double> numbers;
  bool starts_with_digits = false;  // only: "7", not "7.0", which is a time
};

/// Returns the rows of numbers of a text file, all of 3, 4 or 7 columns.
std::vector<Row> readRows(const std::filesystem::path& path)
{
  std::vector<Row> rows;
  for (detail::TextLines lines(path); lines.next();)
  {
    const std::size_t i = lines.index();
    const auto words = detail::words(lines.line());
    if (words.empty() || words.front().front() == '#' || words.front().front() == '%') continue;
    Row row;
    row.starts_with_digits =
        words.front().find_first_not_of("0123456789") == std::string_view::npos;
    for (const auto word : words)
    {
      const auto number = detail::toNumber(word);
      if (!number) detail::failAtLine(path, i, "bad number " + detail::quoted(word));
      row.numbers.push_back(*number);
    }
    const std::size_t columns = row.numbers.size();
    if (columns != 3 && columns != 4 && columns != 7)
    {
      detail::failAtLine(path, i, "3, 4 or 7 columns are needed");
    }
    if (!rows.empty() && rows.front().numbers.size() != columns)
    {
      detail::failAtLine(path, i, "not as many columns as in the rows before");
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

/// Whole numbers that grow from row to row and are too small for times are step indices.
bool countsSteps(const std::vector<Row>& rows)
{
  double previous = -1;
  for (const Row& row : rows)
  {
    const double key = row.numbers.front();
    if (!row.starts_with_digits || key <= previous || key > kLargestIndex) return false;
    previous = key;
  }
  return true;
}
}  // namespace

/// The longest run of rows whose times grow. A path is written as it is driven, so a row that is
/// out of this order has a wrong time. It would be the truth of some other moment.
std::vector<GroundTruth::Entry> GroundTruth::inTimeOrder(const std::vector<Entry>& rows)
{
  constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  std::vector<std::size_t> tails;  // last row of the best run of each length
  std::vector<std::size_t> before(rows.size(), kNone);
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    const auto place =
        std::lower_bound(tails.begin(), tails.end(), rows[i].key,
                         [&](std::size_t tail, double key) { return rows[tail].key < key; });
    if (place != tails.begin()) before[i] = *std::prev(place);
    if (place == tails.end())
    {
      tails.push_back(i);
    }
    else
    {
      *place = i;
    }
  }
  std::vector<Entry> kept;
  for (std::size_t i = tails.empty() ? kNone : tails.back(); i != kNone; i = before[i])
  {
    kept.push_back(rows[i]);
  }
  std::reverse(kept.begin(), kept.end());
  return kept;
}

GroundTruth GroundTruth::read(const std::filesystem::path& path, const TPose2D& map_from_truth)
{
  GroundTruth truth;
  if (detail::extensionOf(path) == ".simplemap")
  {
    mrpt::maps::CSimpleMap simplemap;
    detail::readObjectFile(path, simplemap);
    truth.key_ = Key::time;
    for (std::size_t i = 0; i < simplemap.size(); ++i)
    {
      const auto [pose, frame] = keyFrameOf(simplemap, i);
      const bool timed =
          pose && frame && !frame->empty() && (*frame->begin())->timestamp != INVALID_TIMESTAMP;
      if (!timed) continue;
      const double time = mrpt::Clock::toDouble((*frame->begin())->timestamp);
      truth.entries_.push_back({time, mrpt::poses::CPose2D(pose->getMeanVal()).asTPose()});
    }
  }
  else
  {
    const std::vector<Row> rows = readRows(path);
    const std::size_t columns = rows.empty() ? 0 : rows.front().numbers.size();
    if (columns > 3) truth.key_ = columns == 4 && countsSteps(rows) ? Key::index : Key::time;
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      const std::vector<double>& row = rows[i].numbers;
      if (columns == 3)
      {
        truth.entries_.push_back({static_cast<double>(i), {row[0], row[1], row[2]}});
      }
      else
      {
        // Seven columns carry z before the yaw.
        truth.entries_.push_back({row[0], {row[1], row[2], columns == 7 ? row[4] : row[3]}});
      }
    }
  }
  if (truth.entries_.empty()) detail::fail(path, "no pose in it");
  const auto is_nowhere = [](const Entry& entry)
  { return std::max(std::abs(entry.pose.x), std::abs(entry.pose.y)) > kFarthest; };
  if (std::any_of(truth.entries_.begin(), truth.entries_.end(), is_nowhere))
    detail::fail(path, "a pose farther from the origin than the earth is wide");
  for (Entry& entry : truth.entries_)
  {
    entry.pose = map_from_truth + entry.pose;
    entry.pose.phi = mrpt::math::wrapToPi(entry.pose.phi);
  }
  if (truth.key_ == Key::time) truth.entries_ = inTimeOrder(truth.entries_);
  return truth;
}

std::optional<TPose2D> GroundTruth::at(std::size_t step, double time, double max_gap) const
{
  const bool by_time = key_ == Key::time;
  const double key = by_time ? time : static_cast<double>(step);
  const double same = by_time ? kSameTime : 0.0;
  const auto after = std::lower_bound(entries_.begin(), entries_.end(), key - same,
                                      [](const Entry& entry, double k) { return entry.key < k; });
  if (after == entries_.end()) return std::nullopt;
  if (after->key <= key + same) return after->pose;
  if (!by_time || after == entries_.begin()) return std::nullopt;
  const auto before = std::prev(after);
  if (after->key - time > max_gap || time - before->key > max_gap) return std::nullopt;
  const double share = (time - before->key) / (after->key - before->key);
  const TPose2D& a = before->pose;
  const TPose2D& b = after->pose;
  const double turn = mrpt::math::wrapToPi(b.phi - a.phi);
  // Where the robot turned or drove far between two rows, its path between them is unknown.
  if (std::abs(turn) > kMaxTurn || std::hypot(b.x - a.x, b.y - a.y) > kMaxStep) return std::nullopt;
  return TPose2D{a.x + share * (b.x - a.x), a.y + share * (b.y - a.y),
                 mrpt::math::wrapToPi(a.phi + share * turn)};
}
}  // namespace sigloc

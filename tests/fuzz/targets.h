// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace sigloc::fuzz
{
/// What a target found: a law that does not hold, or an error that says nothing to a user. No
/// target catches it.
struct Finding : std::logic_error
{
  using std::logic_error::logic_error;
};

inline void require(bool holds, const std::string& law)
{
  if (!holds) throw Finding(law);
}

/// Takes bytes that nothing vouches for and uses them as a program would. Returns true when they
/// were accepted, false when they were refused in good order.
using Target = bool (*)(std::string_view bytes);

// Files, by their content.
bool readsSigmap(std::string_view bytes);
bool readsSignatureMap(std::string_view bytes);
bool readsSignatures(std::string_view bytes);
bool readsRosMap(std::string_view bytes);
bool readsCarmenLog(std::string_view bytes);
bool readsLandmarks(std::string_view bytes);
bool readsPoints(std::string_view bytes);
bool readsGroundTruth(std::string_view bytes);
bool readsSetup(std::string_view bytes);
bool readsSummaries(std::string_view bytes);
bool readsRawlog(std::string_view bytes);
bool readsMapFile(std::string_view bytes);
/// Scans, landmarks and motions of any values, through extraction, matcher and tracker.
bool tracksScene(std::string_view bytes);

struct NamedTarget
{
  std::string_view name;  ///< also of its folder in tests/corpus
  Target run;
};

constexpr std::array<NamedTarget, 13> kTargets = {{
    {"sigmap", readsSigmap},
    {"signature_map", readsSignatureMap},
    {"signatures", readsSignatures},
    {"ros_map", readsRosMap},
    {"carmen_log", readsCarmenLog},
    {"landmarks", readsLandmarks},
    {"points", readsPoints},
    {"ground_truth", readsGroundTruth},
    {"ini", readsSetup},
    {"summaries", readsSummaries},
    {"rawlog", readsRawlog},
    {"map_file", readsMapFile},
    {"scene", tracksScene},
}};

/// Writes `bytes` to a file named so in a folder of this process, which lies in memory where there
/// is such a place. Returns the file's path.
const std::filesystem::path& inputFile(const std::string& name, std::string_view bytes);

/// Calls a reader. Returns true when it has read. Returns false when it has refused as it promises:
/// by a std::runtime_error of one line that begins with the path of a file. Throws Finding for any
/// other exception.
template <class Read>
bool accepts(Read&& read);

/// The law of accepts() for one exception.
void requireReason(const std::string& message);

template <class Read>
bool accepts(Read&& read)
{
  try
  {
    read();
    return true;
  }
  catch (const std::runtime_error& error)
  {
    requireReason(error.what());
  }
  catch (const Finding&)
  {
    throw;
  }
  catch (const std::exception& error)
  {
    throw Finding(std::string("not a reason for a user: ") + error.what());
  }
  return false;
}
}  // namespace sigloc::fuzz

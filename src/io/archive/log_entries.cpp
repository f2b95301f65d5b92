// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose3DPDF.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "io/archive/ArchiveWalk.h"
#include "io/archive/checked_archive.h"
#include "io/archive/UnreadObservation.h"

namespace sigloc::detail
{
namespace
{
using mrpt::serialization::CSerializable;

constexpr char kEnd = '\x88';  // after an object, but not in the oldest files
constexpr std::size_t kMostUnread = std::size_t{1} << 26U;  // bytes of an observation
constexpr std::size_t kMostOfFrame = std::size_t{1} << 27U;
constexpr std::string_view kFrame = "CSensoryFrame";
constexpr std::string_view kOldFrame = "CSensorialFrame";  // before 2008

std::string_view withoutNamespace(std::string_view name)
{
  const std::size_t colon = name.rfind(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

bool isFrame(std::string_view name)
{
  const std::string_view bare = withoutNamespace(name);
  return bare == kFrame || bare == kOldFrame;
}

bool isObservation(std::string_view name)
{
  constexpr std::string_view kUsual = "CObservation";
  if (withoutNamespace(name).substr(0, kUsual.size()) == kUsual) return true;
  const auto* const id = mrpt::rtti::findRegisteredClass(std::string(name));
  return id != nullptr && id->derivedFrom(CLASS_ID(mrpt::obs::CObservation));
}

/// Where an observation stands.
enum class Place
{
  among_others,  // of a frame, or by itself
  last_of_frame,
  last_of_key_frame,  // of a simplemap
  last_of_newer_key_frame,  // of one that may tell a speed
};

constexpr std::string_view kOptional("\x0D\0\0\0std::optional", 17);

/// True where an observation may end. In a log another entry follows, or nothing. In a simplemap
/// the pose of the next key frame follows, or the end of the map.
bool mayEndBefore(std::string_view rest, Place place)
{
  constexpr std::string_view kPose = "CPose";
  if (place == Place::last_of_newer_key_frame) return rest.substr(0, kOptional.size()) == kOptional;
  const bool in_map = place == Place::last_of_key_frame;
  if (rest.empty()) return !in_map;
  if (in_map && rest.size() == 1) return rest.front() == kEnd;
  const auto header = objectHeaderIn(rest.substr(0, kLongestObjectHeader));
  if (!header) return false;
  return in_map ? withoutNamespace(header->name).substr(0, kPose.size()) == kPose
                : isLogClass(std::string(header->name));
}

/// Returns the bytes of the observation that comes next with its end flag, or nullopt where no end
/// is found. Its size is not told: it ends where the next entry of the log begins.
std::optional<std::size_t> lengthOfNext(GzipInput& input, const ObjectHeader& header, Place place)
{
  const bool old = header.old;
  const std::string end_of_frame = old ? "" : std::string(1, kEnd);
  const std::string end = end_of_frame + (place == Place::among_others ? "" : end_of_frame);
  std::size_t at = header.size + (old ? sizeof(std::int32_t) : 1);
  for (std::size_t known = std::size_t{1} << 16U; known <= kMostUnread; known *= 2)
  {
    const std::string_view ahead = input.peek(known);
    const bool whole = ahead.size() < known;
    // A header that is cut off here is looked at again with more bytes.
    const std::size_t until = whole ? ahead.size() : known - kLongestObjectHeader - end.size();
    for (; at + end.size() <= until; ++at)
    {
      if (!old) at = std::min(ahead.find(kEnd, at), until);
      if (at + end.size() > until) break;
      if (ahead.compare(at, end.size(), end) != 0) continue;
      if (mayEndBefore(ahead.substr(at + end.size()), place)) return at + (old ? 0 : 1);
    }
    if (whole) return std::nullopt;
  }
  return std::nullopt;
}

/// Takes the observation that comes next as the bytes that it is; null where its end is not found.
std::shared_ptr<UnreadObservation> takeUnread(GzipInput& input, Place place)
{
  const auto header = objectHeaderIn(input.peek(kLongestObjectHeader));
  if (!header || !isObservation(header->name)) return nullptr;
  std::string name(header->name);
  const std::size_t start = header->size;
  const bool old = header->old;
  const auto length = lengthOfNext(input, *header, place);
  if (!length) return nullptr;
  const std::string_view object = input.peek(*length).substr(0, *length);
  const std::size_t content = start + (old ? sizeof(std::int32_t) : 1);
  const auto version = static_cast<std::uint8_t>(object[start]);
  auto taken = std::make_shared<UnreadObservation>(
      std::move(name), version,
      std::string(object.substr(content, *length - content - (old ? 0 : 1))));
  input.drop(*length);
  return taken;
}

mrpt::obs::CObservation::Ptr takeObservation(GzipInput& input, Place place)
{
  switch (soundnessOfNext(input, only(ArchivePart::observation)))
  {
    case Soundness::unknown:
      return takeUnread(input, place);
    case Soundness::sound:
      return std::dynamic_pointer_cast<mrpt::obs::CObservation>(
          mrpt::serialization::archiveFrom(input).ReadObject());
    case Soundness::unsound:
      break;
  }
  return nullptr;
}

template <class T>
T take(GzipInput& input)
{
  T value{};
  input.Read(&value, sizeof(value));  // zero where the file ends, which what follows notices
  return value;
}

/// Reads a frame that has an observation of an unknown layout in it; null for an unsound one.
mrpt::obs::CSensoryFrame::Ptr takeFrame(GzipInput& input, const ObjectHeader& header, Place last)
{
  const bool old = header.old;
  const std::uint64_t start = input.getPosition();
  input.drop(header.size);
  const int version = old ? take<std::int32_t>(input) : take<std::int8_t>(input);
  if (version < 2) take<std::uint32_t>(input);
  if (version == 0) take<std::uint64_t>(input);
  auto frame = mrpt::obs::CSensoryFrame::Create();
  for (auto left = take<std::uint32_t>(input); left > 0; --left)
  {
    auto observation = takeObservation(input, left == 1 ? last : Place::among_others);
    if (!observation || input.getPosition() - start > kMostOfFrame) return nullptr;
    frame->insert(observation);
  }
  if (!old && take<char>(input) != kEnd) return nullptr;
  return frame;
}

/// Leaves out the speed of a key frame. Returns false where there is none and none is denied.
bool dropTwist(GzipInput& input)
{
  constexpr std::size_t kLongestName = 100;  // of its type
  constexpr std::size_t kBytes = 6 * sizeof(double);
  if (input.peek(kOptional.size()).substr(0, kOptional.size()) != kOptional) return false;
  input.drop(kOptional.size());
  const auto name = take<std::uint32_t>(input);
  if (name > kLongestName || input.peek(name).size() < name) return false;
  input.drop(name);
  if (take<std::uint8_t>(input) == 0) return true;
  if (input.peek(kBytes).size() < kBytes) return false;
  input.drop(kBytes);
  return true;
}
}  // namespace

bool isLogClass(const std::string& name)
{
  return isFrame(name) || withoutNamespace(name) == "CActionCollection" || isObservation(name);
}

CSerializable::Ptr readLogEntry(GzipInput& input)
{
  switch (soundnessOfNext(input, kLogEntry))
  {
    case Soundness::sound:
      return mrpt::serialization::archiveFrom(input).ReadObject();
    case Soundness::unsound:
      return nullptr;
    case Soundness::unknown:
      break;
  }
  const auto header = objectHeaderIn(input.peek(kLongestObjectHeader));
  if (header && isFrame(header->name)) return takeFrame(input, *header, Place::last_of_frame);
  return takeUnread(input, Place::among_others);
}

bool takeMixedSimplemap(GzipInput& input, mrpt::maps::CSimpleMap& map)
{
  constexpr int kOldest = 1;  // older ones never had other observations
  constexpr int kWithTwist = 2;
  const auto header = objectHeaderIn(input.peek(kLongestObjectHeader));
  if (!header || header->old) return false;
  input.drop(header->size);
  const int version = take<std::int8_t>(input);
  if (version < kOldest || version > kWithTwist) return false;
  const Place last =
      version < kWithTwist ? Place::last_of_key_frame : Place::last_of_newer_key_frame;
  map.clear();
  for (auto left = take<std::uint32_t>(input); left > 0; --left)
  {
    if (soundnessOfNext(input, only(ArchivePart::distribution_3d)) != Soundness::sound)
      return false;
    const auto pose = std::dynamic_pointer_cast<mrpt::poses::CPose3DPDF>(
        mrpt::serialization::archiveFrom(input).ReadObject());
    const auto frame_header = objectHeaderIn(input.peek(kLongestObjectHeader));
    if (!pose || !frame_header || !isFrame(frame_header->name)) return false;
    const auto frame = takeFrame(input, *frame_header, last);
    if (!frame || (version >= kWithTwist && !dropTwist(input))) return false;
    map.insert(pose, frame);
  }
  return take<char>(input) == kEnd;
}
}  // namespace sigloc::detail

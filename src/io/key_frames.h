// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/maps/CSimpleMap.h>

#include <cstddef>
#include <tuple>

namespace sigloc
{
/// A key frame of a simplemap; either may be null.
struct KeyFrame
{
  mrpt::poses::CPose3DPDF::ConstPtr pose;
  mrpt::obs::CSensoryFrame::ConstPtr frame;
};

namespace detail
{
/// Since MRPT 2.11.5 an entry is a struct, before it was a tuple.
template <class Entry>
auto toKeyFrame(const Entry& entry, int) -> decltype(entry.sf, KeyFrame())
{
  return {entry.pose, entry.sf};
}
template <class Entry>
KeyFrame toKeyFrame(const Entry& entry, long)
{
  return {std::get<0>(entry), std::get<1>(entry)};
}
}  // namespace detail

/// Returns a key frame of a simplemap of any version of MRPT from 2.5 on.
inline KeyFrame keyFrameOf(const mrpt::maps::CSimpleMap& map, std::size_t index)
{
  return detail::toKeyFrame(map.get(index), 0);
}
}  // namespace sigloc

// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <stdexcept>
#include <type_traits>

#include "ros1/LocalizationNode.h"

namespace sigloc::ros1
{
namespace
{
/// Reads a parameter where it is given. Throws std::invalid_argument for one of another type.
template <class T>
void read(const ros::NodeHandle& parameters, const std::string& key, T& value)
{
  if (!parameters.hasParam(key)) return;
  if (!parameters.getParam(key, value))
  {
    throw std::invalid_argument("parameter " + parameters.resolveName(key) + " is of another type");
  }
}

/// Those of an options struct, in a namespace of their own.
template <class Options>
void readOptions(const ros::NodeHandle& parameters, const std::string& space, Options& options)
{
  Options::visitFields(
      [&](const auto& field)
      {
        using T = std::decay_t<decltype(options.*(field.member))>;
        const std::string key = space + "/" + field.key;
        if constexpr (std::is_same_v<T, std::uint32_t>)
        {
          int value = static_cast<int>(options.*(field.member));
          read(parameters, key, value);
          if (value < 0) throw std::invalid_argument("parameter " + key + " is negative");
          options.*(field.member) = static_cast<T>(value);
        }
        else
        {
          read(parameters, key, options.*(field.member));
        }
      });
  checkOptions(options);
}
}  // namespace

NodeParameters readParameters(const ros::NodeHandle& parameters)
{
  NodeParameters read_ones;
  read(parameters, "map_file", read_ones.map_file);
  read(parameters, "map_frame", read_ones.map_frame);
  read(parameters, "odom_frame", read_ones.odom_frame);
  read(parameters, "base_frame", read_ones.base_frame);
  read(parameters, "odom_topic", read_ones.odom_topic);
  read(parameters, "publish_tf", read_ones.publish_tf);
  read(parameters, "transform_tolerance", read_ones.transform_tolerance);
  if (!(read_ones.transform_tolerance >= 0 && read_ones.transform_tolerance <= 10))
  {
    throw std::invalid_argument("parameter transform_tolerance is not within [0, 10] s");
  }
  readOptions(parameters, "reading", read_ones.reading);
  readOptions(parameters, "tracker", read_ones.tracker);
  readOptions(parameters, "policy", read_ones.policy);
  return read_ones;
}
}  // namespace sigloc::ros1

// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

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

/// Calls `visit(key, value, description)` for each parameter that is of no options struct.
template <class Visit>
void visitPlain(NodeParameters& parameters, Visit&& visit)
{
  NodeParameters& p = parameters;
  visit("map_file", p.map_file,
        "any map that sigloc-map takes, a .sigmap or .simplemap best; without it the topic map");
  visit("map_frame", p.map_frame, "the frame of the map");
  visit("odom_frame", p.odom_frame, "the frame of the odometry; empty: no odometry");
  visit("base_frame", p.base_frame, "the frame of the robot");
  visit("odom_topic", p.odom_topic, "nav_msgs/Odometry, instead of the transform");
  visit("publish_tf", p.publish_tf, "the transform from map to odometry instead of initialpose");
  visit("transform_tolerance", p.transform_tolerance,
        "[s] for how long transforms are waited for, and dated ahead");
}

/// Calls `visit(namespace, options)` for each options struct: its fields are in that namespace.
template <class Visit>
void visitStructs(NodeParameters& parameters, Visit&& visit)
{
  visit("reading", parameters.reading);
  visit("policy", parameters.policy);
  visit("tracker", parameters.tracker);
}

std::string textOf(const std::string& value)
{
  return value;
}

template <class T>
std::string textOf(T value)
{
  return detail::formatValue(value);
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
  visitPlain(read_ones,
             [&](const char* key, auto& value, const char*) { read(parameters, key, value); });
  if (!(read_ones.transform_tolerance >= 0 && read_ones.transform_tolerance <= 10))
  {
    throw std::invalid_argument("parameter transform_tolerance is not within [0, 10] s");
  }
  visitStructs(read_ones,
               [&](const char* space, auto& options) { readOptions(parameters, space, options); });
  return read_ones;
}

std::string describeParameters()
{
  NodeParameters defaults;
  std::string lines = "Parameters with their defaults:\n";
  const auto add = [&](const std::string& key, const std::string& value, const char* description)
  { lines += fmt::format("  _{}:={}  {}\n", key, value, description); };
  visitPlain(defaults, [&](const char* key, const auto& value, const char* description)
             { add(key, textOf(value), description); });
  visitStructs(
      defaults,
      [&](const std::string& space, const auto& options)
      {
        std::decay_t<decltype(options)>::visitFields(
            [&](const auto& field)
            { add(space + "/" + field.key, textOf(options.*(field.member)), field.description); });
      });
  return lines;
}
}  // namespace sigloc::ros1

// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The node `sigloc` of ROS 1; see ros/README.md.
#include <cstdio>
#include <exception>

#include "ros1/LocalizationNode.h"
#include "sigloc/io/file_output.h"

int main(int argc, char** argv)
{
  ros::init(argc, argv, "sigloc");
  try
  {
    const sigloc::ros1::LocalizationNode node(sigloc::ros1::readParameters(ros::NodeHandle("~")));
    ros::spin();
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "sigloc: %s\n", sigloc::firstLine(error.what()).c_str());
    return 1;
  }
  return 0;
}

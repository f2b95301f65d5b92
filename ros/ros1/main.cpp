// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
//
// sigloc-ros1-node: the node `sigloc` of ROS 1; see ros/README.md.
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "ros1/LocalizationNode.h"
#include "run_app.h"

int main(int argc, char** argv)
{
  CLI::App app("Finds a lost robot with ROS 1 in its map.", "sigloc-ros1-node");
  // ROS reads these itself, later. They are declared for --help, and so that others are refused.
  std::vector<std::string> words;
  app.add_option(
         "words", words,
         "as for every node: _map_file:=my_map.yaml sets a parameter, scan:=front/scan takes "
         "another topic")
      ->type_name("NAME:=VALUE")
      ->check(
          [](const std::string& word)
          {
            return word.find(":=") != std::string::npos ? std::string()
                                                        : "'" + word + "' is no NAME:=VALUE";
          });
  app.footer(sigloc::ros1::describeParameters() +
             "\nTopics and services are listed in /usr/share/doc/sigloc-ros1/README.md.");
  return sigloc::runApp(app, argc, argv,
                        [&]
                        {
                          ros::init(argc, argv, "sigloc");
                          const sigloc::ros1::LocalizationNode node(
                              sigloc::ros1::readParameters(ros::NodeHandle("~")));
                          ros::spin();
                          return 0;
                        });
}

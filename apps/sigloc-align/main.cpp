// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
//
// sigloc-align: the pose of one map in another, without a guess.
#include <CLI/CLI.hpp>

#include "arguments.h"
#include "load_work.h"
#include "number_option.h"
#include "out_option.h"
#include "run_app.h"
#include "sigloc/io/map_files.h"

int main(int argc, char** argv)
{
  CLI::App app("Finds the pose of map B in map A, without a guess: every one that is possible.",
               "sigloc-align");
  app.footer("Exit codes: 0 done, 1 bad input, 3 no pose is possible (nothing written).");
  sigloc::AlignArguments arguments;
  app.add_option("A", arguments.a,
                 "map: " + sigloc::mapFormatNames() +
                     ". .gz or .zst may follow, but for ROS maps and images")
      ->required();
  app.add_option("B", arguments.b, "map whose pose in A is asked")->required();
  arguments.reading.declare(app);
  app.add_option(sigloc::kOut, arguments.output,
                 "folder for poses.CPosePDFSOG and align.png, where they are not named");
  app.add_option("--poses", arguments.poses, "file to write, named *.CPosePDFSOG");
  app.add_option("--picture", arguments.picture, "PNG to write: B over A at the first pose");
  sigloc::addNumber(app, "--places", arguments.options.places, "of B whose views are looked for", 1,
                    1e5);
  const auto work = [&]
  {
    return sigloc::loadWork<decltype(siglocAlign)>("siglocAlign",
                                                   sigloc::Pictures::none)(arguments);
  };
  return sigloc::runApp(app, argc, argv, work);
}

// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cstdlib>
#include <fstream>

#include "fuzz/targets.h"

namespace sigloc::fuzz
{
namespace
{
/// Removed when the process ends in good order.
class Folder
{
 public:
  Folder()
  {
    const std::filesystem::path in_memory = "/dev/shm";
    const auto parent = std::filesystem::is_directory(in_memory)
                            ? in_memory
                            : std::filesystem::temp_directory_path();
    std::string pattern = (parent / "sigloc-fuzz-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw Finding("no folder for inputs");
    path = pattern;
  }
  ~Folder()
  {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::filesystem::path path;
};

const std::filesystem::path& folder()
{
  static const Folder made;
  return made.path;
}
}  // namespace

std::filesystem::path inputFile(const std::string& name, std::string_view bytes)
{
  const std::filesystem::path path = folder() / name;
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<long>(bytes.size()));
  return path;
}

void requireReason(const std::string& message)
{
  constexpr std::size_t kLongest = 4000;
  // A ROS map may name any image.
  require(message.compare(0, 1, "/") == 0 && message.find(": ") != std::string::npos,
          "a reason that names no file: " + message);
  require(message.find('\n') == std::string::npos, "a reason of several lines: " + message);
  require(message.size() < kLongest, "a reason that is too long: " + message.substr(0, kLongest));
}
}  // namespace sigloc::fuzz

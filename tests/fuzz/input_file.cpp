// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fcntl.h>
#include <unistd.h>

#include <cstdlib>
#include <map>
#include <utility>

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

/// A file that stays open: what it holds is changed far more often than its name.
class InputFile
{
 public:
  explicit InputFile(std::filesystem::path path) : path_(std::move(path))
  {
    std::filesystem::create_directories(path_.parent_path());
    fd_ = open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    if (fd_ < 0) throw Finding("no file for inputs");
  }
  ~InputFile() { close(fd_); }
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  const std::filesystem::path& holding(std::string_view bytes)
  {
    const auto size = static_cast<ssize_t>(bytes.size());
    if (pwrite(fd_, bytes.data(), bytes.size(), 0) != size || ftruncate(fd_, size) != 0)
      throw Finding("no room for inputs");
    return path_;
  }

 private:
  std::filesystem::path path_;
  int fd_;
};
}  // namespace

const std::filesystem::path& inputFile(const std::string& name, std::string_view bytes)
{
  static std::map<std::string, InputFile> files;
  return files.try_emplace(name, folder() / name).first->second.holding(bytes);
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

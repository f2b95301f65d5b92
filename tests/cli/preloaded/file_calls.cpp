// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause

// Preloaded into a program, it writes down some of its calls in the file $SIGLOC_FILE_CALLS. They
// wait until a disk holds a file, make a folder, or rename something. The program is killed as it
// removes its $SIGLOC_DIE_AT-th file. Names cannot be exchanged where $SIGLOC_NO_EXCHANGE is set,
// and the program is killed where the second of three renames would take their place.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace
{
bool exchange_refused = false;

void note(const std::string& line)
{
  const char* const path = std::getenv("SIGLOC_FILE_CALLS");
  const int file = path ? open(path, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600) : -1;
  // One write each, so that lines of child processes do not mix.
  const std::string bytes = line + "\n";
  if (file < 0 || write(file, bytes.data(), bytes.size()) < 0) std::abort();
  close(file);
}

std::string pathOf(const char* name)
{
  char real[PATH_MAX] = {};
  return realpath(name, real) ? real : "";
}

std::string pathOf(int file)
{
  return pathOf(("/proc/self/fd/" + std::to_string(file)).c_str());
}

template <class Function>
Function next(const char* name)
{
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}
}  // namespace

extern "C" int fsync(int file)
{
  note("fsync\t" + pathOf(file));
  return next<int (*)(int)>("fsync")(file);
}

extern "C" int syncfs(int file) noexcept
{
  note("syncfs\t" + pathOf(file));
  return next<int (*)(int)>("syncfs")(file);
}

extern "C" int mkdir(const char* path, mode_t mode) noexcept
{
  const int result = next<int (*)(const char*, mode_t)>("mkdir")(path, mode);
  if (result == 0) note("mkdir\t" + pathOf(path));
  return result;
}

extern "C" int rename(const char* from, const char* to) noexcept
{
  static int renamed = 0;
  if (exchange_refused && ++renamed == 2) raise(SIGKILL);
  const std::string old_path = pathOf(from);
  const int result = next<int (*)(const char*, const char*)>("rename")(from, to);
  if (result == 0) note("rename\t" + old_path + "\t" + pathOf(to));
  return result;
}

extern "C" int renameat2(int from_folder, const char* from, int to_folder, const char* to,
                         unsigned int flags) noexcept
{
  if (std::getenv("SIGLOC_NO_EXCHANGE") != nullptr)
  {
    exchange_refused = true;
    errno = EINVAL;
    return -1;
  }
  const std::string old_path = pathOf(from);
  const int result = next<int (*)(int, const char*, int, const char*, unsigned int)>("renameat2")(
      from_folder, from, to_folder, to, flags);
  if (result == 0) note("rename\t" + old_path + "\t" + pathOf(to));
  return result;
}

extern "C" int unlinkat(int folder, const char* path, int flags) noexcept
{
  static int removed = 0;
  const char* const last = std::getenv("SIGLOC_DIE_AT");
  if (last != nullptr && ++removed == std::atoi(last)) raise(SIGKILL);
  return next<int (*)(int, const char*, int)>("unlinkat")(folder, path, flags);
}

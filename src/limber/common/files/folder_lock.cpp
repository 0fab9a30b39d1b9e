// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/files/folder_lock.hpp"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <ctime>
#include <string>
#include <system_error>

#include "limber/common/echo.hpp"
#include "limber/common/errors.hpp"

namespace limber {
namespace {

namespace fs = std::filesystem;

std::string describe_this_process() {
  std::array<char, 256> host = {};
  gethostname(host.data(), host.size() - 1);
  return fmt::format("process {} on '{}', since {:%Y-%m-%d %H:%M:%S} UTC\n",
                     getpid(), host.data(), fmt::gmtime(std::time(nullptr)));
}

std::string read_start(int descriptor) {
  std::array<char, 512> text = {};
  const ssize_t count = pread(descriptor, text.data(), text.size(), 0);
  std::string holder(text.data(), count > 0 ? static_cast<std::size_t>(count)
                                            : std::size_t{0});
  while (holder.ends_with('\n')) holder.pop_back();
  return holder.empty() ? "another process" : echo(holder);
}

// The previous holder may have removed the file that was opened here.
bool is_file_at(const fs::path& path, int descriptor) {
  struct stat there = {};
  struct stat here = {};
  return stat(path.c_str(), &there) == 0 && fstat(descriptor, &here) == 0 &&
         there.st_dev == here.st_dev && there.st_ino == here.st_ino;
}

int open_lock(const fs::path& folder, const fs::path& file) {
  const int descriptor =
      open(file.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC,
           0644);
  if (descriptor >= 0) return descriptor;
  throw InputError(fmt::format(
      "results folder '{}' cannot be written ({}); choose another with --out",
      folder.string(), describe_errno()));
}

}  // namespace

FolderLock::FolderLock(const fs::path& folder)
    : file_(folder / ".limber-lock") {
  while (!is_held_) {
    descriptor_ = open_lock(folder, file_);
    if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
      if (errno != EWOULDBLOCK) return;
      const std::string holder = read_start(descriptor_);
      close(descriptor_);
      throw InputError(fmt::format(
          "results folder '{}' is in use by {}; wait for its end, or choose "
          "another with --out",
          folder.string(), holder));
    }
    is_held_ = is_file_at(file_, descriptor_);
    if (!is_held_) close(descriptor_);
  }
  const std::string text = describe_this_process();
  // Affects only the name in the other process's message.
  if (ftruncate(descriptor_, 0) == 0) {
    static_cast<void>(!pwrite(descriptor_, text.data(), text.size(), 0));
  }
}

FolderLock::~FolderLock() {
  std::error_code ignored;
  if (is_held_) fs::remove(file_, ignored);
  close(descriptor_);
}

}  // namespace limber

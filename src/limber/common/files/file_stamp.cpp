// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/files/file_stamp.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <optional>

#include "limber/common/records/digest.hpp"
#include "limber/common/records/wire.hpp"

namespace limber {
namespace {

constexpr const char* kAbsent = "absent";
constexpr const char* kThere = "there";

std::optional<struct stat> look(const std::filesystem::path& file) {
  struct stat info {};
  if (::stat(file.c_str(), &info) != 0) return std::nullopt;
  return info;
}

std::string digest_bytes(const std::filesystem::path& file) {
  // Does not block on a pipe that replaced the file.
  const int fd = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (fd < 0) return kThere;
  Digest digest;
  std::array<char, 1 << 16> buffer{};
  ssize_t count = 0;
  while ((count = ::read(fd, buffer.data(), buffer.size())) > 0) {
    digest.add_bytes(buffer.data(), static_cast<std::size_t>(count));
  }
  ::close(fd);
  return count < 0 ? kThere : "content " + digest.text();
}

}  // namespace

FileStamp stamp_content(const std::filesystem::path& file) {
  const std::optional<struct stat> info = look(file);
  if (!info) return {file, kAbsent};
  return {file, S_ISREG(info->st_mode) ? digest_bytes(file) : kThere};
}

FileStamp stamp_presence(const std::filesystem::path& file) {
  return {file, look(file) ? kThere : kAbsent};
}

FileStamp stamp_version(const std::filesystem::path& file) {
  const std::optional<struct stat> info = look(file);
  if (!info) return {file, kAbsent};
  return {file, fmt::format("version {} {}.{:09} {}", info->st_size,
                            info->st_mtim.tv_sec, info->st_mtim.tv_nsec,
                            info->st_ino)};
}

bool is_unchanged(const FileStamp& stamp) {
  if (stamp.mark.starts_with("content "))
    return stamp_content(stamp.path) == stamp;
  if (stamp.mark.starts_with("version "))
    return stamp_version(stamp.path) == stamp;
  return stamp_presence(stamp.path) == stamp;
}

void exchange(Wire& wire, FileStamp& stamp) {
  std::string path = stamp.path.string();
  wire(path, stamp.mark);
  stamp.path = path;
}

}  // namespace limber

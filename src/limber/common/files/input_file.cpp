// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/files/input_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "limber/common/errors.hpp"

namespace limber {
namespace {

const char* name_type(mode_t mode) {
  if (S_ISDIR(mode)) return "a folder";
  if (S_ISFIFO(mode)) return "a pipe";
  if (S_ISSOCK(mode)) return "a socket";
  return "a device";
}

std::string describe_size(std::uint64_t bytes) {
  constexpr double kMebi = 1048576.0;
  const double size = static_cast<double>(bytes) / kMebi;
  return size < 1024.0 ? fmt::format("{:.4g} MiB", size)
                       : fmt::format("{:.4g} GiB", size / 1024.0);
}

}  // namespace

InputFile::InputFile(std::filesystem::path file, const InputKind& kind)
    : file_(std::move(file)), kind_(kind) {
  // Does not block on a pipe without a writer.
  descriptor_ = open(file_.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor_ < 0) refuse(describe_errno());
  try {
    struct stat status = {};
    if (fstat(descriptor_, &status) != 0) refuse(describe_errno());
    if (!S_ISREG(status.st_mode)) {
      refuse(fmt::format("it is {}; expected a regular file",
                         name_type(status.st_mode)));
    }
    check_size(static_cast<std::uint64_t>(status.st_size));
  } catch (...) {
    close(descriptor_);
    throw;
  }
}

InputFile::~InputFile() { close(descriptor_); }

void InputFile::refuse(const std::string& why) const {
  throw InputError(fmt::format("{}: cannot read this {}: {}", file_.string(),
                               kind_.name, why));
}

void InputFile::check_size(std::uint64_t size) const {
  if (size <= kind_.most_bytes) return;
  refuse(fmt::format("it has {}; at most {} are read", describe_size(size),
                     describe_size(kind_.most_bytes)));
}

std::size_t InputFile::read(char* out, std::size_t size) {
  std::size_t done = 0;
  while (done < size) {
    const ssize_t count = ::read(descriptor_, out + done, size - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) refuse(describe_errno());
    if (count == 0) break;
    done += static_cast<std::size_t>(count);
  }
  read_ += done;
  check_size(read_);
  return done;
}

std::string read_input(const std::filesystem::path& file,
                       const InputKind& kind) {
  constexpr std::size_t kBlock = std::size_t{1} << 16;
  InputFile input(file, kind);
  std::string text;
  for (std::size_t count = kBlock; count == kBlock;) {
    const std::size_t before = text.size();
    text.resize(before + kBlock);
    count = input.read(text.data() + before, kBlock);
    text.resize(before + count);
  }
  return text;
}

void check_input(const std::filesystem::path& file, const InputKind& kind) {
  const InputFile input(file, kind);
}

}  // namespace limber

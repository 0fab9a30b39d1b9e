// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/files/append_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>
#include <utility>

#include "limber/common/errors.hpp"

namespace limber {
namespace {

[[noreturn]] void fail(const std::filesystem::path& file, const char* what,
                       const std::string& why) {
  throw InputError(fmt::format("'{}' {}: {}", file.string(), what, why));
}

std::string read_part(const std::filesystem::path& file, const FilePart& part) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) {
    fail(file, "cannot be read", "there is no such file");
  }
  const auto size = std::filesystem::file_size(file, error);
  if (error || size < part.length) {
    fail(file, "is damaged",
         fmt::format("{} bytes, of which {} are missing", part.length,
                     part.length - (error ? 0 : size)));
  }
  std::string bytes(part.length, '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  Digest digest;
  digest.add_bytes(bytes.data(), bytes.size());
  if (!in || digest.text() != part.digest) {
    fail(file, "is damaged", "its digest does not match its content");
  }
  return bytes;
}

}  // namespace

AppendFile::AppendFile(std::filesystem::path file) : file_(std::move(file)) {
  open(O_CREAT | O_TRUNC);
}

AppendFile::AppendFile(std::filesystem::path file, const FilePart& part)
    : file_(std::move(file)), length_(part.length) {
  const std::string bytes = read_part(file_, part);
  digest_.add_bytes(bytes.data(), bytes.size());
  open(0);
  cut_off();
}

AppendFile::~AppendFile() {
  if (handle_ >= 0) close(handle_);
}

void AppendFile::open(int flags) {
  handle_ = ::open(file_.c_str(), O_WRONLY | O_CLOEXEC | flags, 0666);
  if (handle_ < 0) fail(file_, "cannot be written", describe_errno());
}

void AppendFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(handle_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) fail(file_, "cannot be written", describe_errno());
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void AppendFile::cut_off() {
  if (ftruncate(handle_, static_cast<off_t>(length_)) != 0 ||
      lseek(handle_, 0, SEEK_END) < 0) {
    fail(file_, "cannot be written", describe_errno());
  }
}

void AppendFile::append(std::string_view block) {
  const std::uint64_t size = block.size();
  std::string bytes(sizeof(size), '\0');
  std::memcpy(bytes.data(), &size, sizeof(size));
  bytes += block;
  cut_off();  // remains of a failed attempt
  try {
    write(bytes);
    if (fdatasync(handle_) != 0) {
      fail(file_, "cannot be written", describe_errno());
    }
  } catch (const InputError&) {
    cut_off();
    throw;
  }
  digest_.add_bytes(bytes.data(), bytes.size());
  length_ += bytes.size();
}

std::vector<std::string> read_blocks(const std::filesystem::path& file,
                                     const FilePart& part) {
  const std::string bytes = read_part(file, part);
  std::vector<std::string> blocks;
  std::uint64_t size = 0;
  for (std::size_t at = 0; at < bytes.size(); at += sizeof(size) + size) {
    if (bytes.size() - at < sizeof(size)) fail(file, "is damaged", "cut short");
    std::memcpy(&size, bytes.data() + at, sizeof(size));
    if (size > bytes.size() - at - sizeof(size)) {
      fail(file, "is damaged", "a block is longer than the file");
    }
    blocks.push_back(bytes.substr(at + sizeof(size), size));
  }
  return blocks;
}

}  // namespace limber

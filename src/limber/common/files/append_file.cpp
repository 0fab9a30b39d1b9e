// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/files/append_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
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

// Adds a part's bytes to the digest, which must then be the part's.
void check_part(const std::filesystem::path& file, const FilePart& part,
                Digest& digest) {
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
  std::ifstream in(file, std::ios::binary);
  std::string bytes(std::size_t{1} << 20, '\0');
  for (std::uint64_t left = part.length; in && left > 0;) {
    const std::size_t count = std::min<std::uint64_t>(left, bytes.size());
    in.read(bytes.data(), static_cast<std::streamsize>(count));
    digest.add_bytes(bytes.data(), count);
    left -= count;
  }
  if (!in || digest.text() != part.digest) {
    fail(file, "is damaged", "its digest does not match its content");
  }
}

}  // namespace

AppendFile::AppendFile(std::filesystem::path file) : file_(std::move(file)) {
  open(O_CREAT | O_TRUNC);
}

AppendFile::AppendFile(std::filesystem::path file, const FilePart& part)
    : file_(std::move(file)), length_(part.length) {
  check_part(file_, part, digest_);
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

void AppendFile::append(const Blocks& next) {
  cut_off();  // remains of a failed attempt
  std::uint64_t length = length_;
  Digest digest = digest_;
  try {
    while (const std::optional<std::string> block = next()) {
      const std::uint64_t size = block->size();
      std::string bytes(sizeof(size), '\0');
      std::memcpy(bytes.data(), &size, sizeof(size));
      bytes += *block;
      write(bytes);
      digest.add_bytes(bytes.data(), bytes.size());
      length += bytes.size();
    }
    if (fdatasync(handle_) != 0) {
      fail(file_, "cannot be written", describe_errno());
    }
  } catch (const InputError&) {
    cut_off();
    throw;
  }
  digest_ = std::move(digest);
  length_ = length;
}

void AppendFile::append(std::string block) {
  std::optional<std::string> left = std::move(block);
  append([&left] { return std::exchange(left, std::nullopt); });
}

void visit_blocks(const std::filesystem::path& file, const FilePart& part,
                  const std::function<void(std::string)>& visit) {
  Digest digest;
  check_part(file, part, digest);
  std::ifstream in(file, std::ios::binary);
  std::uint64_t size = 0;
  for (std::uint64_t left = part.length; left > 0; left -= size) {
    if (left < sizeof(size)) fail(file, "is damaged", "cut short");
    in.read(reinterpret_cast<char*>(&size), sizeof(size));
    left -= sizeof(size);
    if (size > left) {
      fail(file, "is damaged", "a block is longer than the file");
    }
    std::string block(size, '\0');
    in.read(block.data(), static_cast<std::streamsize>(size));
    if (!in) fail(file, "cannot be read", describe_errno());
    visit(std::move(block));
  }
}

}  // namespace limber

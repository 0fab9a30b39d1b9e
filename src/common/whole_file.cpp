// SPDX-License-Identifier: BSD-3-Clause
#include "common/whole_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <system_error>

namespace limber {
namespace {

// Of nobody else: processes and threads may write the same file.
std::filesystem::path make_part_name(const std::filesystem::path& file) {
  static std::atomic<unsigned> count{0};
  std::filesystem::path part = file;
  part += fmt::format(".part{}-{}", getpid(), count++);
  return part;
}

}  // namespace

void write_whole(
    const std::filesystem::path& file,
    const std::function<void(const std::filesystem::path&)>& write) {
  const std::filesystem::path part = make_part_name(file);
  try {
    write(part);
    std::filesystem::rename(part, file);
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(part, ignored);
    throw;
  }
}

}  // namespace limber

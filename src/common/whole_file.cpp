// SPDX-License-Identifier: BSD-3-Clause
#include "common/whole_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <string>
#include <system_error>

#include "common/errors.hpp"

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
  std::error_code unknown;
  if (std::filesystem::is_other(file, unknown)) {
    write(file);
    return;
  }
  const std::filesystem::path part = make_part_name(file);
  std::error_code error;
  try {
    write(part);
    std::filesystem::rename(part, file, error);
  } catch (...) {
    std::filesystem::remove(part, error);
    throw;
  }
  if (!error) return;
  const std::string why = error.message();
  std::filesystem::remove(part, error);
  throw InputError(
      fmt::format("'{}' cannot be written: {}", file.string(), why));
}

}  // namespace limber

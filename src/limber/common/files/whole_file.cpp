// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/files/whole_file.hpp"

#include <fmt/format.h>

#include <fstream>
#include <string>
#include <system_error>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/common/files/unfinished_files.hpp"

namespace limber {
namespace {

// Users know the destination, not the temporary name.
InputError rename(const InputError& error, const std::string& part,
                  const std::string& file) {
  std::vector<std::string> problems = error.problems();
  for (std::string& text : problems) {
    const std::size_t at = text.find(part);
    if (at != std::string::npos) text.replace(at, part.size(), file);
  }
  return InputError(problems);
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
  UnfinishedFile part(file);
  try {
    write(part.path());
  } catch (const InputError& error) {
    throw rename(error, part.path().string(), file.string());
  }
  part.move_to(file);
}

void write_whole(const std::filesystem::path& file, std::string_view bytes) {
  write_whole(file, [&](const std::filesystem::path& part) {
    std::ofstream out(part, std::ios::binary);
    out << bytes;
    out.close();
    if (out) return;
    throw InputError(fmt::format(
        "'{}' cannot be written; is the disk full, and does its folder exist?",
        file.string()));
  });
}

}  // namespace limber

// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/process/helper_program.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <system_error>

#include "limber/common/errors.hpp"
#include "limber/common/files/own_file.hpp"

namespace limber {

bool can_run(const std::filesystem::path& program) {
  std::error_code unknown;
  return std::filesystem::is_regular_file(program, unknown) &&
         access(program.c_str(), X_OK) == 0;
}

std::filesystem::path find_helper(const std::string& what,
                                  const std::string& name,
                                  const std::string& remedy) {
  const std::filesystem::path folder = find_own_file().parent_path();
  const std::array<std::filesystem::path, 3> places = {
      folder / name, folder.parent_path() / "libexec/limber" / name,
      std::filesystem::path(LIMBER_LIBEXEC_DIR) / name};
  for (const std::filesystem::path& place : places) {
    if (can_run(place)) return std::filesystem::canonical(place);
  }
  throw InputError(fmt::format(
      "{} '{}' was not found; looked for {}, {} and {}. {}", what, name,
      places[0].string(), places[1].string(), places[2].string(), remedy));
}

void become(const std::filesystem::path& program, char** argv) {
  std::fflush(nullptr);
  execv(program.c_str(), argv);
  throw InputError(fmt::format("{} cannot be started ({}).", program.string(),
                               std::strerror(errno)));
}

}  // namespace limber

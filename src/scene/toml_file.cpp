// SPDX-License-Identifier: BSD-3-Clause
#include "scene/toml_file.hpp"

#include <fmt/format.h>

#include <fstream>
#include <sstream>

#include "common/errors.hpp"

namespace limber::scene {

toml::table parse_toml_file(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  if (!stream || !(text << stream.rdbuf())) {
    throw InputError(
        fmt::format("{}: cannot read this scenario file", file.string()));
  }
  try {
    return toml::parse(text.str());
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}:{}: not valid TOML: {}", file.string(),
                                 error.source().begin.line,
                                 error.description()));
  }
}

}  // namespace limber::scene

// SPDX-License-Identifier: BSD-3-Clause
#include "scene/toml_file.hpp"

#include <fmt/format.h>

#include <fstream>
#include <sstream>

#include "common/errors.hpp"
#include "scene/key_depth.hpp"

namespace limber::scene {

toml::table parse_toml_file(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  if (!stream || !(text << stream.rdbuf())) {
    throw InputError(
        fmt::format("{}: cannot read this scenario file", file.string()));
  }
  const std::string toml = text.str();
  if (const auto line = find_overlong_key(toml)) {
    throw InputError(
        fmt::format("{}:{}: a key of more than {} parts; no key of a scenario "
                    "has so many dots",
                    file.string(), *line, kMostKeyParts));
  }
  try {
    return toml::parse(toml);
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}:{}: not valid TOML: {}", file.string(),
                                 error.source().begin.line,
                                 error.description()));
  }
}

}  // namespace limber::scene

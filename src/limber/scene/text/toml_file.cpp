// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/text/toml_file.hpp"

#include <fmt/format.h>

#include "limber/common/echo.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/files/input_file.hpp"
#include "limber/scene/text/key_depth.hpp"

namespace limber::scene {
namespace {

constexpr InputKind kScenario = {"scenario file", std::uint64_t{1} << 26};

}  // namespace

toml::table parse_toml_file(const std::filesystem::path& file) {
  const std::string toml = read_input(file, kScenario);
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
                                 echo(error.description())));
  }
}

}  // namespace limber::scene

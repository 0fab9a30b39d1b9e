// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/text/setting.hpp"

#include <fmt/format.h>

#include <charconv>

#include "limber/common/echo.hpp"
#include "limber/common/errors.hpp"
#include "limber/scene/text/key_depth.hpp"

namespace limber::scene {
namespace {

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
  throw InputError(fmt::format("path '{}' {}", echo(path), why));
}

/// Where the path ends: the first '=' outside of quotes.
std::size_t find_equals(std::string_view text) {
  bool is_quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') is_quoted = !is_quoted;
    if (text[i] == '=' && !is_quoted) return i;
  }
  return std::string_view::npos;
}

std::string trim(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return "";
  const std::size_t last = text.find_last_not_of(" \t");
  return std::string(text.substr(first, last - first + 1));
}

/// Takes one part off the front of `rest`, and the dot behind it.
std::string take_part(const std::string& path, std::string_view& rest) {
  std::string part;
  if (rest.starts_with('"')) {
    const std::size_t end = rest.find('"', 1);
    if (end == std::string_view::npos) refuse(path, "has an open quote");
    part = rest.substr(1, end - 1);
    rest.remove_prefix(end + 1);
    if (!rest.empty() && !rest.starts_with('.')) {
      refuse(path, "has no dot behind a quote");
    }
  } else {
    part = rest.substr(0, rest.find('.'));
    rest.remove_prefix(part.size());
  }
  if (part.empty()) refuse(path, "has an empty part");
  return part;
}

}  // namespace

std::string quote_part(const std::string& part) {
  return part.find('.') == std::string::npos ? part : '"' + part + '"';
}

Setting parse_setting(std::string_view text) {
  const std::size_t equals = find_equals(text);
  if (equals == std::string_view::npos) {
    throw InputError(
        fmt::format("--set '{}' is no KEY=VALUE, such as time.step=1e-4",
                    echo(std::string(text))));
  }
  Setting setting{trim(text.substr(0, equals)), trim(text.substr(equals + 1))};
  if (setting.path.empty()) {
    throw InputError(fmt::format("--set '{}' has no key before '='",
                                 echo(std::string(text))));
  }
  return setting;
}

std::string to_string(const Setting& setting) {
  if (!setting.value) return "--unset " + echo(setting.path);
  return fmt::format("--set {}={}", echo(setting.path), echo(*setting.value));
}

std::vector<std::string> split_path(const std::string& path) {
  std::vector<std::string> parts;
  std::string_view rest = path;
  for (;;) {
    parts.push_back(take_part(path, rest));
    if (parts.size() > static_cast<std::size_t>(kMostKeyParts)) {
      refuse(path, fmt::format("has more than {} parts", kMostKeyParts));
    }
    if (rest.empty()) return parts;
    rest.remove_prefix(1);
  }
}

std::optional<std::size_t> to_index(const std::string& part) {
  std::size_t index = 0;
  const char* const end = part.data() + part.size();
  const auto [stop, error] = std::from_chars(part.data(), end, index);
  if (error != std::errc() || stop != end) return std::nullopt;
  return index;
}

}  // namespace limber::scene

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace limber::scene {

/// One key of a scenario or robot, set or removed after its file is read
/// (`--set PATH=VALUE`, `--unset PATH`).
struct Setting {
  /// Dotted; parts with dots are in double quotes: load."a.b".force.2
  std::string path;
  /// TOML; text that is no TOML value is a string. None: the key is removed.
  std::optional<std::string> value = {};

  bool operator==(const Setting&) const = default;
};

/// From `PATH=VALUE`. @throws InputError without '=' or path.
[[nodiscard]] Setting parse_setting(std::string_view text);

/// The equivalent option, for messages: "--set time.step=1e-4".
[[nodiscard]] std::string to_string(const Setting& setting);

/// Parts of a path, without quotes. @throws InputError if one is empty, a quote
/// is not closed, or there are more than kMostKeyParts.
[[nodiscard]] std::vector<std::string> split_path(const std::string& path);

/// A part as it stands in a path: in quotes if it has dots.
[[nodiscard]] std::string quote_part(const std::string& part);

/// A part as an index; none if it is not a whole number.
[[nodiscard]] std::optional<std::size_t> to_index(const std::string& part);

}  // namespace limber::scene

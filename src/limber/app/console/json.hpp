// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "limber/common/types.hpp"

namespace limber::app {

/// Objects keep the order in which keys were added; values that are not finite
/// are written as null.
using Json = nlohmann::ordered_json;

/// A column as a list of numbers, any other matrix as a list of its rows.
[[nodiscard]] Json to_json(const MatrixX& values);

/// The number, or null where there is none.
[[nodiscard]] Json or_null(const std::optional<double>& value);

/// Indented, for files and --json. In texts with bytes that are
/// not UTF-8, such as names of files, those are escaped ("\xff").
[[nodiscard]] std::string to_text(const Json& json);

/// An object as readable text: "key: value" lines, members indented.
[[nodiscard]] std::string outline(const Json& object);

}  // namespace limber::app

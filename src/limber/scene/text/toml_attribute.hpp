// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <toml++/toml.h>

#include <string>

namespace limber::scene {

/// A TOML value as the text of an XML attribute: strings without quotes,
/// numbers of an array with blanks between them.
/// @throws InputError for any other value
[[nodiscard]] std::string to_attribute(const toml::node& node);

}  // namespace limber::scene

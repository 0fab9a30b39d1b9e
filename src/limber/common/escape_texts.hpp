// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "limber/common/echo.hpp"
#include "limber/common/utf8.hpp"

namespace limber {

/// Text that JSON can have: itself, or with bytes that are not UTF-8, such as
/// those of names of files, and its controls escaped ("\xff").
inline std::string escape_bytes(const std::string& text) {
  return is_utf8(text) ? text : escape_controls(text);
}

/// The same for all texts and keys of a document of nlohmann's JSON.
template <typename Json>
Json escape_texts(const Json& json) {
  if (json.is_string()) {
    return escape_bytes(json.template get_ref<const std::string&>());
  }
  if (!json.is_structured()) return json;
  Json escaped = json.is_array() ? Json::array() : Json::object();
  if (json.is_array()) {
    for (const Json& item : json) escaped.push_back(escape_texts(item));
    return escaped;
  }
  for (const auto& [key, value] : json.items()) {
    escaped[escape_bytes(key)] = escape_texts(value);
  }
  return escaped;
}

}  // namespace limber

// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/text/toml_attribute.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdint>
#include <vector>

#include "limber/common/errors.hpp"

namespace limber::scene {

std::string to_attribute(const toml::node& node) {
  if (const auto text = node.value_exact<std::string>()) return *text;
  if (const auto number = node.value_exact<std::int64_t>()) {
    return fmt::format("{}", *number);
  }
  if (const auto number = node.value_exact<double>()) {
    return fmt::format("{}", *number);
  }
  if (const auto flag = node.value_exact<bool>()) {
    return *flag ? "true" : "false";
  }
  const toml::array* array = node.as_array();
  if (array == nullptr) {
    throw InputError("has a value that is not a number, text, true or false");
  }
  std::vector<std::string> entries;
  for (const toml::node& entry : *array) {
    if (entry.is_array()) {
      throw InputError("has an array in an array as its value");
    }
    entries.push_back(to_attribute(entry));
  }
  return fmt::format("{}", fmt::join(entries, " "));
}

}  // namespace limber::scene

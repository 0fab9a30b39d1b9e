// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/text/toml_table.hpp"

#include <fmt/format.h>

#include <cmath>
#include <sstream>

#include "limber/common/echo.hpp"

namespace limber::scene {
namespace {

std::string type_name(const toml::node& node) {
  std::ostringstream text;
  text << node.type();
  return text.str();
}

// A node that a setting made has the setting as its source, and no line.
int line_of(const toml::node& node) {
  return node.source().path ? 0 : static_cast<int>(node.source().begin.line);
}

std::string origin_of(const toml::node& node) {
  const auto& setting = node.source().path;
  return setting ? fmt::format(" ({})", *setting) : "";
}

}  // namespace

int TomlTable::line() const { return line_of(table_); }

bool TomlTable::has(const std::string& key) const {
  return table_.contains(key);
}

bool TomlTable::is_array(const std::string& key) const {
  const toml::node* node = table_.get(key);
  return node != nullptr && node->is_array();
}

bool TomlTable::is_text(const std::string& key) const {
  const toml::node* node = table_.get(key);
  return node != nullptr && node->is_string();
}

bool TomlTable::is_table(const std::string& key) const {
  const toml::node* node = table_.get(key);
  return node != nullptr && node->is_table();
}

void TomlTable::fail(const std::string& text) const {
  const std::string what = text + origin_of(table_);
  problems_.add(line(), path_.empty() ? what : "[" + path_ + "] " + what);
}

void TomlTable::fail(const std::string& key, const std::string& text) const {
  const toml::node* node = table_.get(key);
  const std::string where = path_.empty() ? echo(key) : path_ + "." + echo(key);
  const toml::node& at = node == nullptr ? table_ : *node;
  problems_.add(line_of(at), where + ": " + text + origin_of(at));
}

void TomlTable::fail_type(const std::string& key, const toml::node& node,
                          const std::string& expected) const {
  fail(key, fmt::format("expected {}, got {}", expected, type_name(node)));
}

const toml::node* TomlTable::find(const std::string& key) {
  known_.insert(key);
  return table_.get(key);
}

std::optional<std::string> TomlTable::text(const std::string& key) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  if (!node->is_string()) {
    fail_type(key, *node, "a string");
    return std::nullopt;
  }
  return text_of(key, *node, key == "name");
}

std::optional<std::string> TomlTable::text_of(const std::string& key,
                                              const toml::node& node,
                                              bool is_name) const {
  std::string value = *node.value<std::string>();
  if (has_control(value)) {
    fail(key,
         fmt::format(
             "'{}' has a control character, which is not allowed in a name",
             echo(value)));
  } else if (is_name && value.size() > kMostNameBytes) {
    fail(key, fmt::format("'{}' is too long; a name has {} bytes at most",
                          echo(value), kMostNameBytes));
  } else {
    return value;
  }
  return std::nullopt;
}

std::optional<std::vector<std::string>> TomlTable::texts(
    const std::string& key) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  if (!node->is_array()) {
    fail_type(key, *node, "an array of names");
    return std::nullopt;
  }
  std::vector<std::string> values;
  for (const toml::node& item : *node->as_array()) {
    if (!item.is_string()) {
      fail_type(key, item, "names");
      return std::nullopt;
    }
    const std::optional<std::string> value = text_of(key, item, true);
    if (!value) return std::nullopt;
    values.push_back(*value);
  }
  return values;
}

std::string TomlTable::required_text(const std::string& key) {
  if (!has(key)) fail(fmt::format("needs '{}'", key));
  return text(key).value_or("");
}

std::optional<double> TomlTable::number_of(const std::string& key,
                                           const toml::node& node,
                                           const Range& range) {
  if (!node.is_number()) {
    fail_type(key, node, range.text());
    return std::nullopt;
  }
  const double value = *node.value<double>();
  if (!std::isfinite(value) || !range.contains(value)) {
    fail(key, fmt::format("is {}; expected {}", value, range.text()));
    return std::nullopt;
  }
  return value;
}

std::optional<double> TomlTable::number(const std::string& key,
                                        const Range& range) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  return number_of(key, *node, range);
}

double TomlTable::required_number(const std::string& key, const Range& range) {
  if (!has(key)) fail(fmt::format("needs '{}', {}", key, range.text()));
  return number(key, range).value_or(1.0);
}

std::optional<int> TomlTable::integer(const std::string& key, int lower,
                                      int upper) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  if (!node->is_integer()) {
    fail_type(key, *node, "a whole number");
    return std::nullopt;
  }
  const auto value = *node->value<std::int64_t>();
  if (value >= lower && value <= upper) return static_cast<int>(value);
  fail(key, fmt::format("is {}; expected a whole number in [{}, {}]", value,
                        lower, upper));
  return std::nullopt;
}

std::optional<bool> TomlTable::boolean(const std::string& key) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  if (node->is_boolean()) return node->value<bool>();
  fail_type(key, *node, "true or false");
  return std::nullopt;
}

std::optional<std::vector<double>> TomlTable::numbers(const std::string& key,
                                                      const Range& range) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  if (!node->is_array()) {
    fail_type(key, *node, "an array of numbers");
    return std::nullopt;
  }
  std::vector<double> values;
  for (const toml::node& item : *node->as_array()) {
    const std::optional<double> value = number_of(key, item, range);
    if (!value) return std::nullopt;
    values.push_back(*value);
  }
  return values;
}

std::vector<double> TomlTable::number_or_numbers(const std::string& key) {
  const toml::node* node = find(key);
  if (node == nullptr) return {};
  if (node->is_array()) {
    return numbers(key).value_or(std::vector<double>{});
  }
  const std::optional<double> value = number(key);
  return value ? std::vector<double>{*value} : std::vector<double>{};
}

std::optional<Vector3> TomlTable::vector(const std::string& key) {
  const std::optional<std::vector<double>> values = numbers(key);
  if (!values) return std::nullopt;
  if (values->size() == 3) {
    return Vector3((*values)[0], (*values)[1], (*values)[2]);
  }
  fail(key, fmt::format("expected three numbers, got {}", values->size()));
  return std::nullopt;
}

const toml::table* TomlTable::table(const std::string& key) {
  const toml::node* node = find(key);
  if (node == nullptr) return nullptr;
  if (!node->is_table()) fail_type(key, *node, "a table");
  return node->as_table();
}

std::vector<const toml::table*> TomlTable::tables(const std::string& key) {
  const toml::node* node = find(key);
  if (node == nullptr) return {};
  const std::string expected = fmt::format("[[{}]] tables", key);
  if (!node->is_array()) {
    fail_type(key, *node, expected);
    return {};
  }
  std::vector<const toml::table*> result;
  for (const toml::node& item : *node->as_array()) {
    if (item.is_table()) {
      result.push_back(item.as_table());
    } else {
      fail_type(key, item, expected);
    }
  }
  return result;
}

void TomlTable::finish() const {
  const std::vector<std::string> known(known_.begin(), known_.end());
  for (const auto& [key, node] : table_) {
    const std::string name(key.str());
    if (known_.count(name) != 0) continue;
    problems_.add(line_of(node), (path_.empty() ? "" : "[" + path_ + "] ") +
                                     describe_unknown("key", name, known) +
                                     origin_of(node));
  }
}

}  // namespace limber::scene

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <toml++/toml.h>

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/common/names.hpp"
#include "limber/common/types.hpp"
#include "limber/scene/text/problems.hpp"
#include "limber/scene/text/range.hpp"

namespace limber::scene {

/// One TOML table whose every key must be known. Wrong types, values out of
/// range and unknown keys are added to `problems`; reading continues.
class TomlTable {
 public:
  /// @param path name of the table in errors, e.g. "time" or "load[2]".
  TomlTable(const toml::table& table, std::string path, Problems& problems)
      : table_(table), path_(std::move(path)), problems_(problems) {}

  void fail(const std::string& text) const;
  void fail(const std::string& key, const std::string& text) const;
  [[nodiscard]] Problems& problems() const { return problems_; }
  [[nodiscard]] int line() const;
  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] bool has(const std::string& key) const;
  [[nodiscard]] bool is_array(const std::string& key) const;
  [[nodiscard]] bool is_table(const std::string& key) const;
  [[nodiscard]] bool is_text(const std::string& key) const;

  /// Readers of one key; each marks the key as known.
  [[nodiscard]] std::optional<std::string> text(const std::string& key);
  [[nodiscard]] std::string required_text(const std::string& key);
  [[nodiscard]] std::optional<double> number(const std::string& key,
                                             const Range& range = {});
  [[nodiscard]] double required_number(const std::string& key,
                                       const Range& range = {});
  [[nodiscard]] std::optional<int> integer(const std::string& key, int lower,
                                           int upper);
  [[nodiscard]] std::optional<bool> boolean(const std::string& key);
  [[nodiscard]] std::optional<std::vector<double>> numbers(
      const std::string& key, const Range& range = {});
  /// A number or an array of numbers.
  [[nodiscard]] std::vector<double> number_or_numbers(const std::string& key);
  [[nodiscard]] std::optional<Vector3> vector(const std::string& key);
  /// An array of names.
  [[nodiscard]] std::optional<std::vector<std::string>> texts(
      const std::string& key);
  [[nodiscard]] const toml::table* table(const std::string& key);
  [[nodiscard]] std::vector<const toml::table*> tables(const std::string& key);

  /// Marks a key as known.
  void skip(const std::string& key) { known_.insert(key); }

  /// Call after reading: unknown keys are problems.
  void finish() const;

 private:
  const toml::node* find(const std::string& key);
  std::optional<std::string> text_of(const std::string& key,
                                     const toml::node& node,
                                     bool is_name) const;
  std::optional<double> number_of(const std::string& key,
                                  const toml::node& node, const Range& range);
  void fail_type(const std::string& key, const toml::node& node,
                 const std::string& expected) const;

  const toml::table& table_;
  std::string path_;
  Problems& problems_;
  std::set<std::string> known_;
};

/// A keyed choice: text -> value, unknown names are problems.
template <typename Value>
Value read_choice(TomlTable& table, const std::string& key,
                  const std::vector<std::pair<std::string, Value>>& choices,
                  const Value& otherwise) {
  const std::optional<std::string> name = table.text(key);
  if (!name) return otherwise;
  std::vector<std::string> known;
  for (const auto& [text, value] : choices) {
    if (text == *name) return value;
    known.push_back(text);
  }
  table.fail(key, describe_unknown(key, *name, known));
  return otherwise;
}

/// The value of `key` parsed by `parse`, or `otherwise` if there is none.
template <typename Value>
Value read_name(TomlTable& table, const std::string& key, Value otherwise,
                Value (*parse)(std::string_view)) {
  const auto name = table.text(key);
  if (!name) return otherwise;
  try {
    return parse(*name);
  } catch (const InputError& error) {
    table.fail(key, error.problems().front());
  }
  return otherwise;
}

}  // namespace limber::scene

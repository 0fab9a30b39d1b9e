// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/text/toml_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <sstream>
#include <utility>

#include "limber/common/echo.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/names.hpp"
#include "limber/scene/text/key_depth.hpp"

namespace limber::scene {
namespace {

std::string describe_type(const toml::node& node) {
  std::ostringstream text;
  text << node.type();
  return text.str();
}

std::string join(const std::vector<std::string>& parts, std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) {
    text += (i == 0 ? "" : ".") + parts[i];
  }
  return text;
}

bool has_tables(const toml::node& node) {
  if (node.is_table()) return true;
  const toml::array* array = node.as_array();
  if (array == nullptr) return false;
  for (const toml::node& entry : *array) {
    if (entry.is_table()) return true;
  }
  return false;
}

std::vector<std::string> list_names(const toml::array& array) {
  std::vector<std::string> names;
  for (const toml::node& entry : array) {
    const toml::table* table = entry.as_table();
    if (table == nullptr) continue;
    const auto name = (*table)["name"].value<std::string>();
    if (name) names.push_back(*name);
  }
  return names;
}

std::optional<std::size_t> find_named(const toml::array& array,
                                      const std::string& name) {
  for (std::size_t i = 0; i < array.size(); ++i) {
    const toml::table* table = array.get(i)->as_table();
    if (table == nullptr) continue;
    if ((*table)["name"].value<std::string>() == name) return i;
  }
  return std::nullopt;
}

void put(toml::table& table, const std::string& key, toml::node& value) {
  value.visit(
      [&](auto& node) { table.insert_or_assign(key, std::move(node)); });
}

void put(toml::array& array, std::size_t index, toml::node& value) {
  const auto at = array.cbegin() + static_cast<std::ptrdiff_t>(index);
  value.visit([&](auto& node) { array.replace(at, std::move(node)); });
}

/// Applies one setting.
class Setter {
 public:
  Setter(const Setting& setting, toml::table& root)
      : setting_(setting), parts_(split_path(setting.path)), node_(&root) {}

  /// @returns the path with indices for names, its parts joined by line breaks,
  /// so that equal places are equal texts
  std::string run() {
    for (std::size_t i = 0; i + 1 < parts_.size(); ++i) {
      if (!enter(i)) break;
    }
    finish();
    return place_;
  }

 private:
  [[noreturn]] static void refuse(const std::string& why) {
    throw InputError(why);
  }

  void note(const std::string& part) { place_ += part + "\n"; }

  /// Descends from the node before part i into it; false if it does not exist,
  /// and then the rest of the path is made as well.
  bool enter(std::size_t i) {
    if (toml::table* table = node_->as_table()) {
      toml::node* next = table->get(parts_[i]);
      if (next == nullptr) {
        made_from_ = i;
        return false;
      }
      note(parts_[i]);
      node_ = next;
    } else {
      toml::array& array = get_array(i);
      const std::size_t index = find_entry(array, i);
      note(std::to_string(index));
      node_ = array.get(index);
    }
    return true;
  }

  toml::array& get_array(std::size_t i) {
    toml::array* array = node_->as_array();
    if (array == nullptr) {
      refuse(fmt::format("{} is {}, which has no '{}'", echo(join(parts_, i)),
                         describe_type(*node_), echo(parts_[i])));
    }
    return *array;
  }

  std::size_t find_entry(const toml::array& array, std::size_t i) {
    const std::string& part = parts_[i];
    if (const auto named = find_named(array, part)) return *named;
    const auto index = to_index(part);
    if (index && *index < array.size()) return *index;
    const std::string place = echo(join(parts_, i));
    if (index || list_names(array).empty()) {
      refuse(fmt::format("{} has no entry '{}': it has {}, from 0", place,
                         echo(part), array.size()));
    }
    refuse(describe_unknown(place, part, list_names(array)));
  }

  void finish() {
    if (made_from_) {
      for (std::size_t i = *made_from_; i < parts_.size(); ++i) note(parts_[i]);
      make_rest();
      return;
    }
    const std::string& last = parts_.back();
    if (toml::table* table = node_->as_table()) {
      note(last);
      if (const toml::node* old = table->get(last)) check(*old);
      setting_.value ? put(*table, last, *parse().get("value"))
                     : remove(*table, last);
      return;
    }
    toml::array& array = get_array(parts_.size() - 1);
    const std::size_t index = find_entry(array, parts_.size() - 1);
    note(std::to_string(index));
    check(*array.get(index));
    if (!setting_.value) refuse("is an entry of an array; set the whole array");
    put(array, index, *parse().get("value"));
  }

  void check(const toml::node& old) const {
    if (!setting_.value || !has_tables(old)) return;
    refuse(fmt::format("is {}; set the keys in it",
                       old.is_table() ? "a table" : "an array of tables"));
  }

  static void remove(toml::table& table, const std::string& key) {
    if (table.erase(key) > 0) return;
    std::vector<std::string> known;
    for (const auto& [name, node] : table) known.emplace_back(name.str());
    refuse("removes a key that does not exist: " +
           describe_unknown("key", key, known));
  }

  /// Tables around the value, which no file has.
  void make_rest() {
    if (!setting_.value) {
      remove(*node_->as_table(), parts_[*made_from_]);
      return;
    }
    toml::table* table = node_->as_table();
    for (std::size_t i = *made_from_; i + 1 < parts_.size(); ++i) {
      toml::table made = toml::parse("value = {}", to_string(setting_));
      put(*table, parts_[i], *made.get("value"));
      table = table->get_as<toml::table>(parts_[i]);
    }
    put(*table, parts_.back(), *parse().get("value"));
  }

  [[nodiscard]] toml::table parse() const {
    return parse_value(*setting_.value, to_string(setting_));
  }

  const Setting& setting_;
  std::vector<std::string> parts_;
  toml::node* node_;  // within which the next part is
  std::optional<std::size_t> made_from_;
  std::string place_;
};

void add_problems(const Setting& setting, const InputError& error,
                  std::vector<std::string>& problems) {
  for (const std::string& text : error.problems()) {
    problems.push_back(to_string(setting) + ": " + text);
  }
}

/// Takes the name of one of several robots out of a path.
std::string take_robot(const toml::array& robots,
                       std::vector<std::string>& parts) {
  std::string name = parts[1];
  if (!find_named(robots, name)) {
    throw InputError(describe_unknown("robot", name, list_names(robots)));
  }
  parts.erase(parts.begin() + 1);
  return name;
}

/// A place that another setting has set already, or a table around it.
const Setting* find_conflict(const std::map<std::string, const Setting*>& done,
                             const std::string& place) {
  for (const auto& [other, setting] : done) {
    if (place.starts_with(other) || other.starts_with(place)) return setting;
  }
  return nullptr;
}

}  // namespace

toml::table parse_value(const std::string& value, const std::string& source) {
  const auto as_string = [&] {
    toml::table table = toml::parse("value = ''", source);
    *table.get_as<std::string>("value") = value;
    return table;
  };
  // A '#' would begin a comment, and be lost.
  if (value.find('\n') != std::string::npos || find_overlong_key(value)) {
    return as_string();
  }
  try {
    toml::table table = toml::parse("value = " + value, source);
    const toml::node* node = table.get("value");
    const bool is_plain = !node->is_string() && !node->is_array();
    if (is_plain && value.find('#') != std::string::npos) return as_string();
    return table;
  } catch (const toml::parse_error&) {
    return as_string();
  }
}

namespace {

/// Whether a path names a key of [robot].
bool is_base(const std::vector<std::string>& parts) {
  return parts.size() == 2 && parts[0] == "robot" &&
         (parts[1] == "base" || parts[1] == "file" || parts[1] == "joint");
}

/// Makes `robot = "FILE"` a table for a setting of its base.
void open_robot(const std::vector<Setting>& settings, toml::table& root) {
  const auto file = root["robot"].value_exact<std::string>();
  const bool is_set = std::any_of(
      settings.begin(), settings.end(),
      [](const Setting& one) { return is_base(split_path(one.path)); });
  if (!file || !is_set) return;
  root.insert_or_assign("robot", toml::table{{"file", *file}});
}

}  // namespace

SortedSettings sort_settings(const std::vector<Setting>& settings,
                             const toml::table& scenario) {
  const toml::array* robots = scenario.get_as<toml::array>("robot");
  SortedSettings sorted;
  std::vector<std::string> problems;
  for (const Setting& setting : settings) {
    try {
      std::vector<std::string> parts = split_path(setting.path);
      const bool is_robots = parts.front() == "robot" && !is_base(parts) &&
                             parts.size() > (robots != nullptr ? 4 : 1);
      if (!is_robots) {
        sorted.scenario.push_back(setting);
        continue;
      }
      std::string robot;
      if (robots != nullptr) robot = take_robot(*robots, parts);
      sorted.robots.push_back({setting, std::move(robot), std::move(parts)});
    } catch (const InputError& error) {
      add_problems(setting, error, problems);
    }
  }
  if (!problems.empty()) throw InputError(problems);
  return sorted;
}

void apply_settings(const std::vector<Setting>& settings, toml::table& root) {
  open_robot(settings, root);
  std::vector<std::string> problems;
  std::map<std::string, const Setting*> done;
  for (const Setting& setting : settings) {
    try {
      const std::string place = Setter(setting, root).run();
      if (const Setting* other = find_conflict(done, place)) {
        throw InputError("sets what " + to_string(*other) + " sets, too");
      }
      done.emplace(place, &setting);
    } catch (const InputError& error) {
      add_problems(setting, error, problems);
    }
  }
  if (!problems.empty()) throw InputError(problems);
}

}  // namespace limber::scene

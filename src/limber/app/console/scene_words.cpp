// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/console/scene_words.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <exception>
#include <optional>

#include "limber/scene/robot/robot_reader.hpp"
#include "limber/scene/scenario/scenario_reader.hpp"
#include "limber/scene/text/setting.hpp"
#include "limber/scene/text/toml_file.hpp"

namespace limber::app {
namespace {

using Words = std::vector<std::string>;

std::string find_entry_name(const toml::node& entry, std::size_t index) {
  const toml::table* table = entry.as_table();
  if (table != nullptr) {
    if (const auto name = (*table)["name"].value<std::string>()) {
      return scene::quote_part(*name);
    }
  }
  return std::to_string(index);
}

void add_keys(const toml::node& node, const std::string& path, Words& keys) {
  if (const toml::table* table = node.as_table()) {
    for (const auto& [key, child] : *table) {
      const std::string part = scene::quote_part(std::string(key.str()));
      add_keys(child, path.empty() ? part : path + "." + part, keys);
    }
    return;
  }
  const toml::array* array = node.as_array();
  const bool has_tables =
      array != nullptr && !array->empty() && array->get(0)->is_table();
  if (!has_tables) {
    keys.push_back(path);
    return;
  }
  for (std::size_t i = 0; i < array->size(); ++i) {
    const toml::node& entry = *array->get(i);
    add_keys(entry, path + "." + find_entry_name(entry, i), keys);
  }
}

/// What `list` makes; nothing if it fails, as completion has no errors.
template <typename List>
Words try_to(const List& list) {
  try {
    return list();
  } catch (const std::exception&) {
    return {};
  }
}

Words list_elements(const std::filesystem::path& file) {
  const scene::Scenario scenario = scene::read_scenario(file);
  if (scenario.robot.empty()) return {};
  const scene::Robot robot = scene::read_robot(scenario.robot);
  Words paths;
  const auto add = [&](const char* kind, const std::string& name) {
    paths.push_back(fmt::format("robot.{}.{}.", kind, scene::quote_part(name)));
  };
  for (const scene::Link& link : robot.links) {
    add("link", link.name);
    if (link.flexible) add("flexible", link.name);
  }
  for (const scene::Joint& joint : robot.joints) add("joint", joint.name);
  return paths;
}

template <typename Named>
void add_names(const std::vector<Named>& all, Words& names) {
  for (const Named& one : all) names.push_back(one.name);
}

}  // namespace

Words list_keys(const std::filesystem::path& scenario) {
  Words keys = try_to([&] {
    Words found;
    add_keys(scene::parse_toml_file(scenario), "", found);
    return found;
  });
  const Words elements = try_to([&] { return list_elements(scenario); });
  keys.insert(keys.end(), elements.begin(), elements.end());
  return keys;
}

Words list_probes(const std::filesystem::path& scenario) {
  return try_to([&] {
    Words names;
    add_names(scene::read_scenario(scenario).probes, names);
    return names;
  });
}

Words list_inputs(const std::filesystem::path& scenario) {
  return try_to([&] {
    const scene::Scenario read = scene::read_scenario(scenario);
    Words names;
    add_names(read.loads, names);
    add_names(read.drives, names);
    add_names(read.controllers, names);
    return names;
  });
}

}  // namespace limber::app

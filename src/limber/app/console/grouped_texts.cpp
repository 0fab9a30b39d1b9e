// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/console/grouped_texts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace limber::app {
namespace {

/// "KIND 'NAME': REST"; `name` is empty where a text does not begin so.
struct Parts {
  std::string kind;
  std::string name;
  std::string rest;
};

Parts split(const std::string& text) {
  const std::size_t open = text.find(" '");
  const std::size_t close = text.find("': ");
  const bool has_name = open != std::string::npos &&
                        close != std::string::npos && open + 2 < close &&
                        text.find_first_of(" '") == open;
  if (!has_name) return {"", "", text};
  return {text.substr(0, open), text.substr(open + 2, close - open - 2),
          text.substr(close + 3)};
}

struct Group {
  Parts first;
  std::vector<std::string> names;
  std::size_t times = 0;
};

std::string to_text(const Group& group) {
  constexpr std::size_t kMost = 4;
  std::string text = group.first.rest;
  if (group.names.size() > 1) {
    std::string names;
    for (std::size_t i = 0; i < std::min(kMost, group.names.size()); ++i) {
      names += fmt::format("{}'{}'", i == 0 ? "" : ", ", group.names[i]);
    }
    if (group.names.size() > kMost) {
      names += fmt::format(" and {} more", group.names.size() - kMost);
    }
    return fmt::format("{}s {}: {}", group.first.kind, names, text);
  }
  if (!group.first.name.empty()) {
    text = fmt::format("{} '{}': {}", group.first.kind, group.first.name, text);
  }
  return group.times > 1 ? fmt::format("{} ({} times)", text, group.times)
                         : text;
}

}  // namespace

std::vector<std::string> group_texts(const std::vector<std::string>& texts) {
  std::vector<Group> groups;
  for (const std::string& text : texts) {
    const Parts parts = split(text);
    const auto same =
        std::find_if(groups.begin(), groups.end(), [&](const Group& group) {
          return group.first.kind == parts.kind &&
                 group.first.rest == parts.rest &&
                 group.first.name.empty() == parts.name.empty();
        });
    Group& group =
        same == groups.end() ? groups.emplace_back(Group{parts, {}}) : *same;
    ++group.times;
    const bool is_known =
        std::count(group.names.begin(), group.names.end(), parts.name) > 0;
    if (!parts.name.empty() && !is_known) group.names.push_back(parts.name);
  }
  std::vector<std::string> grouped;
  for (const Group& group : groups) grouped.push_back(to_text(group));
  return grouped;
}

}  // namespace limber::app

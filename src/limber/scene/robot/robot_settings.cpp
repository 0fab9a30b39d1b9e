// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/robot/robot_settings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "limber/common/echo.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/names.hpp"
#include "limber/scene/text/toml_attribute.hpp"
#include "limber/scene/text/toml_settings.hpp"

namespace limber::scene {
namespace {

using Parts = std::vector<std::string>;

/// Elements under <robot>, and the attribute that distinguishes them.
constexpr std::array<std::pair<const char*, const char*>, 11> kKinds = {{
    {"link", "name"},
    {"joint", "name"},
    {"flexible", "link"},
    {"coupler", "joint"},
    {"loop", "name"},
    {"spring", "name"},
    {"bushing", "name"},
    {"latch", "name"},
    {"tendon", "name"},
    {"gear", "name"},
    {"contact", "link"},
}};

/// Attributes of the elements of URDF that are read: "" of the element itself.
using Known = std::map<std::string, Parts>;
const Known& names_of_joint() {
  static const Known names = {
      {"", {"type"}},
      {"origin", {"xyz", "rpy"}},
      {"parent", {"link"}},
      {"child", {"link"}},
      {"axis", {"xyz"}},
      {"limit", {"lower", "upper", "effort", "velocity"}},
      {"dynamics", {"damping", "friction"}},
      {"mimic", {"joint", "multiplier", "offset"}}};
  return names;
}
const Known& names_of_link() {
  static const Known names = {
      {"", {}},
      {"inertial.origin", {"xyz", "rpy"}},
      {"inertial.mass", {"value"}},
      {"inertial.inertia", {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"}},
      {"collision.origin", {"xyz", "rpy"}},
      {"collision.geometry.sphere", {"radius"}},
      {"collision.geometry.box", {"size"}},
      {"collision.geometry.cylinder", {"radius", "length"}},
      {"collision.geometry.capsule", {"radius", "length"}},
      {"collision.geometry.cone", {"radius", "length"}},
      {"collision.geometry.ellipsoid", {"radii"}}};
  return names;
}

[[noreturn]] void refuse(const std::string& why) { throw InputError(why); }

std::string attribute_of(const TiXmlElement& element, const char* name) {
  const char* value = element.Attribute(name);
  return value == nullptr ? "" : value;
}

std::vector<TiXmlElement*> list_children(TiXmlElement& element,
                                         const std::string& tag) {
  std::vector<TiXmlElement*> found;
  for (TiXmlElement* child = element.FirstChildElement(tag); child != nullptr;
       child = child->NextSiblingElement(tag)) {
    found.push_back(child);
  }
  return found;
}

TiXmlElement& add_child(TiXmlElement& element, const std::string& tag) {
  return *element.InsertEndChild(TiXmlElement(tag))->ToElement();
}

Parts list_names(const std::vector<TiXmlElement*>& elements,
                 const char* attribute) {
  Parts names;
  for (const TiXmlElement* one : elements) {
    names.push_back(attribute_of(*one, attribute));
  }
  return names;
}

/// Applies one setting.
class Setter {
 public:
  Setter(const RobotSetting& setting, TiXmlElement& robot)
      : setting_(setting.setting), parts_(setting.parts), robot_(robot) {}

  /// @returns the place, so that equal places are equal texts
  std::string run() {
    if (parts_.size() < 4) {
      refuse(
          fmt::format("does not name a value of an element; expected "
                      "robot.KIND.NAME.ATTRIBUTE with one of the kinds {}",
                      fmt::join(list_kinds(), ", ")));
    }
    TiXmlElement* element = &find_root(parts_[1], parts_[2]);
    std::size_t next = 3;
    while (!ends_at(next)) element = &enter(*element, next);
    return set(*element, next);
  }

 private:
  static Parts list_kinds() {
    Parts kinds;
    for (const auto& [kind, key] : kKinds) kinds.emplace_back(kind);
    return kinds;
  }

  /// The element under <robot>. A joint's own values may be its coupler's.
  TiXmlElement& find_root(const std::string& kind, const std::string& name) {
    const std::size_t index = find_name("kind of element", kind, list_kinds());
    const char* key = kKinds.at(index).second;
    const auto all = list_children(robot_, kind);
    for (TiXmlElement* one : all) {
      if (attribute_of(*one, key) == name) return find_owner(*one, kind, name);
    }
    if (kind == "coupler") return add_root(kind, key, "joint", name);
    if (kind == "contact") return add_root(kind, key, "link", name);
    refuse(describe_unknown(kind, name, list_names(all, key)));
  }

  TiXmlElement& add_root(const std::string& kind, const char* key,
                         const char* owner, const std::string& name) {
    const auto owners = list_names(list_children(robot_, owner), "name");
    (void)find_name(owner, name, owners);
    TiXmlElement& made = add_child(robot_, kind);
    made.SetAttribute(key, name);
    return made;
  }

  TiXmlElement& find_owner(TiXmlElement& element, const std::string& kind,
                           const std::string& name) {
    if (kind == "link") {
      check_urdf(names_of_link());
    } else if (kind == "joint") {
      const bool is_urdf =
          names_of_joint().contains(parts_[3]) || parts_[3] == "type";
      if (!is_urdf) return find_root("coupler", name);
      check_urdf(names_of_joint());
    }
    return element;
  }

  /// URDF's elements may contain data of other programs, so that a misspelt
  /// name would have no effect.
  void check_urdf(const Known& known) const {
    std::string path;
    Parts all;
    for (std::size_t i = 3; i < parts_.size(); ++i) {
      // The number of a collision of several.
      if (i == 4 && parts_[3] == "collision" && to_index(parts_[4])) continue;
      path += (path.empty() ? "" : ".") + parts_[i];
    }
    for (const auto& [element, attributes] : known) {
      for (const std::string& attribute : attributes) {
        all.push_back(element.empty() ? attribute : element + "." + attribute);
        if (path == all.back()) return;
        if (path.starts_with(all.back() + ".")) return;
      }
    }
    refuse(describe_unknown(
        fmt::format("path in {} '{}':", parts_[1], echo(parts_[2])), path,
        all));
  }

  /// Whether part i is an attribute, the last one except for an index.
  [[nodiscard]] bool ends_at(std::size_t i) const {
    if (i + 1 == parts_.size()) return true;
    return i + 2 == parts_.size() && to_index(parts_.back()).has_value();
  }

  TiXmlElement& enter(TiXmlElement& element, std::size_t& next) {
    const std::string& tag = parts_[next++];
    const auto children = list_children(element, tag);
    if (children.empty()) return add_child(element, tag);
    if (const auto chosen = choose(children, parts_[next])) {
      if (next + 1 == parts_.size()) refuse("ends at an element");
      ++next;
      return *children[*chosen];
    }
    if (children.size() == 1) return *children.front();
    Parts known;
    for (std::size_t i = 0; i < children.size(); ++i) {
      known.push_back(std::to_string(i));
      for (const char* key : kTelling) {
        const std::string name = attribute_of(*children[i], key);
        if (!name.empty()) known.push_back(name);
      }
    }
    refuse(fmt::format("there are {} <{}>: {}", children.size(), echo(tag),
                       describe_unknown("one", parts_[next], known)));
  }

  static std::optional<std::size_t> choose(
      const std::vector<TiXmlElement*>& children, const std::string& part) {
    for (std::size_t i = 0; i < children.size(); ++i) {
      for (const char* key : kTelling) {
        if (attribute_of(*children[i], key) == part) return i;
      }
    }
    const auto index = to_index(part);
    if (index && *index < children.size()) return index;
    return std::nullopt;
  }

  std::string set(TiXmlElement& element, std::size_t next) {
    const std::string& name = parts_[next];
    std::string place = fmt::format("{}\n{}\n", fmt::ptr(&element), name);
    if (!list_children(element, name).empty()) {
      refuse(fmt::format("<{}> is an element; set its attributes", echo(name)));
    }
    if (next == 3 && name == key_of(parts_[1])) {
      refuse("is the name by which others know the element");
    }
    if (!setting_.value) {
      remove(element, next);
    } else if (next + 1 < parts_.size()) {
      element.SetAttribute(name, replace_entry(element, next));
      return place + parts_.back() + "\n";
    } else {
      element.SetAttribute(name, find_value());
    }
    return place;
  }

  static std::string key_of(const std::string& kind) {
    for (const auto& [other, key] : kKinds) {
      if (kind == other) return key;
    }
    return "";
  }

  [[nodiscard]] std::string find_value() const {
    const toml::table table = parse_value(*setting_.value, to_string(setting_));
    return to_attribute(*table.get("value"));
  }

  void remove(TiXmlElement& element, std::size_t next) const {
    if (next + 1 < parts_.size()) {
      refuse("is one number of several; set all of them");
    }
    if (element.Attribute(parts_[next]) == nullptr) {
      refuse(fmt::format("removes a key that does not exist: <{}> has no '{}'",
                         echo(element.ValueStr()), echo(parts_[next])));
    }
    element.RemoveAttribute(parts_[next].c_str());
  }

  [[nodiscard]] std::string replace_entry(const TiXmlElement& element,
                                          std::size_t next) const {
    Parts entries;
    std::string entry;
    for (const char c : attribute_of(element, parts_[next].c_str()) + " ") {
      if (c != ' ' && c != '\t' && c != '\n' && c != '\r') {
        entry += c;
      } else if (!entry.empty()) {
        entries.push_back(std::exchange(entry, ""));
      }
    }
    const std::size_t index = *to_index(parts_.back());
    if (index >= entries.size()) {
      refuse(fmt::format("{} has no entry {}: it has {}, from 0",
                         echo(parts_[next]), index, entries.size()));
    }
    entries[index] = find_value();
    if (entries[index].find_first_of(" \t") != std::string::npos) {
      refuse("is one number, not several");
    }
    return fmt::format("{}", fmt::join(entries, " "));
  }

  static constexpr std::array<const char*, 3> kTelling = {"name", "joint",
                                                          "group"};
  const Setting& setting_;
  Parts parts_;
  TiXmlElement& robot_;
};

}  // namespace

void apply_settings(const std::vector<RobotSetting>& settings,
                    TiXmlElement& robot) {
  std::vector<std::string> problems;
  std::map<std::string, const Setting*> done;
  for (const RobotSetting& one : settings) {
    const Setting& setting = one.setting;
    try {
      const std::string place = Setter(one, robot).run();
      for (const auto& [other, by] : done) {
        if (!place.starts_with(other) && !other.starts_with(place)) continue;
        refuse("sets what " + to_string(*by) + " sets, too");
      }
      done.emplace(place, &setting);
    } catch (const InputError& error) {
      for (const std::string& text : error.problems()) {
        problems.push_back(to_string(setting) + ": " + text);
      }
    }
  }
  if (!problems.empty()) throw InputError(problems);
}

}  // namespace limber::scene

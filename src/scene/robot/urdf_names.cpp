// SPDX-License-Identifier: BSD-3-Clause
#include "scene/urdf_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "common/echo.hpp"
#include "common/names.hpp"

namespace limber::scene {
namespace {

/// What an element may hold.
struct Words {
  std::string tag;
  std::vector<std::string> attributes;
  std::vector<Words> children = {};  ///< that are checked likewise
  /// Children of other programs, or of another reader here.
  std::vector<std::string> others = {};
  bool may_repeat = false;
};

Words describe_link() {
  return {"link",
          {"name"},
          {{"inertial",
            {},
            {{"origin", {"xyz", "rpy"}},
             {"mass", {"value"}},
             {"inertia", {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"}}}}},
          {"visual", "collision", "sensor", "gazebo", "contact", "material"},
          true};
}

Words describe_joint() {
  return {"joint",
          {"name", "type"},
          {{"origin", {"xyz", "rpy"}},
           {"parent", {"link"}},
           {"child", {"link"}},
           {"axis", {"xyz"}},
           {"limit", {"lower", "upper", "effort", "velocity"}},
           {"dynamics", {"damping", "friction"}},
           {"mimic", {"joint", "multiplier", "offset"}}},
          {"safety_controller", "calibration", "sensor", "gazebo"},
          true};
}

const std::vector<std::string>& own_elements() {
  static const std::vector<std::string> names = {"flexible", "coupler", "loop",
                                                 "spring",   "bushing", "latch",
                                                 "tendon",   "gear"};
  return names;
}

const Words& describe_robot() {
  static const Words robot = [] {
    Words words = {"robot",
                   {"name", "version"},
                   {describe_link(), describe_joint()},
                   own_elements()};
    for (const char* foreign : {"material", "transmission", "gazebo", "sensor",
                                "ros2_control", "mujoco"}) {
      words.others.emplace_back(foreign);
    }
    return words;
  }();
  return robot;
}

bool is_in(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

class WordCheck {
 public:
  WordCheck(const std::string& file, Problems& problems,
            std::vector<std::string>& warnings)
      : file_(file), problems_(problems), warnings_(warnings) {}

  void check(const TiXmlElement& element, const Words& words) {
    for (const TiXmlAttribute* a = element.FirstAttribute(); a != nullptr;
         a = a->Next()) {
      const std::string name = a->Name();
      if (is_in(words.attributes, name) || is_foreign(name)) continue;
      judge(element, element, "attribute", name, words.attributes);
    }
    std::set<std::string> given;
    for (const TiXmlElement* child = element.FirstChildElement();
         child != nullptr; child = child->NextSiblingElement()) {
      check_child(element, *child, words, given);
    }
  }

 private:
  static bool is_foreign(const std::string& name) {
    return name.find(':') != std::string::npos || name == "xmlns";
  }

  void check_child(const TiXmlElement& element, const TiXmlElement& child,
                   const Words& words, std::set<std::string>& given) {
    const std::string tag = child.ValueStr();
    if (tag.starts_with("xacro:")) {
      problems_.add(child.Row(),
                    fmt::format("<{}> is a macro; expand the file first (xacro "
                                "FILE > robot.urdf)",
                                echo(tag)));
      return;
    }
    if (is_foreign(tag) || is_in(words.others, tag)) return;
    const auto known =
        std::find_if(words.children.begin(), words.children.end(),
                     [&](const Words& one) { return one.tag == tag; });
    if (known == words.children.end()) {
      judge(element, child, "element", tag, list_tags(words));
      return;
    }
    if (!given.insert(tag).second && !known->may_repeat) {
      problems_.add(child.Row(), fmt::format("{}: <{}> is given twice",
                                             describe(element), tag));
    }
    check(child, *known);
  }

  /// Those that are read.
  static std::vector<std::string> list_tags(const Words& words) {
    std::vector<std::string> tags;
    for (const Words& child : words.children) tags.push_back(child.tag);
    if (words.tag == "robot") {
      tags.insert(tags.end(), own_elements().begin(), own_elements().end());
    }
    return tags;
  }

  static std::string describe(const TiXmlElement& element) {
    const char* name = element.Attribute("name");
    const std::string tag = echo(element.ValueStr());
    if (name == nullptr) return fmt::format("<{}>", tag);
    return fmt::format("<{} name=\"{}\">", tag, echo(name));
  }

  /// An unknown word: near to a known one it is a slip.
  void judge(const TiXmlElement& element, const TiXmlElement& at,
             const char* kind, const std::string& name,
             const std::vector<std::string>& known) {
    const bool is_slip =
        name.size() <= kMostNameBytes && !nearest_name(name, known).empty();
    if (is_slip) {
      problems_.add(at.Row(), fmt::format("{}: {}", describe(element),
                                          describe_unknown(kind, name, known)));
      return;
    }
    // Robots have many links that a program has written alike.
    if (!told_.insert(element.ValueStr() + kind + name).second) return;
    if (told_.size() > kMostTold) return;
    const std::string more = told_.size() == kMostTold ? ", nor others" : "";
    warnings_.push_back(fmt::format("{}:{}: {}: {} '{}' is not read{}", file_,
                                    at.Row(), describe(element), kind,
                                    echo(name), more));
  }

  static constexpr std::size_t kMostTold = 20;
  std::set<std::string> told_;
  const std::string& file_;
  Problems& problems_;
  std::vector<std::string>& warnings_;
};

}  // namespace

void check_urdf_words(const TiXmlElement& robot, const std::string& file,
                      Problems& problems, std::vector<std::string>& warnings) {
  WordCheck(file, problems, warnings).check(robot, describe_robot());
}

}  // namespace limber::scene

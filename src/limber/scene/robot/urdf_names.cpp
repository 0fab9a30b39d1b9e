// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/robot/urdf_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "limber/common/echo.hpp"
#include "limber/common/names.hpp"

namespace limber::scene {
namespace {

/// Allowed content of an element.
struct ElementNames {
  std::string tag;
  std::vector<std::string> attributes;
  std::vector<ElementNames> children = {};  ///< checked recursively
  /// Children of other programs, or of other readers of Limber.
  std::vector<std::string> others = {};
  bool may_repeat = false;
};

ElementNames describe_collision() {
  return {"collision",
          {"name"},
          {{"origin", {"xyz", "rpy"}},
           {"geometry",
            {},
            {{"sphere", {"radius"}},
             {"box", {"size"}},
             {"cylinder", {"radius", "length"}},
             {"capsule", {"radius", "length"}},
             {"cone", {"radius", "length"}},
             {"ellipsoid", {"radii"}},
             {"mesh", {"filename", "scale"}}}}},
          {"contact_coefficients", "gazebo", "material"},
          true};
}

ElementNames describe_link() {
  return {"link",
          {"name"},
          {{"inertial",
            {},
            {{"origin", {"xyz", "rpy"}},
             {"mass", {"value"}},
             {"inertia", {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"}}}},
           describe_collision()},
          {"visual", "sensor", "gazebo", "contact", "material"},
          true};
}

ElementNames describe_joint() {
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
  static const std::vector<std::string> names = {
      "flexible", "coupler", "loop", "spring", "bushing",
      "latch",    "tendon",  "gear", "contact"};
  return names;
}

const ElementNames& describe_robot() {
  static const ElementNames robot = [] {
    ElementNames names = {"robot",
                          {"name", "version"},
                          {describe_link(), describe_joint()},
                          own_elements()};
    for (const char* foreign : {"material", "transmission", "gazebo", "sensor",
                                "ros2_control", "mujoco"}) {
      names.others.emplace_back(foreign);
    }
    return names;
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

  void check(const TiXmlElement& element, const ElementNames& names) {
    for (const TiXmlAttribute* a = element.FirstAttribute(); a != nullptr;
         a = a->Next()) {
      const std::string name = a->Name();
      if (is_in(names.attributes, name) || is_foreign(name)) continue;
      judge(element, element, "attribute", name, names.attributes);
    }
    std::set<std::string> given;
    for (const TiXmlElement* child = element.FirstChildElement();
         child != nullptr; child = child->NextSiblingElement()) {
      check_child(element, *child, names, given);
    }
  }

 private:
  static bool is_foreign(const std::string& name) {
    return name.find(':') != std::string::npos || name == "xmlns";
  }

  /// Whether it is an element of the macro language, so that the file is not
  /// expanded. A call of a macro may be left in one that is.
  static bool is_language(const std::string& tag) {
    for (const char* word :
         {"macro", "property", "include", "arg", "if", "unless", "insert_block",
          "element", "attribute", "call"}) {
      if (tag == std::string("xacro:") + word) return true;
    }
    return false;
  }

  void check_child(const TiXmlElement& element, const TiXmlElement& child,
                   const ElementNames& names, std::set<std::string>& given) {
    const std::string& tag = child.ValueStr();
    if (is_language(tag)) {
      problems_.add(child.Row(),
                    fmt::format("<{}> is a macro; expand the file first (xacro "
                                "FILE > robot.urdf)",
                                echo(tag)));
      return;
    }
    if (tag.starts_with("xacro:")) {
      warn(child, tag, "call of a macro", describe(element));
      return;
    }
    if (is_foreign(tag) || is_in(names.others, tag)) return;
    const auto known =
        std::find_if(names.children.begin(), names.children.end(),
                     [&](const ElementNames& one) { return one.tag == tag; });
    if (known == names.children.end()) {
      judge(element, child, "element", tag, list_tags(names));
      return;
    }
    if (!given.insert(tag).second && !known->may_repeat) {
      problems_.add(child.Row(), fmt::format("{}: <{}> is given twice",
                                             describe(element), tag));
    }
    check(child, *known);
  }

  /// Those that are read.
  static std::vector<std::string> list_tags(const ElementNames& names) {
    std::vector<std::string> tags;
    for (const ElementNames& child : names.children) tags.push_back(child.tag);
    if (names.tag == "robot") {
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

  /// Whether a few letters, or their order, make the name a known one that the
  /// element lacks.
  /// Other programs have names that merely resemble ours.
  static bool is_slip(const TiXmlElement& element, const std::string& name,
                      const std::vector<std::string>& known) {
    if (name.size() > kMostNameBytes) return false;
    const std::size_t most = std::max<std::size_t>(1, (name.size() + 2) / 4);
    return std::any_of(known.begin(), known.end(), [&](const std::string& one) {
      if (element.Attribute(one.c_str()) != nullptr) return false;
      return find_edit_distance(name, one) <= most ||
             std::is_permutation(name.begin(), name.end(), one.begin(),
                                 one.end());
    });
  }

  /// An unknown name: an error if it is a misspelt one.
  void judge(const TiXmlElement& element, const TiXmlElement& at,
             const char* kind, const std::string& name,
             const std::vector<std::string>& known) {
    if (is_slip(element, name, known)) {
      problems_.add(at.Row(), fmt::format("{}: {}", describe(element),
                                          describe_unknown(kind, name, known)));
      return;
    }
    warn(at, name, kind, describe(element));
  }

  // Generated robots repeat the same name in many links.
  void warn(const TiXmlElement& at, const std::string& name, const char* kind,
            const std::string& owner) {
    const std::string tag = owner.substr(0, owner.find(' '));
    if (!reported_.insert(tag + kind + name).second) return;
    if (reported_.size() > kMostReported) return;
    const std::string more =
        reported_.size() == kMostReported ? ", nor others" : "";
    warnings_.push_back(fmt::format("{}:{}: {}: {} '{}' is not read{}", file_,
                                    at.Row(), owner, kind, echo(name), more));
  }

  static constexpr std::size_t kMostReported = 20;
  std::set<std::string> reported_;
  const std::string& file_;
  Problems& problems_;
  std::vector<std::string>& warnings_;
};

}  // namespace

void check_urdf_names(const TiXmlElement& robot, const std::string& file,
                      Problems& problems, std::vector<std::string>& warnings) {
  WordCheck(file, problems, warnings).check(robot, describe_robot());
}

}  // namespace limber::scene

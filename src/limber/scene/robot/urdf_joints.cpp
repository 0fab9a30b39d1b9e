// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/robot/urdf_joints.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "limber/common/names.hpp"
#include "limber/scene/text/xml_element.hpp"

namespace limber::scene {
namespace {

class JointChecks {
 public:
  JointChecks(const TiXmlElement& robot, Problems& problems)
      : problems_(problems) {
    for (const TiXmlElement* joint = robot.FirstChildElement("joint");
         joint != nullptr; joint = joint->NextSiblingElement("joint")) {
      joints_.push_back(joint);
      names_.push_back(text(*joint, "name"));
      index_.emplace(names_.back(), joints_.size() - 1);
    }
    for (const TiXmlElement* joint : joints_) {
      const TiXmlElement* mimic = joint->FirstChildElement("mimic");
      const auto found = mimic == nullptr || is_fixed(*joint)
                             ? index_.end()
                             : index_.find(text(*mimic, "joint"));
      mimicked_.push_back(found == index_.end() ? kNone : found->second);
    }
  }

  void run(std::vector<std::string>& warnings) {
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      if (is_fixed(*joints_[i])) continue;  // nothing of it is used
      check_axis(*joints_[i]);
      check_limit(*joints_[i]);
      check_dynamics(*joints_[i]);
      check_mimic(i);
    }
    if (unlimited_.empty()) return;
    warnings.push_back(problems_.locate(
        unlimited_.front(),
        fmt::format("{} <limit> without 'effort' or 'velocity': no limit of "
                    "drives there",
                    unlimited_.size())));
  }

 private:
  static constexpr auto kNone = static_cast<std::size_t>(-1);

  static std::string text(const TiXmlElement& element, const char* name) {
    const char* value = element.Attribute(name);
    return value == nullptr ? "" : value;
  }

  static bool has_one_coordinate(const TiXmlElement& joint) {
    const std::string type = text(joint, "type");
    return type == "revolute" || type == "continuous" || type == "prismatic";
  }

  static bool is_fixed(const TiXmlElement& joint) {
    return text(joint, "type") == "fixed";
  }

  void fail(const TiXmlElement& at, const TiXmlElement& joint,
            const std::string& what) {
    problems_.add(at.Row(),
                  fmt::format("joint '{}': {}", text(joint, "name"), what));
  }

  void check_axis(const TiXmlElement& joint) {
    const TiXmlElement* axis = joint.FirstChildElement("axis");
    const bool needs_axis =
        has_one_coordinate(joint) || text(joint, "type") == "planar";
    if (axis == nullptr || !needs_axis) return;
    const std::optional<Vector3> xyz =
        XmlElement(*axis, problems_).vector("xyz");
    if (xyz && xyz->isZero(0.0)) {
      fail(*axis, joint, "its axis has no length, so no direction");
    }
  }

  void check_limit(const TiXmlElement& joint) {
    const TiXmlElement* limit = joint.FirstChildElement("limit");
    if (limit == nullptr) return;
    for (const char* name : {"effort", "velocity"}) {
      if (limit->Attribute(name) != nullptr) continue;
      unlimited_.push_back(limit->Row());
      break;
    }
    if (!has_one_coordinate(joint)) return;
    XmlElement element(*limit, problems_);
    const double lower = element.number("lower").value_or(0.0);
    const double upper = element.number("upper").value_or(0.0);
    if (lower > upper) {
      fail(*limit, joint,
           fmt::format("its lower limit {:g} is above its upper limit {:g}",
                       lower, upper));
    }
  }

  void check_dynamics(const TiXmlElement& joint) {
    const TiXmlElement* dynamics = joint.FirstChildElement("dynamics");
    if (dynamics == nullptr) return;
    XmlElement element(*dynamics, problems_);
    (void)element.number("damping", kNonNegative);
    const double friction =
        element.number("friction", kNonNegative).value_or(0.0);
    if (friction > 0.0 && !has_one_coordinate(joint)) {
      fail(*dynamics, joint,
           fmt::format("friction acts along one coordinate, and a {} joint "
                       "does not have one; if it has several, give a "
                       "<friction coordinate=\"\"/> each in a <coupler>",
                       text(joint, "type")));
    }
  }

  void check_mimic(std::size_t index) {
    const TiXmlElement& joint = *joints_[index];
    const TiXmlElement* mimic = joint.FirstChildElement("mimic");
    if (mimic == nullptr) return;
    XmlElement element(*mimic, problems_);
    (void)element.number("multiplier");
    (void)element.number("offset");
    if (mimicked_[index] == kNone) {
      fail(*mimic, joint,
           "<mimic>: " +
               describe_unknown("joint", text(*mimic, "joint"), names_));
      return;
    }
    const TiXmlElement* other = joints_[mimicked_[index]];
    for (const TiXmlElement* end : {&joint, other}) {
      if (has_one_coordinate(*end) || is_fixed(*end)) continue;
      fail(*mimic, joint,
           fmt::format("<mimic> needs joints with one coordinate; joint '{}' "
                       "is {}",
                       text(*end, "name"), text(*end, "type")));
    }
    check_cycle(*mimic, index);
  }

  // A cycle of mimicking joints: reported once, at the first of them.
  void check_cycle(const TiXmlElement& mimic, std::size_t start) {
    std::size_t at = start;
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      at = mimicked_[at];
      if (at == kNone || at < start) return;
      if (at == start) break;
    }
    if (at != start) return;
    std::string path = names_[start];
    do {
      at = mimicked_[at];
      path += " -> " + names_[at];
    } while (at != start);
    fail(mimic, *joints_[start],
         fmt::format("<mimic> is circular ({}); leave one of them free", path));
  }

  Problems& problems_;
  std::vector<const TiXmlElement*> joints_;
  std::vector<std::string> names_;
  std::map<std::string, std::size_t> index_;
  std::vector<std::size_t> mimicked_;  ///< by each joint, or none
  std::vector<int> unlimited_;         ///< lines of incomplete <limit>s
};

}  // namespace

void check_urdf_joints(const TiXmlElement& robot, Problems& problems,
                       std::vector<std::string>& warnings) {
  JointChecks(robot, problems).run(warnings);
}

}  // namespace limber::scene

// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/robot/urdf_tree.hpp"

#include <fmt/format.h>

#include <map>
#include <string>
#include <vector>

#include "limber/common/names.hpp"

namespace limber::scene {
namespace {

const std::vector<std::string> kJointTypes = {
    "fixed", "revolute", "continuous", "prismatic", "planar", "floating"};

std::string attribute(const TiXmlElement* element, const char* name) {
  if (element == nullptr) return "";
  const char* value = element->Attribute(name);
  return value == nullptr ? "" : value;
}

/// More links than any robot has, and few enough that urdfdom, which destroys a
/// chain recursively, does not overflow the stack.
constexpr std::size_t kMostLinks = 10000;

/// Links and joints by name, collected while the file is checked.
class TreeCheck {
 public:
  explicit TreeCheck(Problems& problems) : problems_(problems) {}

  void run(const TiXmlElement& robot) {
    add_links(robot);
    for (const TiXmlElement* joint = robot.FirstChildElement("joint");
         joint != nullptr; joint = joint->NextSiblingElement("joint")) {
      add_joint(*joint);
    }
    if (!problems_.empty()) return;
    check_roots(robot);
  }

 private:
  static constexpr auto kNone = static_cast<std::size_t>(-1);

  void add_links(const TiXmlElement& robot) {
    for (const TiXmlElement* link = robot.FirstChildElement("link");
         link != nullptr; link = link->NextSiblingElement("link")) {
      const std::string name = attribute(link, "name");
      if (name.empty()) {
        problems_.add(link->Row(), "<link> needs a 'name'");
      } else if (!index_of_link_.emplace(name, names_.size()).second) {
        problems_.add(link->Row(),
                      fmt::format("link '{}' is given twice", name));
      }
      names_.push_back(name);
    }
    parent_.assign(names_.size(), kNone);
    if (names_.empty()) problems_.add(robot.Row(), "the robot has no <link>");
    if (names_.size() > kMostLinks) {
      problems_.add(robot.Row(),
                    fmt::format("the robot has {} links; at most {} are read",
                                names_.size(), kMostLinks));
      problems_.raise();
    }
  }

  void add_joint(const TiXmlElement& joint) {
    const std::string name = attribute(&joint, "name");
    if (name.empty()) problems_.add(joint.Row(), "<joint> needs a 'name'");
    if (!line_of_joint_.emplace(name, joint.Row()).second) {
      problems_.add(joint.Row(),
                    fmt::format("joint '{}' is given twice", name));
    }
    check_parts(joint, name);
    const std::size_t parent = end_of(joint, name, "parent");
    const std::size_t child = end_of(joint, name, "child");
    if (parent == kNone || child == kNone) return;
    add_edge(joint, name, parent, child);
  }

  void check_parts(const TiXmlElement& joint, const std::string& name) {
    const std::string type = attribute(&joint, "type");
    bool known = false;
    for (const std::string& t : kJointTypes) known = known || t == type;
    if (!known) {
      problems_.add(joint.Row(),
                    fmt::format("joint '{}': {}", name,
                                describe_unknown("type", type, kJointTypes)));
    }
  }

  /// Index of the link at one end, or none if there is a problem with it.
  std::size_t end_of(const TiXmlElement& joint, const std::string& name,
                     const char* tag) {
    const std::string link = attribute(joint.FirstChildElement(tag), "link");
    const auto found = index_of_link_.find(link);
    if (found != index_of_link_.end()) return found->second;
    problems_.add(joint.Row(),
                  fmt::format("joint '{}', <{}>: {}", name, tag,
                              describe_unknown("link", link, names_)));
    return kNone;
  }

  void add_edge(const TiXmlElement& joint, const std::string& name,
                std::size_t parent, std::size_t child) {
    for (std::size_t at = parent; at != kNone; at = parent_[at]) {
      if (at != child) continue;
      problems_.add(
          joint.Row(),
          fmt::format("joint '{}' closes a loop (link '{}' is its own "
                      "ancestor); URDF describes trees: join the ends of the "
                      "loop by a <loop> instead",
                      name, names_[child]));
      return;
    }
    if (parent_[child] == kNone) {
      parent_[child] = parent;
      return;
    }
    problems_.add(
        joint.Row(),
        fmt::format("joint '{}': link '{}' has two parents ('{}' and '{}'), a "
                    "loop that URDF cannot have; join the second by a "
                    "<loop> instead",
                    name, names_[child], names_[parent_[child]],
                    names_[parent]));
  }

  void check_roots(const TiXmlElement& robot) {
    std::vector<std::string> roots;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      if (parent_[i] == kNone) roots.push_back(names_[i]);
    }
    if (roots.size() == 1) return;
    problems_.add(
        robot.Row(),
        fmt::format("links '{}' and '{}' have no parent; a robot has one root: "
                    "connect them by a joint (type floating if they are free)",
                    roots[0], roots[1]));
  }

  Problems& problems_;
  std::vector<std::string> names_;
  std::map<std::string, std::size_t> index_of_link_;
  std::map<std::string, int> line_of_joint_;
  std::vector<std::size_t> parent_;
};

}  // namespace

void check_urdf_tree(const TiXmlElement& robot, Problems& problems) {
  TreeCheck(problems).run(robot);
}

}  // namespace limber::scene

// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/robot/extension_reader.hpp"

#include <fmt/format.h>

#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "limber/common/names.hpp"
#include "limber/scene/robot/collision_reader.hpp"
#include "limber/scene/robot/coupler_reader.hpp"
#include "limber/scene/robot/flexible_reader.hpp"
#include "limber/scene/text/xml_element.hpp"

namespace limber::scene {
namespace {

template <typename Named>
Named* find_named(std::vector<Named>& all, const std::string& name) {
  for (Named& one : all) {
    if (one.name == name) return &one;
  }
  return nullptr;
}

template <typename Named>
std::map<std::string, std::size_t> index_names(const std::vector<Named>& all) {
  std::map<std::string, std::size_t> index;
  for (std::size_t i = 0; i < all.size(); ++i) index.emplace(all[i].name, i);
  return index;
}

template <typename Named>
void add_names(const std::vector<Named>& all, std::vector<std::string>& names) {
  for (const Named& one : all) names.push_back(one.name);
}

class ExtensionReader {
 public:
  ExtensionReader(Robot& robot, Problems& problems)
      : robot_(robot),
        problems_(problems),
        index_of_link_(index_names(robot.links)),
        index_of_joint_(index_names(robot.joints)) {
    add_names(robot.links, links_);
    add_names(robot.joints, joints_);
    for (const std::string& name : joints_) couplers_.insert(name);
    const auto add_couplers_of = [this](const auto& all) {
      for (const auto& one : all) couplers_.insert(one.name);
    };
    add_couplers_of(robot.gears);
    add_couplers_of(robot.loops);
    add_couplers_of(robot.connectors);
    add_couplers_of(robot.latches);
    add_couplers_of(robot.tendons);
  }

  void read(const TiXmlElement& root) {
    read_all(root, {{"flexible", [this](XmlElement& e) { add_flexible(e); }},
                    {"coupler", [this](XmlElement& e) { add_coupler(e); }},
                    {"loop", [this](XmlElement& e) { add_loop(e); }},
                    {"spring",
                     [this](XmlElement& e) {
                       add_pair(e, read_spring(e), robot_.connectors);
                     }},
                    {"bushing",
                     [this](XmlElement& e) {
                       add_pair(e, read_bushing(e), robot_.connectors);
                     }},
                    {"latch",
                     [this](XmlElement& e) {
                       add_pair(e, read_latch(e), robot_.latches);
                     }},
                    {"tendon", [this](XmlElement& e) { add_tendon(e); }}});
    // Read last, since they refer to others.
    read_all(root, {{"gear", [this](XmlElement& e) { add_gear(e); }},
                    {"contact", [this](XmlElement& e) { add_contact(e); }}});
  }

 private:
  void read_all(const TiXmlElement& root,
                const std::map<std::string, XmlElement::Reader>& readers) {
    for (const TiXmlElement* child = root.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
      const auto found = readers.find(child->ValueStr());
      if (found == readers.end()) continue;
      XmlElement element(*child, problems_);
      found->second(element);
      element.finish();
    }
  }

  Link* find_link(const std::string& name) {
    const auto found = index_of_link_.find(name);
    if (found == index_of_link_.end()) return nullptr;
    return &robot_.links[found->second];
  }
  Joint* find_joint(const std::string& name) {
    const auto found = index_of_joint_.find(name);
    if (found == index_of_joint_.end()) return nullptr;
    return &robot_.joints[found->second];
  }

  void add_flexible(XmlElement& element) {
    const std::string name = element.required_text("link");
    FlexibleLink flexible = read_flexible(element, robot_.file.parent_path());
    Link* link = find_link(name);
    if (link == nullptr) {
      element.fail(describe_unknown("link", name, links_));
      return;
    }
    if (link->flexible) element.fail("for link '" + name + "' is given twice");
    for (const auto& [joint, interface] : flexible.interface_of_joint) {
      check_joint(element, joint);
    }
    link->flexible = std::move(flexible);
  }

  void check_joint(const XmlElement& element, const std::string& name) {
    if (find_joint(name) != nullptr) return;
    element.fail(describe_unknown("joint", name, joints_));
  }

  void add_coupler(XmlElement& element) {
    const std::string name = element.required_text("joint");
    check_joint(element, name);
    Joint unknown;
    Joint* joint = find_joint(name);
    read_coupler(element, joint != nullptr ? *joint : unknown);
    if (!tuned_.insert(name).second) {
      element.fail("for joint '" + name + "' is given twice");
    }
  }

  void add_loop(XmlElement& element) {
    add_pair(element, read_loop(element), robot_.loops);
  }

  template <typename Coupler>
  void add_pair(XmlElement& element, const Coupler& coupler,
                std::vector<Coupler>& all) {
    check_end(element, coupler.from);
    check_end(element, coupler.to);
    check_name(element, coupler.name);
    all.push_back(coupler);
  }

  void add_tendon(XmlElement& element) {
    const Tendon tendon = read_tendon(element);
    for (const ConnectorEnd& end : tendon.via) check_end(element, end);
    check_name(element, tendon.name);
    robot_.tendons.push_back(tendon);
  }

  void add_contact(XmlElement& element) {
    const std::string name = element.required_text("link");
    const LinkContact contact = read_link_contact(element);
    Link* link = find_link(name);
    if (link == nullptr) {
      element.fail(describe_unknown("link", name, links_));
      return;
    }
    if (!touching_.insert(name).second) {
      element.fail("for link '" + name + "' is given twice");
    }
    if (link->flexible && contact.material) {
      element.fail(
          fmt::format("link '{}' is flexible; its material is that of "
                      "its <flexible>, leave it out here",
                      name));
    }
    if (!link->flexible && !contact.surfaces.empty()) {
      element.fail(
          fmt::format("link '{}' is rigid; its shapes are those of "
                      "its <collision>, leave 'surface' out",
                      name));
    }
    link->contact = contact;
  }

  void add_gear(XmlElement& element) {
    const Gear gear = read_gear(element);
    check_name(element, gear.name);
    check_geared(element, gear.joint);
    check_geared(element, gear.with);
    if (gear.joint == gear.with) {
      element.fail("couples joint '" + gear.joint + "' with itself");
    }
    robot_.gears.push_back(gear);
  }

  void check_geared(const XmlElement& element, const std::string& name) {
    const Joint* joint = find_joint(name);
    const Loop* loop = find_named(robot_.loops, name);
    if (joint == nullptr && loop == nullptr) {
      std::vector<std::string> known = joints_;
      add_names(robot_.loops, known);
      element.fail(describe_unknown("joint", name, known));
      return;
    }
    const joints::JointKind kind = joint != nullptr ? joint->kind : loop->kind;
    const std::size_t count = count_coordinates(kind);
    if (count == 1) return;
    element.fail(fmt::format(
        "needs joints with one coordinate; joint '{}' is {} and has {}", name,
        joints::to_string(kind), count));
  }

  // Probes, drives and results identify couplers by name.
  void check_name(const XmlElement& element, const std::string& name) {
    if (couplers_.insert(name).second) return;
    element.fail(fmt::format(
        "'{}' is given twice; couplers and joints need names of their own",
        name));
  }

  void check_end(const XmlElement& element, const ConnectorEnd& end) {
    const std::string& link = end.where.link;
    if (link == "world" || find_link(link) != nullptr) return;
    element.fail(describe_unknown("link", link, links_));
  }

  Robot& robot_;
  Problems& problems_;
  std::map<std::string, std::size_t> index_of_link_;
  std::map<std::string, std::size_t> index_of_joint_;
  std::vector<std::string> links_;
  std::vector<std::string> joints_;
  std::set<std::string> couplers_;
  std::set<std::string> tuned_;     ///< joints with a <coupler>
  std::set<std::string> touching_;  ///< links with a <contact>
};

}  // namespace

void read_extension(const TiXmlElement& root, Robot& robot,
                    Problems& problems) {
  ExtensionReader(robot, problems).read(root);
}

}  // namespace limber::scene

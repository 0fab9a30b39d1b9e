// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/robot/joined_robots.hpp"

#include <fmt/format.h>

#include <utility>

#include "limber/common/errors.hpp"

namespace limber::scene {
namespace {

/// Adds a robot's name to the names in it.
class Renamer {
 public:
  Renamer(const std::string& name, bool has_world)
      : prefix_(name + "."), has_world_(has_world) {}

  void rename(Robot& robot) const {
    keep_interfaces(robot);
    for (Link& link : robot.links) qualify(link.name);
    for (Joint& joint : robot.joints) qualify(joint.name);
    rename_ends(robot.loops);
    rename_ends(robot.connectors);
    rename_ends(robot.latches);
    for (Tendon& tendon : robot.tendons) {
      qualify(tendon.name);
      for (ConnectorEnd& end : tendon.via) rename(end);
    }
    for (Gear& gear : robot.gears) {
      for (std::string* one : {&gear.name, &gear.joint, &gear.with}) {
        qualify(*one);
      }
    }
  }

 private:
  void qualify(std::string& name) const { name.insert(0, prefix_); }

  void rename(ConnectorEnd& end) const {
    if (end.where.link != "world" || has_world_) qualify(end.where.link);
  }

  template <typename Coupler>
  void rename_ends(std::vector<Coupler>& couplers) const {
    for (Coupler& coupler : couplers) {
      qualify(coupler.name);
      rename(coupler.from);
      rename(coupler.to);
    }
  }

  // An interface that a link does not name has the name of the joint in its
  // file, which is kept.
  void keep_interfaces(Robot& robot) const {
    for (const Joint& joint : robot.joints) {
      for (const int side : {joint.parent, joint.child}) {
        auto& flexible = robot.links[static_cast<std::size_t>(side)].flexible;
        if (!flexible) continue;
        const auto own = flexible->interface_of_joint.find(joint.name);
        const std::string interface = own == flexible->interface_of_joint.end()
                                          ? joint.name
                                          : own->second;
        flexible->interface_of_joint[prefix_ + joint.name] = interface;
      }
    }
  }

  std::string prefix_;
  bool has_world_;
};

template <typename Item>
void append(std::vector<Item>&& from, std::vector<Item>& to) {
  for (Item& item : from) to.push_back(std::move(item));
}

void check_fixable(const Robot& robot) {
  const Link& root = robot.links.front();
  if (!root.flexible) return;
  throw InputError(
      fmt::format("{}: the root link '{}' is flexible; instead of a fixed base "
                  "give it a <clamp>, or a joint from a link 'world' to an "
                  "interface of it",
                  robot.file.string(), root.name));
}

void add_robot(const NamedRobot& source, Robot& joined) {
  if (source.is_fixed && !is_held(source.robot)) check_fixable(source.robot);
  Robot robot = source.robot;
  Renamer(source.name, robot.has_world_root()).rename(robot);
  const int first = static_cast<int>(joined.links.size());
  Joint base;
  base.name = source.name;
  base.kind = is_held(source.robot) || source.is_fixed
                  ? joints::JointKind::fixed
                  : joints::JointKind::floating;
  base.child = first;
  base.X_PJ = source.X_WR;
  joined.joints.push_back(base);
  for (Joint& joint : robot.joints) {
    joint.parent += first;
    joint.child += first;
  }
  append(std::move(robot.links), joined.links);
  append(std::move(robot.joints), joined.joints);
  append(std::move(robot.loops), joined.loops);
  append(std::move(robot.connectors), joined.connectors);
  append(std::move(robot.latches), joined.latches);
  append(std::move(robot.tendons), joined.tendons);
  append(std::move(robot.gears), joined.gears);
  for (const std::string& text : robot.warnings) {
    bool is_reported = false;
    for (const std::string& told : joined.warnings) {
      is_reported = is_reported || told == text;
    }
    if (!is_reported) joined.warnings.push_back(text);
  }
}

}  // namespace

bool is_held(const Robot& robot) {
  LIMBER_EXPECT(!robot.links.empty());
  const auto& flexible = robot.links.front().flexible;
  return robot.has_world_root() ||
         (flexible && !flexible->clamped_groups.empty());
}

Robot fix_base(Robot robot, const Pose& X_WR) {
  check_fixable(robot);
  Joint base;
  base.name = "base";
  base.child = 1;
  base.X_PJ = X_WR;
  for (Joint& joint : robot.joints) {
    ++joint.parent;
    ++joint.child;
    if (joint.name == base.name) base.name += '_';
  }
  for (const Link& link : robot.links) {
    if (link.name != "world") continue;
    throw InputError(fmt::format(
        "{}: its link 'world' is not the root; rename the link to fix the base",
        robot.file.string()));
  }
  Link world;
  world.name = "world";
  robot.links.insert(robot.links.begin(), world);
  robot.joints.insert(robot.joints.begin(), base);
  return robot;
}

Robot make_joints_ideal(Robot robot) {
  for (Joint& joint : robot.joints) {
    CouplerOptions& options = joint.coupler;
    if (!options.is_ideal && !options.is_elastic()) options.is_ideal = true;
  }
  return robot;
}

Robot join_robots(const std::vector<NamedRobot>& robots) {
  Robot joined;
  joined.links.emplace_back().name = "world";
  for (const NamedRobot& robot : robots) add_robot(robot, joined);
  return joined;
}

}  // namespace limber::scene

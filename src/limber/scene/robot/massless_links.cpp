// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/robot/massless_links.hpp"

#include <fmt/format.h>

#include <vector>

#include "limber/common/index.hpp"

namespace limber::scene {
namespace {

bool has_mass(const Link& link) {
  return link.flexible || (link.inertia && link.inertia->mass != 0.0);
}

class EndFixer {
 public:
  EndFixer(const std::set<std::string>& used, Robot& robot)
      : used_(used), robot_(robot) {
    for (const ConnectorEnd& end : find_ends(robot)) {
      bound_.insert(end.where.link);
    }
    for (const Gear& gear : robot.gears) bound_.insert(gear.with);
    for (const Link& link : robot.links) {
      stays_.push_back(has_mass(link) || is_bound(link.name) ? 1 : 0);
    }
  }

  void run() {
    // Children come after their parents.
    for (int i = static_cast<int>(robot_.joints.size()) - 1; i >= 0; --i) {
      Joint& joint = robot_.joints[index(i)];
      if (!merges(robot_, joint)) release(joint);
      if (stays_[index(joint.child)] != 0) stays_[index(joint.parent)] = 1;
    }
    if (fixed_.empty()) return;
    const std::set<std::string> fixed(fixed_.begin(), fixed_.end());
    std::erase_if(robot_.gears,
                  [&](const Gear& gear) { return fixed.contains(gear.joint); });
    robot_.warnings.push_back(fmt::format(
        "{} joint{} of links without mass {} fixed at zero, the first '{}'; "
        "give its link an <inertial> if it is to move",
        fixed_.size(), fixed_.size() > 1 ? "s" : "",
        fixed_.size() > 1 ? "are" : "is", fixed_.back()));
  }

 private:
  [[nodiscard]] bool is_bound(const std::string& name) const {
    return used_.contains(name) || bound_.contains(name);
  }

  void release(Joint& joint) {
    char& stays = stays_[index(joint.child)];
    if (stays != 0 || joint.kind == joints::JointKind::floating ||
        is_bound(joint.name)) {
      stays = 1;  // a joint that moves hangs on its parent
      return;
    }
    joint.kind = joints::JointKind::fixed;
    joint.coupler = {};
    joint.actions.clear();
    fixed_.push_back(joint.name);
  }

  const std::set<std::string>& used_;
  Robot& robot_;
  std::set<std::string> bound_;
  std::vector<char> stays_;  ///< by link: it, or what it carries, must move
  std::vector<std::string> fixed_;
};

}  // namespace

bool has_massless_root(const Robot& robot) {
  std::vector<bool> is_root(robot.links.size(), false);
  is_root.front() = true;
  for (const Joint& joint : robot.joints) {
    is_root[index(joint.child)] =
        is_root[index(joint.parent)] && merges(robot, joint);
  }
  bool moves = false;
  for (std::size_t i = 0; i < robot.links.size(); ++i) {
    if (!has_mass(robot.links[i])) continue;
    if (is_root[i]) return false;
    moves = true;
  }
  return moves;
}

void fix_massless_ends(const std::set<std::string>& used, Robot& robot) {
  EndFixer(used, robot).run();
}

}  // namespace limber::scene

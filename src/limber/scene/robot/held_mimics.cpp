// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/robot/held_mimics.hpp"

#include <fmt/format.h>

#include <map>
#include <string>
#include <vector>

namespace limber::scene {
namespace {

/// The joint with its coordinate fixed at `q` [rad or m].
void fix_joint(double q, Joint& joint) {
  const Pose X_JQ =
      joint.kind == joints::JointKind::prismatic
          ? Pose{Matrix3::Identity(), q * joint.axis_J}
          : Pose{Eigen::AngleAxisd(q, joint.axis_J).toRotationMatrix(),
                 Vector3::Zero()};
  joint.X_PJ = joint.X_PJ * X_JQ;
  joint.kind = joints::JointKind::fixed;
  joint.coupler = {};
  joint.actions.clear();
}

class Holder {
 public:
  explicit Holder(Robot& robot) : robot_(robot) {
    for (Joint& joint : robot.joints) {
      joints_[joint.name] = &joint;
      if (joint.kind == joints::JointKind::fixed) add(joint.name, 0.0);
    }
    for (const Gear& mimic : robot.gears) mimics_.emplace(mimic.with, &mimic);
  }

  void run() {
    for (const Gear& mimic : robot_.gears) {
      if (mimic.ratio == 0.0) hold(mimic, mimic.offset, "times 0");
    }
    while (!left_.empty()) {
      const std::string with = left_.back();
      left_.pop_back();
      const auto [first, last] = mimics_.equal_range(with);
      for (auto one = first; one != last; ++one) {
        const Gear& mimic = *one->second;
        hold(mimic, mimic.ratio * held_.at(with) + mimic.offset,
             "which does not move");
      }
    }
    std::erase_if(robot_.gears, [&](const Gear& mimic) {
      return held_.contains(mimic.joint);
    });
  }

 private:
  void add(const std::string& joint, double q) {
    held_[joint] = q;
    left_.push_back(joint);
  }

  void hold(const Gear& mimic, double q, const char* why) {
    if (held_.contains(mimic.joint)) return;
    fix_joint(q, *joints_.at(mimic.joint));
    add(mimic.joint, q);
    robot_.warnings.push_back(fmt::format(
        "{}: joint '{}' is fixed at {:g}: its <mimic> is of joint '{}', {}",
        robot_.file.string(), mimic.joint, q, mimic.with, why));
  }

  Robot& robot_;
  std::map<std::string, Joint*> joints_;
  std::multimap<std::string, const Gear*> mimics_;  ///< by what they mimic
  std::map<std::string, double> held_;              ///< joints that do not move
  std::vector<std::string> left_;  ///< of these, whose mimics are not held yet
};

}  // namespace

void hold_mimics(Robot& robot) { Holder(robot).run(); }

}  // namespace limber::scene

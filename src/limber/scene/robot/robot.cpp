// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/robot/robot.hpp"

#include "limber/common/errors.hpp"
#include "limber/common/names.hpp"

namespace limber::scene {

std::size_t count_coordinates(joints::JointKind kind) {
  return joints::find_coordinates(kind, Vector3::UnitX(), Vector3::UnitY())
      .size();
}

std::vector<ConnectorEnd> find_ends(const Robot& robot) {
  std::vector<ConnectorEnd> ends;
  const auto add_both = [&](const auto& couplers) {
    for (const auto& coupler : couplers) {
      ends.push_back(coupler.from);
      ends.push_back(coupler.to);
    }
  };
  add_both(robot.loops);
  add_both(robot.connectors);
  add_both(robot.latches);
  for (const Tendon& tendon : robot.tendons) {
    ends.insert(ends.end(), tendon.via.begin(), tendon.via.end());
  }
  return ends;
}

std::vector<std::string> find_surfaces(const Link& link) {
  if (link.contact.surfaces.empty()) return {"skin"};
  return link.contact.surfaces;
}

int find_link(const Robot& robot, const std::string& name) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < robot.links.size(); ++i) {
    if (robot.links[i].name == name) return static_cast<int>(i);
    names.push_back(robot.links[i].name);
  }
  throw InputError(describe_unknown("link", name, names));
}

bool merges(const Robot& robot, const Joint& joint) {
  return joint.kind == joints::JointKind::fixed &&
         !robot.links[static_cast<std::size_t>(joint.parent)].flexible &&
         !robot.links[static_cast<std::size_t>(joint.child)].flexible;
}

}  // namespace limber::scene

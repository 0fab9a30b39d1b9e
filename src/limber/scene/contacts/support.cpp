// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/contacts/support.hpp"

#include <map>
#include <numeric>
#include <set>

#include "limber/common/index.hpp"

namespace limber::scene {
namespace {

/// Groups of links that are joined to each other. Index 0 is the world, i + 1
/// is link i.
class Groups {
 public:
  explicit Groups(const Robot& robot) : group_(robot.links.size() + 1) {
    std::iota(group_.begin(), group_.end(), std::size_t{0});
    for (std::size_t i = 0; i < robot.links.size(); ++i) {
      const Link& link = robot.links[i];
      number_[link.name] = i + 1;
      const bool is_clamped =
          link.flexible && !link.flexible->clamped_groups.empty();
      if (is_clamped) join(0, i + 1);
    }
    number_["world"] = 0;
    if (robot.has_world_root()) join(0, 1);
  }

  void join(std::size_t a, std::size_t b) { group_[find(a)] = find(b); }

  /// All of one coupler.
  void join(const std::vector<ConnectorEnd>& ends) {
    for (const ConnectorEnd& end : ends) {
      join(number_.at(ends.front().where.link), number_.at(end.where.link));
    }
  }

  void hold(const std::string& link) {
    const auto found = number_.find(link);
    if (found != number_.end()) join(0, found->second);
  }

  std::size_t find(std::size_t i) {
    while (group_[i] != i) i = group_[i] = group_[group_[i]];
    return i;
  }

 private:
  std::vector<std::size_t> group_;
  std::map<std::string, std::size_t> number_;
};

void join_couplers(const Robot& robot, Groups& groups) {
  for (const Joint& joint : robot.joints) {
    if (joint.kind == joints::JointKind::floating) continue;
    groups.join(index(joint.parent) + 1, index(joint.child) + 1);
  }
  const auto join_all = [&](const auto& couplers) {
    for (const auto& one : couplers) groups.join({one.from, one.to});
  };
  join_all(robot.loops);
  join_all(robot.connectors);
  join_all(robot.latches);
  for (const Tendon& tendon : robot.tendons) groups.join(tendon.via);
}

}  // namespace

std::vector<std::string> find_falling_links(
    const Scenario& scenario, const Robot& robot,
    const std::vector<TouchingPair>& touching) {
  if (scenario.gravity.isZero(0.0)) return {};
  Groups groups(robot);
  join_couplers(robot, groups);
  const auto number = [](const Toucher& one) {
    return one.is_obstacle ? 0 : one.index + 1;
  };
  for (const TouchingPair& pair : touching) {
    groups.join(number(pair.A), number(pair.B));
  }
  for (const LoadSpec& load : scenario.loads) groups.hold(load.where.link);
  std::vector<std::string> names;
  std::set<std::size_t> known = {groups.find(0)};
  for (std::size_t i = 0; i < robot.tree_size(); ++i) {
    if (known.insert(groups.find(i + 1)).second) {
      names.push_back(robot.links[i].name);
    }
  }
  return names;
}

}  // namespace limber::scene

// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/contacts/touching_pairs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/common/names.hpp"
#include "limber/scene/text/error_context.hpp"
#include "limber/scene/text/glob.hpp"

namespace limber::scene {
namespace {

constexpr std::size_t kMostPairs = 100000;  // of one contact

using Pair = std::pair<Toucher, Toucher>;

Pair make_pair_key(const Toucher& a, const Toucher& b) {
  return a < b ? Pair{a, b} : Pair{b, a};
}

/// The group of links fixed to each other of every link, by its first one.
std::vector<std::size_t> find_rigid_groups(const Robot& robot) {
  std::vector<std::size_t> groups(robot.links.size());
  std::iota(groups.begin(), groups.end(), std::size_t{0});
  for (const Joint& joint : robot.joints) {
    if (merges(robot, joint)) {
      groups[index(joint.child)] = groups[index(joint.parent)];
    }
  }
  return groups;
}

/// Pairs of links that a joint or a loop holds together.
std::set<Pair> find_neighbours(const Robot& robot) {
  std::set<Pair> pairs;
  const auto add = [&](std::size_t a, std::size_t b) {
    pairs.insert(make_pair_key({false, a}, {false, b}));
  };
  for (const Joint& joint : robot.joints) {
    if (joint.kind == joints::JointKind::floating) continue;
    add(index(joint.parent), index(joint.child));
  }
  std::map<std::string, std::size_t> by_name;
  for (std::size_t i = 0; i < robot.links.size(); ++i) {
    by_name.emplace(robot.links[i].name, i);
  }
  for (const Loop& loop : robot.loops) {
    const auto from = by_name.find(loop.from.where.link);
    const auto to = by_name.find(loop.to.where.link);
    if (from != by_name.end() && to != by_name.end()) {
      add(from->second, to->second);
    }
  }
  return pairs;
}

bool has_shape(const Link& link) {
  return link.flexible || !link.collisions.empty();
}

/// @throws InputError if contacts cannot take one of the link's shapes.
void check_shapes(const Link& link) {
  if (link.flexible) return;
  for (const Collision& collision : link.collisions) {
    const auto* other = std::get_if<OtherGeometry>(&collision.geometry);
    if (other == nullptr) continue;
    if (!other->reason.empty()) {
      throw InputError(fmt::format("link '{}' needs its <collision> here: {}",
                                   link.name, other->reason));
    }
    throw InputError(
        fmt::format("link '{}' has a <{}> in its <collision>, which contacts "
                    "do not support; use <sphere>, <box>, <cylinder>, "
                    "<capsule>, <cone>, <ellipsoid> or <mesh>, or make the "
                    "link flexible: its own mesh is then the contact shape",
                    link.name, other->tag));
  }
}

class PairFinder {
 public:
  PairFinder(const Scenario& scenario, const Robot& robot)
      : scenario_(scenario),
        robot_(robot),
        groups_(find_rigid_groups(robot)),
        neighbours_(find_neighbours(robot)) {
    for (std::size_t i = 0; i < robot.links.size(); ++i) add({false, i});
    for (std::size_t i = 0; i < scenario.obstacles.size(); ++i) add({true, i});
  }

  TouchingPairs run() {
    std::vector<std::string> problems;
    const std::size_t count = scenario_.contacts.size();
    std::vector<std::vector<Pair>> pairs(count);
    for (std::size_t i = 0; i < count; ++i) {
      try {
        with_context(describe(i), [&] { pairs[i] = find_pairs(i); });
      } catch (const InputError& error) {
        problems.insert(problems.end(), error.problems().begin(),
                        error.problems().end());
      }
    }
    if (!problems.empty()) throw InputError(problems);
    return collect(pairs);
  }

 private:
  void add(const Toucher& body) {
    bodies_.push_back(body);
    names_.push_back(name_of(body, robot_, scenario_));
  }

  [[nodiscard]] std::string describe(std::size_t contact) const {
    const auto& [a, b] = scenario_.contacts[contact].between;
    return fmt::format("[[contact]] {} between '{}' and '{}'", contact + 1, a,
                       b);
  }

  /// Whether its names are those of two bodies.
  [[nodiscard]] bool is_exact(std::size_t contact) const {
    const auto& between = scenario_.contacts[contact].between;
    return std::none_of(between.begin(), between.end(),
                        [&](const std::string& name) {
                          return is_pattern(name) && !is_known(name);
                        });
  }

  [[nodiscard]] bool is_known(const std::string& name) const {
    return std::find(names_.begin(), names_.end(), name) != names_.end();
  }

  std::vector<Pair> find_pairs(std::size_t contact) {
    const auto& between = scenario_.contacts[contact].between;
    const std::vector<Toucher> all_A = find_bodies(between[0]);
    const std::vector<Toucher> all_B = find_bodies(between[1]);
    if (is_exact(contact)) {
      check_exact(contact, all_A.front(), all_B.front());
      return {{all_A.front(), all_B.front()}};
    }
    std::vector<Pair> pairs;
    std::set<Pair> found;
    for (const Toucher& A : all_A) {
      for (const Toucher& B : all_B) {
        if (are_fixed_together(A, B)) continue;
        const Pair key = make_pair_key(A, B);
        if (neighbours_.count(key) != 0) continue;
        if (found.insert(key).second) pairs.emplace_back(A, B);
      }
    }
    if (pairs.size() > kMostPairs) {
      throw InputError(fmt::format(
          "matches {} pairs of bodies; at most {} are allowed: name fewer",
          pairs.size(), kMostPairs));
    }
    if (pairs.empty()) {
      throw InputError(
          "leaves no pair of bodies that can be in contact; a pattern does not "
          "match links that a joint connects directly: name both for these");
    }
    return pairs;
  }

  /// All bodies with shapes that match a name or pattern.
  [[nodiscard]] std::vector<Toucher> find_bodies(
      const std::string& name) const {
    const bool exact = is_known(name);
    if (!exact && !is_pattern(name)) {
      throw InputError(describe_unknown("body", name, names_));
    }
    std::vector<Toucher> found;
    bool is_any = false;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      if (exact ? names_[i] != name : !matches(name, names_[i])) continue;
      is_any = true;
      if (!bodies_[i].is_obstacle) {
        const Link& link = robot_.links[bodies_[i].index];
        if (!has_shape(link)) continue;
        check_shapes(link);
      }
      found.push_back(bodies_[i]);
    }
    if (!found.empty()) return found;
    if (exact) {
      throw InputError(fmt::format(
          "link '{}' has no contact shape; give it a <collision>", name));
    }
    throw InputError(
        is_any
            ? fmt::format("no link that '{}' matches has a <collision>", name)
            : fmt::format("'{}' matches no link, projectile or obstacle",
                          name));
  }

  [[nodiscard]] bool is_fixed_in_world(const Toucher& body) const {
    return body.is_obstacle ||
           (robot_.has_world_root() && groups_[body.index] == 0);
  }

  [[nodiscard]] bool are_fixed_together(const Toucher& A,
                                        const Toucher& B) const {
    if (is_fixed_in_world(A) && is_fixed_in_world(B)) return true;
    return !A.is_obstacle && !B.is_obstacle &&
           groups_[A.index] == groups_[B.index];
  }

  void check_exact(std::size_t contact, const Toucher& A, const Toucher& B) {
    if (A == B) throw InputError("names one body twice; name two");
    if (is_fixed_in_world(A) && is_fixed_in_world(B)) {
      throw InputError(
          "both are fixed in the world and can never be in contact");
    }
    if (are_fixed_together(A, B)) {
      throw InputError("fixed joints make them one rigid body");
    }
    const auto [other, is_new] = exact_.emplace(make_pair_key(A, B), contact);
    if (is_new) return;
    throw InputError(fmt::format("[[contact]] {} names the same; keep one",
                                 other->second + 1));
  }

  [[nodiscard]] TouchingPairs collect(
      const std::vector<std::vector<Pair>>& pairs) const {
    TouchingPairs result;
    std::set<Pair> decided;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      bool decides = false;
      for (const auto& [A, B] : pairs[i]) {
        const Pair key = make_pair_key(A, B);
        const auto exact = exact_.find(key);
        if (exact != exact_.end() && exact->second != i) continue;
        if (!decided.insert(key).second) continue;
        result.pairs.push_back({i, A, B});
        decides = true;
      }
      if (!decides) result.idle.push_back(i);
    }
    return result;
  }

  const Scenario& scenario_;
  const Robot& robot_;
  std::vector<std::size_t> groups_;
  std::set<Pair> neighbours_;
  std::vector<Toucher> bodies_;
  std::vector<std::string> names_;
  std::map<Pair, std::size_t> exact_;  ///< contacts that name both bodies
};

}  // namespace

const std::string& name_of(const Toucher& body, const Robot& robot,
                           const Scenario& scenario) {
  return body.is_obstacle ? scenario.obstacles[body.index].name
                          : robot.links[body.index].name;
}

TouchingPairs find_touching_pairs(const Scenario& scenario,
                                  const Robot& robot) {
  return PairFinder(scenario, robot).run();
}

}  // namespace limber::scene

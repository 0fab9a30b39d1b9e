// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/system/linked_groups.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
#include <utility>

#include "limber/common/index.hpp"

namespace limber::dynamics {
namespace {

// Whether it cannot move, as the world.
bool is_fixed(const SystemModel& model, BodyIndex b) {
  if (b == kWorld) return true;
  const BodyModel& body = model.bodies[static_cast<std::size_t>(b)];
  return body.clamped && body.modes == 0 && body.full < 0;
}

/// Connected groups of bodies; the world is the last entry.
class Groups {
 public:
  explicit Groups(std::size_t bodies) : parent_(bodies + 1) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t find(std::size_t i) const {
    while (parent_[i] != i) i = parent_[i];
    return i;
  }
  void join(BodyIndex a, BodyIndex b) { parent_[root(a)] = root(b); }
  std::size_t root(BodyIndex body) const {
    return find(body == kWorld ? parent_.size() - 1
                               : static_cast<std::size_t>(body));
  }

 private:
  std::vector<std::size_t> parent_;
};

using Join = std::function<void(BodyIndex, BodyIndex)>;

// Bodies that forces of couplers and along paths act between.
void join_by_couplings(const SystemModel& model, const Join& join) {
  const auto body_at = [&](AttachmentIndex a) {
    return model.attachments[static_cast<std::size_t>(a)].body;
  };
  for (const Coupler& c : model.couplers) {
    join(body_at(c.frame_F), body_at(c.frame_M));
  }
  for (const Transmission& t : model.transmissions) {
    const auto* path = std::get_if<PathCoordinate>(&t.coordinate);
    if (path == nullptr) continue;  // its joints are couplers
    for (const AttachmentIndex point : path->points) {
      join(body_at(path->points.front()), body_at(point));
    }
  }
}

void join_by_pairs(const SystemModel& model, const Join& join) {
  for (const Pair& pair : model.pairs) join(pair.body_A, pair.body_B);
}

// Of joints that a gear connects, although no force acts between them.
void join_by_gears(const SystemModel& model, const Join& join) {
  for (const Transmission& t : model.transmissions) {
    const auto* sum = std::get_if<JointSum>(&t.coordinate);
    if (sum == nullptr) continue;
    std::optional<BodyIndex> first;
    for (const JointSum::Term& term : sum->terms) {
      const Coupler& c = model.couplers[static_cast<std::size_t>(term.coupler)];
      for (const AttachmentIndex a : {c.frame_F, c.frame_M}) {
        const BodyIndex b = model.attachments[static_cast<std::size_t>(a)].body;
        if (is_fixed(model, b)) continue;
        join(first.value_or(b), b);
        first = b;
      }
    }
  }
}

/// Bodies of each group without the world.
std::vector<std::vector<BodyIndex>> collect_groups(const SystemModel& model,
                                                   const Groups& groups) {
  std::vector<std::vector<BodyIndex>> by_root(model.bodies.size() + 1);
  for (BodyIndex b(0); b < std::ssize(model.bodies); ++b) {
    if (groups.root(b) == groups.root(kWorld)) continue;
    by_root[groups.root(b)].push_back(b);
  }
  std::erase_if(by_root, [](const auto& group) { return group.empty(); });
  return by_root;
}

}  // namespace

double radius_of_gyration(const BodyModel& body) {
  return std::sqrt(0.5 * body.J0.trace() / body.mass);
}

std::vector<std::vector<BodyIndex>> find_free_groups(const SystemModel& model) {
  Groups groups(model.bodies.size());
  for (BodyIndex b(0); b < std::ssize(model.bodies); ++b) {
    if (model.bodies[static_cast<std::size_t>(b)].clamped) {
      groups.join(b, kWorld);
    }
  }
  const Join join = [&](BodyIndex a, BodyIndex b) { groups.join(a, b); };
  join_by_couplings(model, join);
  join_by_pairs(model, join);
  return collect_groups(model, groups);
}

std::vector<std::vector<BodyIndex>> find_linked_groups(
    const SystemModel& model) {
  Groups groups(model.bodies.size());
  const Join join = [&](BodyIndex a, BodyIndex b) {
    if (!is_fixed(model, a) && !is_fixed(model, b)) groups.join(a, b);
  };
  join_by_couplings(model, join);
  join_by_pairs(model, join);
  join_by_gears(model, join);
  return collect_groups(model, groups);
}

GroupExtent find_group_extent(const SystemModel& model,
                              const SystemState& state,
                              const std::vector<BodyIndex>& group) {
  GroupExtent extent;
  for (const BodyIndex b : group) {
    const auto i = static_cast<std::size_t>(b);
    extent.mass += model.bodies[i].mass;
    extent.centre += model.bodies[i].mass * state.bodies[i].p_WB;
  }
  extent.centre /= extent.mass;
  for (const BodyIndex b : group) {
    const auto i = static_cast<std::size_t>(b);
    extent.reach =
        std::max(extent.reach, (state.bodies[i].p_WB - extent.centre).norm() +
                                   radius_of_gyration(model.bodies[i]));
  }
  return extent;
}

std::vector<CoupledGroup> find_coupled_groups(const SystemModel& model) {
  Groups groups(model.bodies.size());
  std::vector<char> is_held(model.bodies.size(), 0);
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    is_held[b] = model.bodies[b].clamped ? 1 : 0;
  }
  const Join join = [&](BodyIndex a, BodyIndex b) {
    if (a != kWorld && b != kWorld) groups.join(a, b);
    if (a == kWorld && b != kWorld) is_held[index(b)] = 1;
    if (b == kWorld && a != kWorld) is_held[index(a)] = 1;
  };
  join_by_couplings(model, join);
  join_by_gears(model, join);
  std::vector<CoupledGroup> coupled;
  for (std::vector<BodyIndex>& bodies : collect_groups(model, groups)) {
    const bool any =
        std::any_of(bodies.begin(), bodies.end(),
                    [&](BodyIndex b) { return is_held[index(b)] != 0; });
    coupled.push_back({std::move(bodies), any});
  }
  return coupled;
}

std::vector<Vector3> find_drifts(const SystemModel& model,
                                 const SystemState& state) {
  std::vector<Vector3> drifts(model.bodies.size(), Vector3::Zero());
  for (const auto& group : find_free_groups(model)) {
    Vector3 momentum = Vector3::Zero();
    double mass = 0.0;
    for (const BodyIndex b : group) {
      momentum += model.bodies[static_cast<std::size_t>(b)].mass *
                  state.bodies[static_cast<std::size_t>(b)].v_WB_W;
      mass += model.bodies[static_cast<std::size_t>(b)].mass;
    }
    for (const BodyIndex b : group)
      drifts[static_cast<std::size_t>(b)] = momentum / mass;
  }
  return drifts;
}

}  // namespace limber::dynamics

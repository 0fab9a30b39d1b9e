// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/newton/force_balance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "limber/common/errors.hpp"
#include "limber/dynamics/bodies/body.hpp"
#include "limber/dynamics/newton/newton_matrix.hpp"
#include "limber/dynamics/system/linked_groups.hpp"
#include "limber/dynamics/system/unknowns.hpp"

namespace limber::dynamics {
namespace {

/// The bodies of a free group, and where they are.
struct Group {
  std::vector<BodyIndex> bodies;
  std::vector<char> has;  ///< of all bodies, whether it is one of them
  GroupExtent extent;

  [[nodiscard]] bool contains(BodyIndex b) const {
    return b != kWorld && has[static_cast<std::size_t>(b)] != 0;
  }
};

Group describe_group(const SystemModel& model, const SystemState& state,
                     const std::vector<BodyIndex>& bodies) {
  Group group{bodies, std::vector<char>(model.bodies.size(), 0),
              find_group_extent(model, state, bodies)};
  for (const BodyIndex b : bodies) group.has[static_cast<std::size_t>(b)] = 1;
  return group;
}

/// Sums of magnitudes, without cancellation.
struct Magnitudes {
  double force = 0.0;   ///< [N]
  double moment = 0.0;  ///< about any point within the group [N m]
};

Magnitudes find_magnitudes(const SystemModel& model, const SystemState& state,
                           const SystemTerms& terms, const Group& group) {
  Magnitudes sum;
  const auto holds = [&](AttachmentIndex a) {
    return group.contains(model.attachments[static_cast<std::size_t>(a)].body);
  };
  for (const Load& load : model.loads) {
    if (!holds(load.where)) continue;
    const double c = std::abs(evaluate(load.function, now_of(state)));
    sum.force += c * load.force.norm();
    sum.moment += c * load.moment.norm();
  }
  for (std::size_t i = 0; i < model.couplers.size(); ++i) {
    const Coupler& coupler = model.couplers[i];
    if (!holds(coupler.frame_F) && !holds(coupler.frame_M)) continue;
    sum.force += terms.couplers[i].applied.head<3>().norm();
    sum.moment += terms.couplers[i].applied.tail<3>().norm();
  }
  for (std::size_t i = 0; i < model.pairs.size(); ++i) {
    const Pair& pair = model.pairs[i];
    if (!group.contains(pair.body_A) && !group.contains(pair.body_B)) continue;
    for (const auto& point : terms.pairs.responses[i].points()) {
      sum.force += point.force_W.norm();
    }
  }
  for (const BodyIndex b : group.bodies) {
    const auto i = static_cast<std::size_t>(b);
    const BodyModel& body = model.bodies[i];
    sum.force += body.mass * model.gravity_W.norm() +
                 std::sqrt(body.mass) * terms.bodies[i].modal_force.norm();
    sum.force += visit_body(
        model, i, [&](const auto& own) { return own.sum_nodal_forces(terms); });
  }
  sum.moment += group.extent.reach * sum.force;
  return sum;
}

std::string name_group(const SystemModel& model,
                       const std::vector<BodyIndex>& group) {
  const auto name = [&](std::size_t i) {
    return model.bodies[static_cast<std::size_t>(group[i])].name;
  };
  if (group.size() == 1) return fmt::format("body '{}' is", name(0));
  return fmt::format("body '{}' and {} with it are", name(0), group.size() - 1);
}

[[noreturn]] void refuse(const std::string& who, const char* what,
                         const Vector3& sum, const char* unit,
                         const char* direction) {
  const Vector3 e = sum.normalized();
  throw InputError(
      fmt::format("{} not in equilibrium anywhere: without connection to the "
                  "world, and under a net {} of {:.4g} {} {} ({:.3g}, {:.3g}, "
                  "{:.3g}); connect or balance it",
                  who, what, sum.norm(), unit, direction, e.x() + 0.0,
                  e.y() + 0.0, e.z() + 0.0));
}

}  // namespace

SystemState stop(const SystemState& state) {
  SystemState rest = state;
  for (BodyState& body : rest.bodies) {
    body.v_WB_W.setZero();
    body.w_WB_B.setZero();
  }
  rest.etadot.setZero();
  rest.maxwell.setZero();
  rest.udot_H.setZero();
  return rest;
}

VectorX find_length_weights(const SystemModel& model) {
  VectorX weights = make_unknowns(model);
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    for (const UnknownRange& range : list_unknowns(model, b)) {
      weights.segment(range.row, range.size).setConstant(std::sqrt(range.mass));
    }
  }
  return weights;
}

void check_balance(const SystemModel& model, const SystemState& state,
                   const SystemTerms& terms) {
  constexpr double kBalanced = 1e-10;  // of the magnitudes: round-off
  for (const std::vector<BodyIndex>& bodies : find_free_groups(model)) {
    const Group group = describe_group(model, state, bodies);
    const Magnitudes all = find_magnitudes(model, state, terms, group);
    WrenchSum sum{group.extent.centre};
    for (const BodyIndex b : bodies) {
      visit_body(model, static_cast<std::size_t>(b),
                 [&](const auto& own) { own.add_forces(state, terms, sum); });
    }
    const std::string who = name_group(model, bodies);
    if (sum.force.norm() > kBalanced * all.force) {
      refuse(who, "force", sum.force, "N", "along");
    }
    if (sum.moment.norm() > kBalanced * all.moment) {
      refuse(who, "moment", sum.moment, "N m", "about");
    }
  }
}

}  // namespace limber::dynamics

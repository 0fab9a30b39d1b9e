// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/analysis/steady_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "limber/common/index.hpp"
#include "limber/common/rotation.hpp"
#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/equations/relative_energy.hpp"
#include "limber/dynamics/newton/newton_measures.hpp"
#include "limber/dynamics/system/linked_groups.hpp"
#include "limber/dynamics/system/unknowns.hpp"

namespace limber::dynamics {
namespace {

using Bodies = std::vector<BodyIndex>;

bool contains(const Bodies& bodies, BodyIndex b) {
  return std::find(bodies.begin(), bodies.end(), b) != bodies.end();
}

void note(double size, const std::string& body, double& largest,
          std::string& where) {
  if (!(size > largest)) return;
  largest = size;
  where = body;
}

/// What is left of the forces at a state.
class Remainder {
 public:
  Remainder(const SystemModel& model, const SystemState& state,
            const std::vector<Vector3>& spins)
      : model_(model),
        state_(state),
        spins_(spins),
        drifts_(find_drifts(model, state)),
        terms_(make_terms(model)),
        a_(make_unknowns(model)) {
    calc_terms(model, state, Side::right, terms_);
    solve_accelerations(model, terms_, a_);
    find_roundoff_gaps(model, terms_, 0.0, noise_);
  }

  struct OfGroup {
    Imbalance left;
    double excess = 0.0;  // of it over round-off of the forces [-]
  };

  [[nodiscard]] OfGroup find(const Bodies& group) const {
    constexpr double kBalanced = 1e-6;  // of the acting forces
    constexpr double kSafety = 100.0;   // of round-off
    OfGroup out;
    out.left.acting = sum_forces(group);
    double reach = 0.0;
    for (const BodyIndex b : group) {
      include(b, out.left);
      const BodyModel& body = model_.bodies[index(b)];
      reach = std::max(reach, radius_of_gyration(body));
    }
    const double limit =
        kBalanced * out.left.acting + kSafety * find_noise(group);
    const double left = std::max(out.left.force, out.left.moment / reach);
    out.left.matters = left > limit;
    if (left > 0.0) {
      out.excess =
          limit > 0.0 ? left / limit : std::numeric_limits<double>::infinity();
    }
    return out;
  }

 private:
  [[nodiscard]] bool holds(const Bodies& group, AttachmentIndex a) const {
    return contains(group, model_.attachments[index(a)].body);
  }

  [[nodiscard]] double sum_forces(const Bodies& group) const {
    double sum = 0.0;
    for (const Load& load : model_.loads) {
      if (!holds(group, load.where)) continue;
      sum +=
          std::abs(evaluate(load.function, now_of(state_))) * load.force.norm();
    }
    for (std::size_t c = 0; c < model_.couplers.size(); ++c) {
      const Coupler& coupler = model_.couplers[c];
      if (!holds(group, coupler.frame_F) && !holds(group, coupler.frame_M)) {
        continue;
      }
      sum += terms_.couplers[c].applied.head<3>().norm();
    }
    for (const BodyIndex b : group) {
      sum += model_.bodies[index(b)].mass * model_.gravity_W.norm() +
             terms_.bodies[index(b)].force_W.norm();
    }
    return sum;
  }

  // Force of couplers due to round-off of positions.
  [[nodiscard]] double find_noise(const Bodies& group) const {
    double noise = 0.0;
    for (std::size_t c = 0; c < noise_.size(); ++c) {
      if (acts_on(group, c)) noise = std::max(noise, noise_[c].norm());
    }
    return noise;
  }

  // Gaps are those of couplers, then of transmissions.
  [[nodiscard]] bool acts_on(const Bodies& group, std::size_t gap) const {
    const std::size_t couplers = model_.couplers.size();
    if (gap < couplers) {
      const Coupler& coupler = model_.couplers[gap];
      return holds(group, coupler.frame_F) || holds(group, coupler.frame_M);
    }
    const JoinedBodies joined =
        find_joined_bodies(model_, model_.transmissions[gap - couplers]);
    return std::any_of(joined.begin(), joined.end(),
                       [&](BodyIndex b) { return contains(group, b); });
  }

  void include(BodyIndex b, Imbalance& left) const {
    const BodyModel& body = model_.bodies[index(b)];
    const auto modes = mode_rows(body, a_);
    note(std::sqrt(body.mass) * modes.norm(), body.name, left.force,
         left.force_body);
    if (!body.has_rigid_motion()) return;
    const BodyState& at = state_.bodies[index(b)];
    const Vector3& w_W = spins_[index(b)];
    const Vector3 steady = w_W.cross(at.v_WB_W - drifts_[index(b)]);
    left.acting += body.mass * steady.norm();
    const BodyTerms& t = terms_.bodies[index(b)];
    const Vector3 w = t.R_WB.transpose() * w_W;
    note(body.mass * (translation_rows(body, a_) - steady).norm(), body.name,
         left.force, left.force_body);
    note((t.J * (rotation_rows(body, a_) - w.cross(at.w_WB_B))).norm(),
         body.name, left.moment, left.moment_body);
  }

  const SystemModel& model_;
  const SystemState& state_;
  const std::vector<Vector3>& spins_;
  std::vector<Vector3> drifts_;
  SystemTerms terms_;
  VectorX a_;
  std::vector<Vector6> noise_;
};

}  // namespace

bool moves(const SystemState& state) {
  return !state.etadot.isZero(0.0) || !state.udot_H.isZero(0.0) ||
         std::any_of(state.bodies.begin(), state.bodies.end(),
                     [](const BodyState& b) {
                       return !b.v_WB_W.isZero(0.0) || !b.w_WB_B.isZero(0.0);
                     });
}

bool moves(const SystemModel& model, const SystemState& state,
           const std::vector<BodyIndex>& bodies) {
  return std::any_of(bodies.begin(), bodies.end(), [&](BodyIndex b) {
    const BodyModel& body = model.bodies[index(b)];
    const BodyState& at = state.bodies[index(b)];
    return !at.v_WB_W.isZero(0.0) || !at.w_WB_B.isZero(0.0) ||
           !state.etadot.segment(body.offset, body.modes).isZero(0.0);
  });
}

Imbalance find_imbalance(const SystemModel& model, const SystemState& state,
                         const std::vector<Vector3>& spins) {
  const Remainder remainder(model, state, spins);
  Remainder::OfGroup worst;
  for (const Bodies& group : find_linked_groups(model)) {
    Remainder::OfGroup next = remainder.find(group);
    if (next.excess > worst.excess) worst = std::move(next);
  }
  return worst.left;
}

SystemState advance_steadily(const SystemModel& model, const SystemState& state,
                             const TurningAxes& axes, double time) {
  const std::vector<Vector3> drifts = find_drifts(model, state);
  const Vector3 rotation = time * axes.w_W;
  const Matrix3 R = exp_rotation(rotation);
  SystemState later = state;
  for (std::size_t b = 0; b < later.bodies.size(); ++b) {
    BodyState& body = later.bodies[b];
    const Vector3 v = body.v_WB_W - drifts[b];
    const Vector3 w = body.quat_WB * body.w_WB_B;
    body.p_WB += time * (drifts[b] + left_jacobian(rotation) * v);
    body.v_WB_W = drifts[b] + R * v;
    const Quaternion q = exp_quaternion(rotation) *
                         exp_quaternion(time * (w - axes.w_W)) * body.quat_WB;
    body.quat_WB = q.normalized();
    body.w_WB_B = body.quat_WB.conjugate() * (R * w);
  }
  return later;
}

Vector3 find_fastest_spin(const SystemState& state,
                          const std::vector<BodyIndex>& bodies) {
  Vector3 fastest = Vector3::Zero();
  for (const BodyIndex b : bodies) {
    const BodyState& body = state.bodies[index(b)];
    const Vector3 w = body.quat_WB * body.w_WB_B;
    if (w.norm() > fastest.norm()) fastest = w;
  }
  return fastest;
}

Vector3 find_fastest_spin(const SystemState& state) {
  std::vector<BodyIndex> all;
  for (std::size_t b = 0; b < state.bodies.size(); ++b) all.emplace_back(b);
  return find_fastest_spin(state, all);
}

}  // namespace limber::dynamics

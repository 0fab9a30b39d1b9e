// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/equations/pair_forces.hpp"

#include <fmt/format.h>

#include <cmath>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/dynamics/system/unknowns.hpp"

namespace limber::dynamics {
namespace {

// The world is the last.
std::size_t slot_of(BodyIndex body, const PairTerms& terms) {
  return body == kWorld ? terms.bodies.size() - 1 : index(body);
}

void set_body(const SystemModel& model, const SystemState& state, std::size_t b,
              const Matrix3& R_WB, joints::PairBody& out) {
  const BodyState& rigid = state.bodies[b];
  out.R_WB = R_WB;
  out.p_WB = rigid.p_WB;
  out.v_WB_W = rigid.v_WB_W;
  out.w_WB_B = rigid.w_WB_B;
  out.modes = model.bodies[b].modes;
  out.eta = state.eta.data() + model.bodies[b].offset;
  out.etadot = state.etadot.data() + model.bodies[b].offset;
}

void add_force(const SystemModel& model, BodyIndex body,
               const joints::PairPlace& place, const Vector3& arm_B,
               const Vector3& force_W, SystemTerms& terms) {
  if (body == kWorld) return;
  BodyTerms& t = terms.bodies[index(body)];
  const Vector3 force_B = t.R_WB.transpose() * force_W;
  t.force_W += force_W;
  t.moment_B += arm_B.cross(force_B);
  for (int k = 0; k < model.bodies[index(body)].modes; ++k) {
    t.modal_force[k] += place.Phi_B.col(k).dot(force_B);
  }
}

void add_body_residual(const SystemModel& model, BodyIndex b,
                       const joints::PairPlace& place, const Vector3& arm_B,
                       const Vector3& force_W, const SystemTerms& terms,
                       VectorX& residual) {
  if (b == kWorld) return;
  const BodyModel& body = model.bodies[index(b)];
  const Eigen::Index row = first_row(body, index(b));
  const Vector3 force_B = terms.bodies[index(b)].R_WB.transpose() * force_W;
  residual.segment(row + 6, body.modes).noalias() -=
      place.Phi_B.transpose() * force_B;
  if (!body.has_rigid_motion()) return;
  residual.segment<3>(row) -= force_W;
  residual.segment<3>(row + 3) -= arm_B.cross(force_B);
}

}  // namespace

joints::PairBody find_pair_body(const SystemModel& model,
                                const SystemState& state, BodyIndex body) {
  joints::PairBody out;
  if (body == kWorld) return out;
  const std::size_t b = index(body);
  set_body(model, state, b, state.bodies[b].quat_WB.toRotationMatrix(), out);
  return out;
}

PairMotion find_pair_motion(const SystemModel& model, const Pair& pair,
                            const SystemState& state) {
  return {find_pair_body(model, state, pair.body_A),
          find_pair_body(model, state, pair.body_B)};
}

joints::PairResponse make_response(const SystemModel& model, const Pair& pair) {
  const auto modes_of = [&](BodyIndex b) {
    return b == kWorld ? 0 : model.bodies[index(b)].modes;
  };
  return {pair.law->most_points(), modes_of(pair.body_A), modes_of(pair.body_B),
          pair.law->couples_points()};
}

PairTerms make_pair_terms(const SystemModel& model) {
  PairTerms terms;
  if (model.pairs.empty()) return terms;
  terms.bodies.resize(model.bodies.size() + 1);
  std::vector<bool> is_in(model.bodies.size() + 1, false);
  for (const Pair& pair : model.pairs) {
    for (const BodyIndex b : {pair.body_A, pair.body_B}) {
      is_in[slot_of(b, terms)] = true;
    }
    terms.responses.push_back(make_response(model, pair));
  }
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (is_in[b]) terms.members.push_back(b);
  }
  return terms;
}

joints::PairBodies find_bodies(const Pair& pair, const PairTerms& terms) {
  return {terms.bodies[slot_of(pair.body_A, terms)],
          terms.bodies[slot_of(pair.body_B, terms)]};
}

void set_pair_bodies(const SystemModel& model, const SystemState& state,
                     SystemTerms& terms) {
  for (const std::size_t b : terms.pairs.members) {
    set_body(model, state, b, terms.bodies[b].R_WB, terms.pairs.bodies[b]);
  }
}

void check_finite(const joints::PairResponse& response) {
  bool is_finite =
      std::isfinite(response.energy) && std::isfinite(response.dissipation);
  for (const joints::PairPoint& point : response.points()) {
    is_finite = is_finite && point.force_W.allFinite() &&
                point.stiffness.allFinite() && point.damping.allFinite();
  }
  if (is_finite) return;
  throw NumericalError(
      "its force, energy or stiffness is NaN or too large; a smaller step may "
      "help");
}

void throw_pair(const std::string& name, double t,
                const NumericalError& error) {
  throw NumericalError(
      fmt::format("pair '{}' at t = {:.9g} s: {}", name, t, error.what()));
}

void apply_pairs(const SystemModel& model, const SystemState& state,
                 const Instant& now, SystemTerms& terms) {
  set_pair_bodies(model, state, terms);
  for (std::size_t i = 0; i < model.pairs.size(); ++i) {
    const Pair& pair = model.pairs[i];
    joints::PairResponse& response = terms.pairs.responses[i];
    response.clear();
    if (is_far(state, i)) continue;
    const joints::PairBodies bodies = find_bodies(pair, terms.pairs);
    name_pair(pair.name, now.t, [&] {
      pair.law->evaluate(bodies, now, memory_of(pair, state), response);
      check_finite(response);
    });
    terms.dissipated_power += response.dissipation;
    for (joints::PairPoint& point : response.points()) {
      point.acting = {find_arm(bodies.A, point.on_A),
                      find_arm(bodies.B, point.on_B)};
      point.moving = point.acting;
      point.velocity_W = find_velocity(bodies.B, point.on_B) -
                         find_velocity(bodies.A, point.on_A);
      add_force(model, pair.body_A, point.on_A, point.acting.A, -point.force_W,
                terms);
      add_force(model, pair.body_B, point.on_B, point.acting.B, point.force_W,
                terms);
    }
  }
}

void add_residual(const SystemModel& model, const Pair& pair,
                  const joints::PairPoint& point, const Vector3& force_W,
                  const SystemTerms& terms, VectorX& residual) {
  add_body_residual(model, pair.body_A, point.on_A, point.acting.A, -force_W,
                    terms, residual);
  add_body_residual(model, pair.body_B, point.on_B, point.acting.B, force_W,
                    terms, residual);
}

PairCommit::PairCommit(const SystemModel& model) : model_(model) {
  for (std::size_t i = 0; i < model.pairs.size(); ++i) {
    if (model.pairs[i].law->memory_size() == 0) continue;
    pairs_.push_back(i);
    scratch_.push_back(make_response(model, model.pairs[i]));
  }
}

void PairCommit::operator()(SystemState& state) {
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    if (is_far(state, pairs_[i])) continue;
    const Pair& pair = model_.pairs[pairs_[i]];
    const PairMotion motion = find_pair_motion(model_, pair, state);
    pair.law->commit(motion.bodies(), state.t, memory_of(pair, state),
                     scratch_[i]);
  }
}

}  // namespace limber::dynamics
